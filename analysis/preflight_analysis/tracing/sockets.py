"""Unix sockets that could be seen in the sandbox: connecting to one needs no writable mount."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterable
from pathlib import Path

from preflight_analysis.tracing.backend import Seen

_TABLE = Path("/proc/net/unix")
_OWN = ("/dev/", "/proc/")
"""What the sandbox has its own of."""


def reachable(bound: Iterable[str], masks: Iterable[str]) -> list[str]:
    """Paths inside at which a socket of the host lies now. `bound` are folders that are shown though they lie below one
    of `masks`."""
    try:
        lines = _TABLE.read_text(errors="surrogateescape").splitlines()[1:]
    except OSError:
        return []
    seen = Seen.of(bound, masks)
    found: set[str] = set()
    for line in lines:
        name = line.split(None, 7)[7:]
        if not name or not name[0].startswith("/"):
            continue
        path = os.path.realpath(name[0])
        places = seen.places(path) if not path.startswith(_OWN) else []
        if places and _is_socket(path):
            found.update(places)
    return sorted(found)


def _is_socket(path: str) -> bool:
    try:
        return stat.S_ISSOCK(os.lstat(path).st_mode)
    except OSError:
        return False
