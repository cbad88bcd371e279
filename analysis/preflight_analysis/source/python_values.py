"""What the walk through a Python program knows of a value."""

from __future__ import annotations

import ast
from collections.abc import Callable
from dataclasses import field
from typing import Any

from preflight_analysis.dataclass import dataclass

_MAX_PARTS = 1000
_MAX_WAITING = 8


class _Unknown:
    def __repr__(self) -> str:
        return "UNKNOWN"


UNKNOWN: Any = _Unknown()
"""A value that only a run would tell."""


@dataclass(frozen=True, slots=True)
class Imported:
    """Something of a module that is not followed, by its dotted name: `rospy.Publisher`, `std_msgs.msg.String`."""

    path: str


@dataclass(frozen=True, slots=True)
class StarImported:
    """A name that nothing defines but one of the modules of which all was imported."""

    name: str
    modules: tuple[str, ...]


@dataclass(eq=False, slots=True)
class Module:
    """A module that is followed."""

    path: str
    names: dict[str, Any] = field(default_factory=dict)
    stars: list[str] = field(default_factory=list)
    done: bool = False


@dataclass(eq=False, slots=True)
class Scope:
    """The names of one call of a function; of a module its own dictionary."""

    names: dict[str, Any]
    module: Module
    parent: Scope | None = None
    globals: set[str] = field(default_factory=set)
    owner: Class | None = None
    """The class whose method it is."""
    instance: Any = None


@dataclass(eq=False, slots=True)
class Function:
    """A function, a lambda, or with `instance` a method that is bound."""

    node: ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda
    scope: Scope
    owner: Class | None = None
    instance: Any = None


@dataclass(eq=False, slots=True)
class Class:
    """A class with its bases as far as they are known."""

    name: str
    names: dict[str, Any]
    bases: tuple[Any, ...]

    def find(self, name: str) -> Any:
        """An attribute of the class or of a base; UNKNOWN if there is none that is known."""
        for cls in self.order():
            if name in cls.names:
                return cls.names[name]
        return UNKNOWN

    @property
    def imported_base(self) -> str | None:
        """The first base that is not followed, by its dotted name."""
        bases = (base for cls in self.order() for base in cls.bases if isinstance(base, Imported))
        return next((base.path for base in bases if not base.path.startswith("builtins.")), None)

    def order(self) -> list[Class]:
        """The class and its known bases, as attributes are looked up."""
        found: list[Class] = []
        pending: list[Class] = [self]
        while pending and len(found) < 32:
            cls = pending.pop(0)
            if cls not in found:
                found.append(cls)
                pending[:0] = [base for base in cls.bases if isinstance(base, Class)]
        return found


@dataclass(eq=False, slots=True)
class Instance:
    """An object of a class that is followed."""

    cls: Class
    names: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Super:
    """`super()` in a method of `cls`."""

    cls: Class
    instance: Any


class Later:
    """A plain value, or UNKNOWN, that is asked for where something depends on it, and not before: to be stored, passed
    on or written to a log is no reason to ask. `depth`: how many wait for each other."""

    __slots__ = ("_ask", "_value", "depth")

    def __init__(self, ask: Callable[[], Any], depth: int = 0) -> None:
        self._ask: Callable[[], Any] | None = ask
        self._value: Any = UNKNOWN
        self.depth = depth

    def now(self) -> Any:
        """The value, the same object each time."""
        if self._ask is not None:
            self._value, self._ask = self._ask(), None
        return self._value


def known(value: Any) -> Any:
    """The value itself of one that may not have been asked for."""
    return value.now() if type(value) is Later else value


def after(function: Callable[..., Any], *values: Any) -> Any:
    """`function(*values)`, which is asked for as late as they are. It depends on nothing that may change meanwhile."""
    depth = 1 + max((value.depth for value in values if type(value) is Later), default=-1)
    if 0 < depth <= _MAX_WAITING:
        return Later(lambda: function(*map(known, values)), depth)
    return function(*map(known, values))


def is_plain(value: Any) -> bool:
    """Whether it is a small value of the program that is fully known: no function, object or module."""
    pending, left = [value], _MAX_PARTS
    while pending and left:
        left -= 1
        part = pending.pop()
        if isinstance(part, (list, tuple)):
            pending += part[:_MAX_PARTS]
        elif isinstance(part, dict):
            pending += list(part.values())[:_MAX_PARTS]
        elif not (part is None or isinstance(part, (str, int, float, bool))):
            return False
    return not pending
