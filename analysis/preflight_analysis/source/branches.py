"""Both branches of a condition that is not known: what each sets is taken back, what they agree on counts after it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from preflight_analysis.dataclass import dataclass
from preflight_analysis.source.python_values import UNKNOWN, is_plain, known

_ABSENT = object()
_Key = tuple[int, str]


class ExitError(Exception):
    """The program that is gone through ends here."""


@dataclass(frozen=True, slots=True)
class Change:
    """What one branch of a condition did to a name in a dictionary."""

    names: dict[str, Any]
    name: str
    old: Any
    new: Any


Changes = dict[_Key, Change]


class Branches:
    """Keeps a trail of what is stored while a branch is tried out."""

    def __init__(self) -> None:
        self._trails: list[list[tuple[dict[str, Any], str, Any]]] = []
        self.late = False
        """Whether only callbacks are left."""
        self.caught = False
        """Whether the function catches what is thrown here, and goes on."""

    @property
    def speculative(self) -> bool:
        """Whether what is done now may well not be done: in one branch of a condition, or in a callback."""
        return self.late or self.inside

    @property
    def inside(self) -> bool:
        """Whether a branch is being tried out: what is done then may well not be done."""
        return bool(self._trails)

    def store(self, names: dict[str, Any], name: str, value: Any) -> None:
        """Set a name in a dictionary. Whatever is set without this is not taken back."""
        for trail in self._trails[-1:]:
            trail.append((names, name, names.get(name, _ABSENT)))
        names[name] = value

    def try_out(self, branch: Callable[[], bool]) -> tuple[bool, Changes]:
        """Go through one branch and take back what it set: whether it ends (what follows is not reached), and what it
        set."""
        trail: list[tuple[dict[str, Any], str, Any]] = []
        self._trails.append(trail)
        try:
            ended = branch()
        except ExitError:
            ended = True
        finally:
            self._trails.pop()
        new = {(id(names), name): names.get(name, _ABSENT) for names, name, _ in trail}
        found: Changes = {}
        for names, name, old in reversed(trail):
            if old is _ABSENT:
                names.pop(name, None)
            else:
                names[name] = old
            key = id(names), name
            found[key] = Change(names, name, old, new[key])
        return ended, found

    def either(self, first_branch: Callable[[], bool], second_branch: Callable[[], bool]) -> bool:
        """Go through both branches, one of which is taken: whether both end."""
        ended, first = self.try_out(first_branch)
        other_ended, second = self.try_out(second_branch)
        if ended and other_ended:
            return True
        for key, change in {**first, **second}.items():
            ours = first[key].new if key in first else change.old
            theirs = second[key].new if key in second else change.old
            if ended or ours is _ABSENT:
                value = theirs
            elif other_ended or theirs is _ABSENT:
                value = ours
            else:
                value = same(ours, theirs)
            if value is not _ABSENT:
                self.store(change.names, change.name, value)
        return False

    def maybe_value(self, expression: Callable[[], Any]) -> Any:
        """Go through an expression that may not be computed, as the second part of `a and b`: its value if it is."""
        values: list[Any] = []

        def branch() -> bool:
            values.append(expression())
            return False

        self.either(branch, lambda: False)
        return values[0] if values else UNKNOWN

    def either_value(self, first: Callable[[], Any], second: Callable[[], Any]) -> Any:
        """Go through two expressions, one of which is computed: the value that they agree on."""
        values: list[Any] = []

        def branch(expression: Callable[[], Any]) -> bool:
            values.append(expression())
            return False

        self.either(lambda: branch(first), lambda: branch(second))
        return same(*values) if len(values) == 2 else UNKNOWN


def same(value: Any, other: Any) -> Any:
    """What two branches agree on."""
    if value is other:
        return value
    value, other = known(value), known(other)
    comparable = is_plain(value) or not isinstance(value, (list, tuple, dict))
    return value if comparable and type(value) is type(other) and value == other else UNKNOWN
