"""Unix sockets that could be seen in the sandbox: connecting to one needs no writable mount.

The kernel knows a socket by the name that it was bound with, not by those that it was renamed or linked to, nor by its
folder where that name is relative; and it does not know those of other containers. So sockets are looked for as files:
in what is shown of the masked folders, and beside those that the kernel names.
"""

from __future__ import annotations

import contextlib
import functools
import os
import stat
import time
from collections import deque
from collections.abc import Iterable, Iterator
from pathlib import Path

from preflight_analysis.tracing.backend import Seen

MOST_FOLDERS = 20_000
"""How many folders of what is shown are looked into, the outermost first."""
_LOOKED_SECONDS = 10
"""For how long such a look counts, where the kernel names the same sockets in the same places."""
_TABLE = Path("/proc/net/unix")
_OWN = ("/dev/", "/proc/")
"""What the sandbox has its own of."""

_Bound = frozenset[tuple[str, int, int, int]]
"""Each socket with a name: its path, and device, inode and number of links of what lies there, zeros for nothing."""


def reachable(bound: Iterable[str], masks: Iterable[str]) -> list[str]:
    """Paths inside at which a socket of the host lies now. `bound` are folders that are shown though they lie below one
    of `masks`."""
    seen = Seen.of(bound, masks)
    named = _named()
    shown = tuple(real for _, real in seen.bound)
    found = {path for path, _, inode, _ in named if inode and not path.startswith(_OWN)}
    found.update(_lying_around(shown, named, int(time.monotonic() / _LOOKED_SECONDS)))
    return sorted({place for path in found if _is_socket(path) for place in seen.places(path)})


def _named() -> _Bound:
    try:
        lines = _TABLE.read_text(errors="surrogateescape").split("\n")[1:]
    except OSError:
        return frozenset()
    names = {name[0] for line in lines if (name := line.split(None, 7)[7:])}
    return frozenset(map(_status, (name for name in names if not name.startswith("@"))))


def _status(name: str) -> tuple[str, int, int, int]:
    path = os.path.realpath(name) if name.startswith("/") else name
    with contextlib.suppress(OSError, ValueError):
        if name.startswith("/"):
            status = os.lstat(path)
            return path, status.st_dev, status.st_ino, status.st_nlink
    return path, 0, 0, 0


@functools.lru_cache(maxsize=64)
def _lying_around(shown: tuple[str, ...], named: _Bound, at: int) -> tuple[str, ...]:
    """Sockets in and below the shown folders, and in those folders in which some were bound. `at` is the time, in
    `_LOOKED_SECONDS`."""
    beside = dict.fromkeys(os.path.dirname(path) for path, *_ in sorted(named) if path.startswith("/"))
    return (*_files_of(shown, MOST_FOLDERS), *_files_of(beside, 0))


def _files_of(folders: Iterable[str], below: int) -> Iterator[str]:
    """The sockets in folders, and in so many further ones below them."""
    pending = deque(folders)
    while pending:
        folder = pending.popleft()
        with contextlib.suppress(OSError), os.scandir(folder) as entries:
            for entry in entries:
                if entry.is_dir(follow_symlinks=False):
                    if below > 0:
                        below -= 1
                        pending.append(entry.path)
                elif not entry.is_file(follow_symlinks=False) and not entry.is_symlink() and _is_socket(entry.path):
                    yield entry.path


def _is_socket(path: str) -> bool:
    try:
        return stat.S_ISSOCK(os.lstat(path).st_mode)
    except OSError:
        return False
