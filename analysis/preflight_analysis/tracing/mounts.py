"""File systems of the host that let in what the sandbox keeps out: a second `/proc`, as in a chroot or beside a
container, has the host's processes, their folders and memory; `/sys` has the addresses and numbers of its parts."""

from __future__ import annotations

import contextlib
import os
import re
from collections.abc import Iterable
from pathlib import Path

from preflight_analysis.documents.secrets import within
from preflight_analysis.tracing.backend import Seen

_TABLE = Path("/proc/self/mountinfo")
_KERNELS = frozenset(("proc", "sysfs", "cgroup", "cgroup2", "debugfs", "tracefs", "securityfs", "configfs"))
_OWN = ("/proc", "/sys", "/dev")
"""Where they are expected: of `/proc` and `/dev` a run has its own, and `/sys` is read-only."""
_DEVICES = Path("/sys")
_IDENTIFYING = ("net", "ieee80211", "infiniband", "dmi")
"""Classes of devices in `/sys/class` that tell one machine from all others: addresses of interfaces, serial numbers."""


def leading_out(bound: Iterable[str], masks: Iterable[str]) -> list[str]:
    """Folders inside at which the kernel's own file systems of the host would be seen. `bound` are folders that are
    shown though they lie below one of `masks`. Raises `OSError` where the kernel does not tell."""
    found: set[str] = set()
    seen = Seen.of(bound, masks)
    for line in _TABLE.read_text(errors="surrogateescape").split("\n")[:-1]:
        # proc(5): ID, parent, device, root, mount point, options, any number of fields, -, type, source, options.
        about, _, kind = line.partition(" - ")
        place = re.sub(r"\\([0-7]{3})", lambda code: chr(int(code[1], 8)), about.split(" ")[4])
        if kind.split(" ")[0] in _KERNELS and not any(within(place, own) for own in _OWN):
            found.update(seen.places(place))
    existing = {path for path in (*found, *_identifying()) if os.path.isdir(path)}
    # What lies in another cannot be hidden once that is.
    return sorted(path for path in existing if not any(within(path, other) for other in existing if other != path))


def _identifying() -> set[str]:
    """The folders with the devices of these classes, and those with links to them."""
    found = {str(_DEVICES / "firmware/dmi")}
    for kind in _IDENTIFYING:
        folder = str(_DEVICES / "class" / kind)
        with contextlib.suppress(OSError):
            found.update(os.path.dirname(os.path.realpath(entry)) for entry in os.scandir(folder))
            found.add(folder)
    return found
