"""Inputs and queries: what a `Database` remembers, by kind."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from typing import Any, Concatenate, Generic, ParamSpec, Protocol, TypeVar, cast, overload

P = ParamSpec("P")
V = TypeVar("V")
Key = tuple[Hashable, ...]


class Answers(Protocol):
    """Of one who is asked by queries."""

    @property
    def number(self) -> int:
        """Names the answers: who has the same gives the same."""

    def look(self, question: Any, /) -> Any:
        """What is answered."""

    def alike(self, number: int, questions: Iterable[Any], /) -> bool:
        """Whether it is known, without asking, that those of that number answer all these questions alike."""


class Reads(Protocol):
    """Of a `Database`, what it is asked for values with."""

    def read(self, kind: Any, key: Key, /) -> object:
        """As `Query.__call__`."""

    def read_answered(self, kind: Any, keys: Sequence[Key], answers: Answers, /) -> list[object]:
        """As `Query.answered_each`."""

    def last(self, kind: Any, key: Key, /) -> object:
        """As `Query.last`."""


class Input(Generic[P, V]):
    """A kind of input. `load` reads the one of a key from outside, when it is first asked for; equal values are one.

    `durable`: it seldom changes. What depends on such inputs alone is not looked through on each change of others.
    """

    def __init__(self, load: Callable[P, V], *, durable: bool = True) -> None:
        self.load = load
        self.limit = None
        self.durable = durable
        self.name = load.__name__

    def __call__(self, db: Reads, /, *key: P.args, **none: P.kwargs) -> V:
        """The value as it is in this revision."""
        _refuse(none)
        return cast(V, db.read(self, key))

    def __repr__(self) -> str:
        return f"Input({self.name})"


class Query(Generic[P, V]):
    """A derived value, made by `function`. `limit`: how many are remembered, those that were asked for last; None: all
    that are asked for now and then."""

    def __init__(self, function: Callable[Concatenate[Any, P], V], limit: int | None = None) -> None:
        self.function = function
        self.limit = limit
        self.name = function.__name__
        self.__doc__ = function.__doc__

    def __call__(self, db: Reads, /, *key: P.args, **none: P.kwargs) -> V:
        """The value as it is in this revision. Raises what the function raises; that is not remembered."""
        _refuse(none)
        return cast(V, db.read(self, key))

    def answered(self, db: Reads, answers: Answers, /, *key: P.args, **none: P.kwargs) -> V:
        """The value for one who answers what the function asks (`Database.ask`). It is remembered with the questions
        and their answers, for all who would answer them alike. Where a query answers, what it answers follows from
        what it has read so far."""
        _refuse(none)
        return cast(V, db.read_answered(self, (key,), answers)[0])

    def answered_each(self, db: Reads, answers: Answers, /, keys: Sequence[Key]) -> list[V]:
        """As `answered` for each of many keys, all in one revision."""
        return cast(list[V], db.read_answered(self, keys, answers))

    def last(self, db: Reads, /, *key: P.args, **none: P.kwargs) -> V | None:
        """The value that was last made, whether it is still right or not; None where there is none."""
        _refuse(none)
        return cast("V | None", db.last(self, key))

    def __repr__(self) -> str:
        return f"Query({self.name})"


@overload
def query(function: Callable[Concatenate[Any, P], V]) -> Query[P, V]: ...


@overload
def query(*, limit: int) -> Callable[[Callable[Concatenate[Any, P], V]], Query[P, V]]: ...


def query(function: Callable[..., Any] | None = None, *, limit: int | None = None) -> Any:
    """Make a function a query."""
    return Query(function, limit) if function is not None else lambda function: Query(function, limit)


def _refuse(keywords: Mapping[str, object]) -> None:
    if keywords:
        raise TypeError("a key is given by places: names are no part of it")
