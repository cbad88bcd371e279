"""What the node's own code draws at random, and has others draw in a second run: a name that is made of it is another
one in each run, and no fact.

A draw is told as its `repr`. Where the host gives those of an earlier run, each draw here differs from the one of the
same number there, as far as it can.
"""

from __future__ import annotations

import functools
import json
import os
import sys
from types import ModuleType
from typing import Any, Callable

from . import channel
from .variables import DRAWN
from .weaving import wrap

MODULES = ("random", "uuid", "secrets")
_FUNCTIONS = {
    "random": (
        *("random", "uniform", "randint", "randrange", "choice", "choices", "sample", "getrandbits", "gauss"),
        *("normalvariate", "triangular", "betavariate", "expovariate", "randbytes"),
    ),
    "uuid": ("uuid1", "uuid4"),
    "secrets": ("token_bytes", "token_hex", "token_urlsafe", "choice", "randbelow", "randbits"),
    "os": ("urandom",),
}
_OF_GENERATORS = ("uniform", "randint", "randrange", "choice", "choices", "sample")
"""Methods of `random.Random`, for a generator of the node's own."""
_MOST = 64
"""Draws that are told and compared."""
_LONGEST = 60
_TRIES = 50
_LATER = 100_007
"""Seconds by which the clock of a second run is ahead, and its process ids."""
_OURS = os.path.dirname(os.path.abspath(__file__))
_NOT_OWN = tuple(os.path.dirname(os.path.abspath(file)) + os.sep for file in (os.__file__, _OURS))
"""The standard library, and us with our stand-ins."""

_drawn: list[str] = []
_before: list[str] = []


def install() -> None:
    """Watch the functions of what is there from the start; `weave` is for the modules that come."""
    try:
        _before[:] = [str(each) for each in json.loads(os.environ.get(DRAWN, "[]"))]
    except ValueError:
        pass
    wrap(os, "urandom", _draws)
    wrap(os, "getpid", _process_id)
    for name in MODULES:
        if name in sys.modules:
            weave(sys.modules[name])
    if DRAWN in os.environ:
        import time  # noqa: PLC0415

        wrap(time, "time", functools.partial(_later, by=_LATER))
        wrap(time, "time_ns", functools.partial(_later, by=_LATER * 1_000_000_000))


def weave(module: ModuleType) -> None:
    """Watch the functions of a module."""
    for name in _FUNCTIONS[module.__name__]:
        wrap(module, name, _draws)
    if module.__name__ == "random":
        for name in _OF_GENERATORS:
            wrap(module.Random, name, _draws)


def _is_own(depth: int) -> bool:
    """Whether the node's own code calls: not the standard library, not what is installed."""
    file = sys._getframe(depth + 1).f_code.co_filename
    return file.startswith("/") and not file.startswith(_NOT_OWN) and "-packages/" not in file


def _draws(original: Callable[..., Any]) -> Callable[..., Any]:
    def draw(*args: Any, **kwargs: Any) -> Any:
        value = original(*args, **kwargs)
        number = len(_drawn)
        if number >= _MOST or not _is_own(1):
            return value
        if number < len(_before):
            for _ in range(_TRIES):
                if _written(value) != _before[number]:
                    break
                value = original(*args, **kwargs)
        _note(value)
        return value

    return draw


def _process_id(original: Callable[..., int]) -> Callable[..., int]:
    def process_id() -> int:
        value = original()
        if len(_drawn) >= _MOST or not _is_own(1):
            return value
        _note(value)
        return value + _LATER if DRAWN in os.environ else value

    return process_id


def _later(original: Callable[..., Any], by: int) -> Callable[..., Any]:
    def later() -> Any:
        return original() + by if _is_own(1) else original()

    return later


def _written(value: Any) -> str:
    return repr(value)[:_LONGEST]


def _note(value: Any) -> None:
    _drawn.append(_written(value))
    channel.send("drew", value=_drawn[-1])
