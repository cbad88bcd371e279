"""`check --watch`: the same again at each change of the workspace."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Collection, Iterable, Mapping

from preflight_analysis.dataclass import dataclass

from preflight_server.cli.errors import FAILED, CannotDoError
from preflight_server.cli.output import print_text, say

_POLL_SECONDS = 0.3
_SHARE = 10
"""A look at the files takes at most one part in so many of the time."""
_SUFFIXES = frozenset(
    (
        *("", ".launch", ".test", ".xml", ".yaml", ".yml", ".py", ".cfg", ".toml", ".txt", ".xacro", ".urdf", ".srdf"),
        *(".c", ".cc", ".cpp", ".cxx", ".h", ".hh", ".hpp", ".hxx", ".msg", ".srv", ".action", ".json"),
    )
)
"""What launches are made of. Others, such as the output of this command, are no reason to look again."""
_SKIPPED = frozenset(("build", "devel", "install", "log", "node_modules", "__pycache__"))
_CLEAR = "\x1b[2J\x1b[3J\x1b[H"

State = Mapping[str, tuple[int, int]]
"""The files by path, each with its time of change in nanoseconds and its size."""


@dataclass(frozen=True, slots=True)
class Looked:
    """What one round came to: its exit code, and the folders and further files that it depends on."""

    code: int
    folders: Collection[str]
    files: Collection[str]


def again_and_again(look: Callable[[], Looked]) -> int:
    """Call `look`, and once more after each change, until it is interrupted; the exit code is that of the last round.
    A round that cannot do what was asked is repeated as well, where one could before."""
    last = look()
    before, took = _timed(last)
    _waiting(last)
    try:
        while True:
            time.sleep(max(_POLL_SECONDS, took * _SHARE))
            now, took = _timed(last)
            if now == before:
                continue
            while True:  # until whoever writes has written all
                time.sleep(_POLL_SECONDS)
                later, took = _timed(last)
                if later == now:
                    break
                now = later
            changed = _changed(before, now)
            before = now
            if sys.stdout.isatty():
                print_text(_CLEAR, painted=True)
            say(f"ros-preflight: {time.strftime('%H:%M:%S')} changed: {changed}")
            try:
                last = look()
            except CannotDoError as error:
                say(f"ros-preflight: {error}")
                last = Looked(FAILED, last.folders, last.files)
            _waiting(last)
    except KeyboardInterrupt:
        return last.code


def _waiting(last: Looked) -> None:
    sys.stdout.flush()
    say(f"ros-preflight: exit code {last.code}; waiting for changes (Ctrl-C ends)")


def _timed(last: Looked) -> tuple[State, float]:
    began = time.perf_counter()
    state = seen(last.folders, last.files)
    return state, time.perf_counter() - began


def seen(folders: Iterable[str], files: Iterable[str]) -> State:
    """The files below the folders that launches are made of, and the others that are named."""
    found: dict[str, tuple[int, int]] = {}
    left = [*folders]
    while left:
        try:
            with os.scandir(left.pop()) as entries:
                for entry in entries:
                    if entry.is_dir(follow_symlinks=False):
                        if entry.name not in _SKIPPED and not entry.name.startswith("."):
                            left.append(entry.path)
                    elif os.path.splitext(entry.name)[1].lower() in _SUFFIXES:
                        status = entry.stat()
                        found[entry.path] = status.st_mtime_ns, status.st_size
        except OSError:
            continue  # it went away, or is not for us
    for file in files:
        try:
            status = os.stat(file)
        except OSError:
            continue
        found[file] = status.st_mtime_ns, status.st_size
    return found


def _changed(before: State, now: State) -> str:
    names = sorted(path for path in {*before, *now} if before.get(path) != now.get(path))
    first = os.path.relpath(names[0]) if names else ""
    return first if len(names) < 2 else f"{first} and {len(names) - 1} more"
