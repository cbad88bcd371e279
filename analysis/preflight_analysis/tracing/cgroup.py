"""A control group around each run where RLIMIT_NPROC does not bind, which is as root: how many processes and how much
memory.

Made beside or below the group that this process is in, where it may be and where whoever runs the machine has already
handed the controller down; nothing of others is changed. Where that is not so, `place` finds nothing, and the
supervisor inside counts instead: see `docs/security.md`.
"""

from __future__ import annotations

import contextlib
import errno
import itertools
import os
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

from preflight_analysis.dataclass import dataclass
from preflight_analysis.tracing.once_per_process import once_per_process

_PREFIX = "ros-preflight-"
_REMOVAL_SECONDS = 0.5
_numbers = itertools.count()


@dataclass(frozen=True, slots=True)
class Place:
    """A group below which a run's own can be made, and whether memory is counted there."""

    folder: Path
    memory: bool


@once_per_process
def place() -> Place | None:
    """Where to make groups, tried out once per process; None where it is not possible or not needed."""
    if os.geteuid() != 0:
        return None
    try:
        memberships = Path("/proc/self/cgroup").read_text()
        mounts = Path("/proc/self/mountinfo").read_text()
    except OSError:
        return None
    for found in candidates(memberships, mounts):
        try:
            _remove_left_over(found.folder)
            with group(found, 1, 1 << 20):
                return found
        except OSError:
            continue
    return None


def candidates(memberships: str, mounts: str) -> Iterator[Place]:
    """Groups to try, the nearest first, from `/proc/self/cgroup` and `/proc/self/mountinfo` (cgroups(7), proc(5))."""
    mounted = {}
    for line in mounts.splitlines():
        fields, system = (part.split() for part in line.partition(" - ")[::2])
        if len(fields) > 4 and len(system) > 2 and system[0] in ("cgroup", "cgroup2"):
            controllers = system[2].split(",") if system[0] == "cgroup" else [""]
            mounted.update(dict.fromkeys(controllers, (fields[3], Path(fields[4]))))
    for line in memberships.splitlines():
        _, _, rest = line.partition(":")
        named, _, path = rest.partition(":")
        for controller in named.split(","):
            if controller not in ("", "pids") or controller not in mounted:
                continue
            root, top = mounted[controller]
            inside = os.path.relpath(path, root)
            if ".." in path.split("/") or ".." in inside.split("/"):
                continue  # outside of what is mounted here
            own = Path(os.path.normpath(top / inside))
            if controller == "pids":
                yield Place(own, memory=False)
                continue
            for folder in (own, *own.parents):
                with contextlib.suppress(OSError):
                    handed_down = (folder / "cgroup.subtree_control").read_text().split()
                    if "pids" in handed_down:
                        yield Place(folder, memory="memory" in handed_down)
                if folder == top:
                    break


@contextlib.contextmanager
def group(below: Place, processes: int, memory: int) -> Iterator[Path]:
    """A group for one run, for as long as the block lasts, with at most so many processes and, where memory is counted
    there, bytes of it. Raises `OSError` if it cannot be made."""
    folder = below.folder / f"{_PREFIX}{os.getpid()}-{next(_numbers)}"
    folder.mkdir()
    try:
        (folder / "pids.max").write_text(str(processes))
        if below.memory:
            (folder / "memory.max").write_text(str(memory))
            with contextlib.suppress(OSError):  # a kernel without swap accounting
                (folder / "memory.swap.max").write_text("0")
        yield folder
    finally:
        _remove(folder)


def entering(folder: Path, argv: Sequence[str]) -> list[str]:
    """The command line that puts itself into the group and becomes `argv`, or ends if it cannot."""
    return ["/bin/sh", "-c", 'echo $$ > "$0" && exec "$@"', str(folder / "cgroup.procs"), *argv]


def _remove(folder: Path) -> None:
    """Remove a group, once the last processes in it are gone. If they stay, so does it, until a later start."""
    deadline = time.monotonic() + _REMOVAL_SECONDS
    while True:
        try:
            folder.rmdir()
        except OSError as error:
            if error.errno != errno.EBUSY or time.monotonic() > deadline:
                return
            time.sleep(0.001)
        else:
            return


def _remove_left_over(folder: Path) -> None:
    """Remove the empty groups of processes that are no more (killed before they could)."""
    for left in folder.glob(_PREFIX + "*-*"):
        owner = left.name[len(_PREFIX) :].partition("-")[0]
        if owner.isdigit() and not os.path.exists(f"/proc/{owner}"):
            with contextlib.suppress(OSError):
                left.rmdir()
