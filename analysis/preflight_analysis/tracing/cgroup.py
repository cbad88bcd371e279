"""Control groups around each run: how much memory it may have in all, whatever kind of memory that is, and how many
processes where RLIMIT_NPROC does not bind, which is as root.

Made beside or below the group that this process is in, where it may be and where whoever runs the machine has already
handed the controllers down (systemd does so for its users' sessions); nothing of others is changed. Where that is not
so, `places` finds nothing, and the supervisor inside counts instead: see `docs/security.md`.
"""

from __future__ import annotations

import contextlib
import errno
import itertools
import os
import subprocess
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

from preflight_analysis.dataclass import dataclass
from preflight_analysis.tracing.once_per_process import once_per_process

_PREFIX = "ros-preflight-"
_REMOVAL_SECONDS = 0.5
_TRIED_BYTES = 64 << 20
_numbers = itertools.count()


@dataclass(frozen=True, slots=True)
class Place:
    """A group below which a run's own can be made, and what is counted there. `version` is that of the interface."""

    folder: Path
    processes: bool
    memory: bool
    version: int


@once_per_process
def places() -> tuple[Place, ...]:
    """Where to make groups, tried out once per process: one for all that can be counted, at most two with version 1,
    none where it is not possible."""
    try:
        memberships = Path("/proc/self/cgroup").read_text()
        mounts = Path("/proc/self/mountinfo").read_text()
    except OSError:
        return ()
    found: list[Place] = []
    # One that counts memory comes first, even if it is farther away.
    for each in sorted(candidates(memberships, mounts), key=lambda each: not each.memory):
        new = (each.memory and not any(o.memory for o in found)) or (
            each.processes and not any(o.processes for o in found)
        )
        if new and _works(each):
            found.append(each)
            if each.version == 2:
                break
    return tuple(found)


def _works(place: Place) -> bool:
    """Whether a process can be put into a group that is made there."""
    try:
        _remove_left_over(place.folder)
        with groups([place], 16, _TRIED_BYTES) as made:
            argv = entering(made, ["/bin/true"])
            return subprocess.run(argv, capture_output=True, env={}, timeout=5, check=False).returncode == 0
    except (OSError, subprocess.TimeoutExpired):
        return False


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
        controllers = [each for each in named.split(",") if each in ("", "pids", "memory") and each in mounted]
        if not controllers:
            continue
        root, top = mounted[controllers[0]]
        inside = os.path.relpath(path, root)
        if ".." in path.split("/") or ".." in inside.split("/"):
            continue  # outside of what is mounted here
        own = Path(os.path.normpath(top / inside))
        if controllers != [""]:
            yield Place(own, "pids" in controllers, "memory" in controllers, 1)
            continue
        for folder in (own, *own.parents):
            with contextlib.suppress(OSError):
                handed_down = (folder / "cgroup.subtree_control").read_text().split()
                if "pids" in handed_down or "memory" in handed_down:
                    yield Place(folder, "pids" in handed_down, "memory" in handed_down, 2)
            if folder == top:
                break


@contextlib.contextmanager
def groups(below: Sequence[Place], processes: int, memory: int) -> Iterator[list[Path]]:
    """Groups for one run, for as long as the block lasts, with at most so many processes and bytes of memory, as far as
    these are counted there. Raises `OSError` if they cannot be made."""
    made: list[Path] = []
    try:
        for place in below:
            folder = place.folder / f"{_PREFIX}{os.getpid()}-{next(_numbers)}"
            folder.mkdir()
            made.append(folder)
            if place.processes:
                (folder / "pids.max").write_text(str(processes))
            if place.memory:
                most, with_swap, swap = _MEMORY[place.version]
                (folder / most).write_text(str(memory))
                with contextlib.suppress(OSError):  # a kernel without swap accounting
                    (folder / with_swap).write_text(str(swap if swap is not None else memory))
        yield made
    finally:
        for folder in made:
            _remove(folder)


_MEMORY = {
    1: ("memory.limit_in_bytes", "memory.memsw.limit_in_bytes", None),
    2: ("memory.max", "memory.swap.max", 0),
}
"""The files with the limits of memory, and of what with it or without it goes to swap: None for the same."""


def ran_out(made: Sequence[Path]) -> bool:
    """Whether the kernel ended a process of a group for its memory."""
    for folder in made:
        for name in ("memory.oom_control", "memory.events"):
            with contextlib.suppress(OSError):
                for line in (folder / name).read_text().splitlines():
                    if line.startswith("oom_kill ") and line.split()[1] != "0":
                        return True
    return False


def entering(made: Sequence[Path], argv: Sequence[str]) -> list[str]:
    """The command line that puts itself into the groups and becomes `argv`, or ends if it cannot."""
    command = list(argv)
    for folder in made:
        command = ["/bin/sh", "-c", 'echo $$ > "$0" && exec "$@"', str(folder / "cgroup.procs"), *command]
    return command


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
