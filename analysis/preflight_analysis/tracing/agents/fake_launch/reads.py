"""What a launch file, or a call of its own code, reads of what it is given: launch configurations, variables of the
environment, the path of the current launch file. Its answer holds wherever these are the same.

What is written counts as read, as the host is told what is different afterwards.
"""

from __future__ import annotations

import contextlib
import os
import sys
from typing import Any, Callable, Iterator, Optional

from ..anything import Anything, is_unknown
from .base import RECORDER, is_own

_STARTS_PROCESSES = ("subprocess.Popen", "os.system", "os.exec", "os.fork", "os.forkpty", "os.posix_spawn", "os.spawn")
"""Events of `sys.audit` by which another program gets the whole environment."""
_BY_NAME = ("__setitem__", "__delitem__", "setdefault", "pop")
_CONFIGURATION = "the launch configuration"
_AS_A_WHOLE = (
    *("__iter__", "__len__", "__reversed__", "__eq__", "__ne__", "__repr__", "__or__", "__ror__", "__ior__"),
    *("clear", "copy", "items", "keys", "popitem", "update", "values"),
)


class Reads:
    """Names; None where all of them count."""

    def __init__(self) -> None:
        self.configurations: Optional[dict[str, None]] = {}
        self.variables: Optional[dict[str, None]] = {}
        self.file = False

    def record(self) -> dict[str, Any]:
        """As the host gets it."""
        configurations, variables = self.configurations, self.variables
        return {
            "configurations": None if configurations is None else sorted(configurations),
            "env": None if variables is None else sorted(variables),
            "file": self.file,
        }


@contextlib.contextmanager
def noted() -> Iterator[None]:
    """Notes what is read in a `with` block."""
    RECORDER.reads = RECORDER.last_reads = Reads()
    try:
        yield
    finally:
        RECORDER.reads = None


class Configurations(dict):  # type: ignore[type-arg]
    """Launch configurations that note who reads them."""

    def preflight_read(self, name: Any) -> None:
        """One is read."""
        RECORDER.unknown = RECORDER.unknown or is_unknown(dict.get(self, name))
        if RECORDER.reads is not None and RECORDER.reads.configurations is not None and isinstance(name, str):
            RECORDER.reads.configurations[name] = None

    def preflight_read_all(self) -> None:
        """All are read."""
        RECORDER.unknown = RECORDER.unknown or any(map(is_unknown, dict.values(self)))
        if RECORDER.reads is not None:
            RECORDER.reads.configurations = None


def install() -> None:
    """Note what is read of the environment from now on."""
    kind: Any = type(os.environ)
    for name in ("__getitem__", "__setitem__", "__delitem__"):
        setattr(kind, name, _by_name(getattr(kind, name), lambda _, variable: _read_variable(variable)))
    for name in ("__iter__", "__len__", "__repr__"):
        setattr(kind, name, _as_a_whole(getattr(kind, name), lambda _: _read_variables()))
    sys.addaudithook(_audited)


def _looked_for(method: Any) -> Any:
    """What asks for a launch configuration that nobody sets: a launch file that raises without has one that is not
    known, as includers may set it."""

    def called(self: Any, name: Any, *default: Any) -> Any:
        self.preflight_read(name)
        frame = sys._getframe(1)
        is_lacking = isinstance(name, str) and not dict.__contains__(self, name) and is_own(frame)
        if not is_lacking or any(default) or not RECORDER.answers.is_set(f"{_CONFIGURATION} {name}", frame):
            return method(self, name, *default)
        if method is dict.__getitem__:
            RECORDER.miss("configuration", name)
        else:
            RECORDER.note_guess(name, frame)
        return True if method is dict.__contains__ else Anything(name)

    return called


def _by_name(method: Any, read: Callable[[Any, Any], None]) -> Any:
    def called(self: Any, name: Any, *args: Any) -> Any:
        read(self, name)
        return method(self, name, *args)

    return called


def _as_a_whole(method: Any, read: Callable[[Any], None]) -> Any:
    def called(self: Any, *args: Any, **kwargs: Any) -> Any:
        read(self)
        return method(self, *args, **kwargs)

    return called


def _read_variable(name: Any) -> None:
    if RECORDER.reads is not None and RECORDER.reads.variables is not None and isinstance(name, (str, bytes)):
        RECORDER.reads.variables[os.fsdecode(name)] = None


def _read_variables() -> None:
    if RECORDER.reads is not None:
        RECORDER.reads.variables = None


def _audited(event: str, _: Any) -> None:
    if event in _STARTS_PROCESSES:
        _read_variables()


for _name in ("__getitem__", "__contains__", "get"):
    setattr(Configurations, _name, _looked_for(getattr(dict, _name)))
for _name in _BY_NAME:
    setattr(Configurations, _name, _by_name(getattr(dict, _name), Configurations.preflight_read))
for _name in _AS_A_WHOLE:
    if hasattr(dict, _name):  # an older Python has fewer
        setattr(Configurations, _name, _as_a_whole(getattr(dict, _name), Configurations.preflight_read_all))
