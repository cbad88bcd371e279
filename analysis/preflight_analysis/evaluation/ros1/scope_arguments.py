"""The arguments that a scope sees. Those from around it are asked for when somebody wants to know: what an included
file or a tag comes to depends on these alone."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location, Origin
from preflight_analysis.evaluation.before import Question


@dataclass(frozen=True, slots=True)
class ArgValue:
    """An argument as seen in a scope. `text` None: not known (something it depends on is missing)."""

    text: str | None
    origin: Origin | None
    """Where the value was given; None for the command line."""


class _Seen(NamedTuple):
    """What there is of a name: its value, and where the file declares it."""

    value: ArgValue | None
    declaration: Location | None


_NOTHING = _Seen(None, None)


class Arguments:
    """What was given to a file, or to a part of it, and what is declared there. `ask` tells what is around it, as
    `look` of that; None: there is nothing."""

    __slots__ = ("_ask", "_seen", "declared")

    def __init__(self, ask: Callable[..., Any] | None = None, values: Mapping[str, ArgValue] | None = None) -> None:
        self._ask = ask
        self._seen = {name: _Seen(value, None) for name, value in values.items()} if values is not None else {}
        """What is set here, and what is known of that around."""
        self.declared: dict[str, Location] = {}
        """`<arg>` tags seen here so far, by name; those around it are not among them."""

    def child(self) -> Arguments:
        """The same for a scope below this one. What is set inside stays inside."""
        child = Arguments(self._ask)
        child._seen, child.declared = self._seen.copy(), self.declared.copy()
        return child

    def get(self, name: str) -> ArgValue | None:
        """The value of an argument; None for one that has none."""
        return self._look(name).value

    def declaration(self, name: str) -> Location | None:
        """Where the file declares an argument."""
        return self._look(name).declaration

    def set(self, name: str, value: ArgValue) -> None:
        """Give an argument a value."""
        self._seen[name] = _Seen(value, self._look(name).declaration)

    def declare(self, name: str, at: Location) -> None:
        """Note where an argument is declared, the first time that it is."""
        known = self._look(name)
        if known.declaration is None:
            self.declared[name] = at
            self._seen[name] = _Seen(known.value, at)

    @property
    def given(self) -> dict[str, ArgValue]:
        """All that have a value."""
        given: dict[str, ArgValue] = {} if self._ask is None else dict(self._ask("all"))
        given.update((name, seen.value) for name, seen in self._seen.items() if seen.value is not None)
        return given

    @property
    def given_names(self) -> frozenset[str]:
        """The names of those that have a value."""
        around: frozenset[str] = frozenset() if self._ask is None else self._ask("given names")
        return around.union(name for name, seen in self._seen.items() if seen.value is not None)

    @property
    def declared_names(self) -> frozenset[str]:
        """The names of those that the file declares."""
        around: frozenset[str] = frozenset() if self._ask is None else self._ask("declared names")
        return around.union(self.declared)

    def look(self, question: Question) -> object:
        """What is answered to a part of this scope."""
        match question:
            case ("argument", str(name)):
                return self._look(name)
            case ("all",):
                return self.given
            case ("given names",):
                return self.given_names
            case _:
                return self.declared_names

    def _look(self, name: str) -> _Seen:
        seen = self._seen.get(name)
        if seen is None:
            seen = self._seen[name] = _NOTHING if self._ask is None else self._ask("argument", name)
        return seen


class PassedArguments:
    """The arguments that an include passes, for those who ask for them in the included file."""

    def __init__(self, arguments: Arguments) -> None:
        self.number = next(_NUMBERS)
        self._arguments = arguments.child()

    def look(self, question: Question) -> object:
        """What is answered."""
        return self._arguments.look(question)

    def alike(self, number: int, questions: Iterable[object]) -> bool:
        """Whether it is of the same include."""
        return number == self.number


_NUMBERS = itertools.count()
