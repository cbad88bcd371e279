"""File systems of the host that let in what the sandbox keeps out: a second `/proc`, as in a chroot or beside a
container, has the host's processes, their folders and memory."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from pathlib import Path

from preflight_analysis.tracing.backend import Seen
from preflight_analysis.tracing.interior import within

_TABLE = Path("/proc/self/mountinfo")
_KERNELS = frozenset(("proc", "sysfs", "cgroup", "cgroup2", "debugfs", "tracefs", "securityfs", "configfs"))
_OWN = ("/proc", "/sys", "/dev")
"""Where they are expected: of `/proc` and `/dev` a run has its own, and `/sys` is read-only."""


def leading_out(bound: Iterable[str], masks: Iterable[str]) -> list[str]:
    """Folders inside at which the kernel's own file systems of the host would be seen. `bound` are folders that are
    shown though they lie below one of `masks`. Raises `OSError` where the kernel does not tell."""
    found: set[str] = set()
    seen = Seen.of(bound, masks)
    for line in _TABLE.read_text(errors="surrogateescape").splitlines():
        # proc(5): ID, parent, device, root, mount point, options, any number of fields, -, type, source, options.
        about, _, kind = line.partition(" - ")
        place = re.sub(r"\\([0-7]{3})", lambda code: chr(int(code[1], 8)), about.split(" ")[4])
        if kind.split(" ")[0] in _KERNELS and not any(within(place, own) for own in _OWN):
            found.update(seen.places(place))
    return sorted(path for path in found if os.path.isdir(path))
