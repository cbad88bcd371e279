"""What a program has of roscpp: handles, objects of libraries, nodelets that it loads."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation import names
from preflight_analysis.source.cpp_values import CppType, Unmade
from preflight_analysis.source.python_values import UNKNOWN
from preflight_analysis.source.roscpp_api import HANDLE


@dataclass(frozen=True, slots=True)
class Handle:
    """A `ros::NodeHandle` by its namespace as the node gave it, UNKNOWN if that is not known."""

    space: Any

    def name(self, name: Any) -> Any:
        """What the node calls `name` in the namespace of the handle."""
        if not isinstance(name, str) or not name:
            return UNKNOWN
        if name.startswith("~"):
            return private_name(name)
        if not isinstance(self.space, str):
            return name if name.startswith("/") else UNKNOWN
        return names.canonicalize(names.join(self.space, name))


@dataclass(frozen=True, slots=True)
class Made:
    """An object of a library: its type and the handle that it works with."""

    type: CppType
    handle: Handle


@dataclass(frozen=True, slots=True)
class Options:
    """`ros::AdvertiseOptions` and the like."""

    name: Any
    type: str | None


@dataclass(frozen=True, slots=True)
class Loaded:
    """A nodelet that a program loads: `plugin` is `package/Type`, `remaps` maps resolved names to resolved names."""

    name: str
    plugin: str
    remaps: Mapping[str, str]


def private_name(name: str) -> str:
    """A name in the node's own namespace: `~`, `~/a` and `~a` as `~` or `~a`."""
    return "~" + names.canonicalize(name[1:].lstrip("/")) if len(name) > 1 else "~"


def is_handle(value: Any) -> bool:
    """Whether it is a node handle, known or not."""
    return isinstance(value, Handle) or (isinstance(value, Unmade) and value.type.name == HANDLE)


def handle_of(value: Any) -> Handle:
    """The handle that is given; where none is the node's own."""
    return value if isinstance(value, Handle) else Handle("" if value is None else UNKNOWN)


def first_text(given: Sequence[Any]) -> Any:
    """The name among the arguments: the first, or the one after a handle."""
    for value in given[:2]:
        if not is_handle(value) and not isinstance(value, Made):
            return value
    return UNKNOWN
