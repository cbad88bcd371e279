"""The classes of `launch` and `launch_ros` that make actions, as far as it is needed to read Python launch files.

Each is declared with its action (`evaluation/ros2/actions/`); readers are given all of them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field

from preflight_analysis.dataclass import dataclass


@dataclass(frozen=True, slots=True)
class PythonClass:
    """A class by its full name, and how its parameters give the attributes and children of the action."""

    name: str
    positional: tuple[str, ...] = ()
    """The parameters that may be given without their keyword, in order."""
    keywords: Mapping[str, str] = field(default_factory=dict)
    """Attributes whose parameter has another name, and kinds of children that have one beside that of their own."""
    unrun: tuple[str, ...] | None = None
    """The attributes that are read where the file was not run; None: the class is not read at all then."""

    @property
    def short_name(self) -> str:
        """The name without its module."""
        return self.name.rpartition(".")[2]

    def parameter(self, attribute: str) -> str:
        """The parameter that gives an attribute."""
        return "condition" if attribute in ("if", "unless") else self.keywords.get(attribute, attribute)


@dataclass(frozen=True, slots=True, eq=False)
class PythonClasses:
    """All of them."""

    by_kind: Mapping[str, PythonClass]
    """The first class of each kind of action: the others have the same parameters."""
    kinds: Mapping[str, str]
    """The kind of action that each class makes, by its short name, of those that are read without a run."""
    parameters: Mapping[str, str]
    """The parameter that gives the children of a kind that are no objects of their own."""
    holders: frozenset[str]
    """The kinds whose parameter `actions` has actions."""


NO_CLASSES = PythonClasses({}, {}, {}, frozenset())
"""For what is no program."""
