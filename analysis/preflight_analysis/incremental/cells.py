"""What is remembered of one input or query, and of the parts of a value; and what a thread is at."""

from __future__ import annotations

import threading
from collections.abc import Container, Hashable, Iterable, Iterator, Mapping
from typing import Any, NamedTuple

from preflight_analysis.incremental.query import Answers, Input, Key, Query

NONE: Any = object()
"""The value of a cell that has none yet."""


class Cell:
    """One value: of an input, or of a query with the cells that it read, in the order in which it did."""

    __slots__ = (
        "answered_by",
        "answers",
        "changed_at",
        "claimed",
        "depends_on",
        "durable",
        "is_set",
        "key",
        "kind",
        "parts",
        "used_at",
        "value",
        "verified_at",
    )

    def __init__(self, kind: Input[Any, Any] | Query[Any, Any], key: Key) -> None:
        self.kind = kind
        self.key = key
        self.value: Any = NONE
        self.changed_at = 0
        """The revision in which the value became what it is."""
        self.verified_at = 0
        """The last revision in which it was known to be right."""
        self.depends_on: tuple[Cell, ...] = ()
        self.durable = True
        self.claimed = False
        """Whether some thread makes it now."""
        self.is_set = False
        """An input: whether it has another value than it would be loaded with."""
        self.used_at = 0
        """The last revision in which somebody asked for it."""
        self.parts: Parts = {}
        """Of the value, as `Database.part` made them the last time, and parts of those."""
        self.answers: Mapping[Hashable, object] = {}
        """To what the function asked when it was made."""
        self.answered_by: int | None = None
        """The number of those who gave them, or would."""


class Part:
    """What a part came to, the cells that it was made of, what it was answered and the parts that it has itself."""

    __slots__ = ("answers", "depends_on", "durable", "key", "parts", "value", "verified_at")

    def __init__(
        self,
        key: Hashable,
        value: object,
        answers: Mapping[Any, object],
        depends_on: tuple[Cell, ...],
        parts: Parts,
    ) -> None:
        self.key = key
        self.value = value
        self.answers = answers
        self.depends_on = depends_on
        self.parts = parts
        self.durable = False
        self.verified_at = 0


Parts = dict[Hashable, tuple[Part, ...]]
"""By their keys, for each set of answers one, the one that was asked for last in front."""


class Making(NamedTuple):
    """A query that is being made: its cell, the parts so far, of its value and of each part that is being made, the
    innermost last, and what is known of each of these parts for other answers."""

    cell: Cell
    parts: list[Parts]
    known: list[tuple[Part, ...]]


class Asked(NamedTuple):
    """What the function of a cell asks somebody, and was answered."""

    cell: Cell
    by: Answers
    answers: dict[Hashable, object]


class ThreadState(threading.local):
    """What one thread is at."""

    def __init__(self) -> None:
        self.readings = 0
        self.claims = 0
        self.running: set[Cell] = set()
        self.reads: list[dict[Cell, None]] = []
        """Those of the queries that are being made, the innermost last."""
        self.making: list[Making] = []
        """Those queries."""
        self.asked: Asked | None = None


def would_answer(answers: Answers, cell: Cell) -> bool:
    """Whether they would answer what was asked for a cell as it was."""
    known = cell.answered_by is not None and answers.alike(cell.answered_by, cell.answers)
    if not known and any(not same(answers.look(question), answer) for question, answer in cell.answers.items()):
        return False
    cell.answered_by = answers.number
    return True


class NotAsked(BaseException):
    """A function asks what it did not ask the last time. No `Exception`: what it would make of one is no value."""


class AsLastTime:
    """Answers what a cell asked when it was made. It does not know what else its asker would have answered."""

    def __init__(self, number: int, answers: Mapping[Hashable, object]) -> None:
        self.number = number
        self._answers = answers

    def look(self, question: Hashable) -> object:
        """What was answered then. Raises `NotAsked`."""
        try:
            return self._answers[question]
        except KeyError:
            raise NotAsked from None

    def alike(self, number: int, questions: Iterable[object]) -> bool:
        """Whether it is of the same asker."""
        return number == self.number


def same(one: object, other: object) -> bool:
    """Whether two answers are equal and of one type."""
    return type(one) is type(other) and one == other


def are_same(some: Mapping[Hashable, object], others: Mapping[Hashable, object]) -> bool:
    """Whether the same was asked and answered."""
    return some.keys() == others.keys() and all(same(others[key], each) for key, each in some.items())


def read_down_to(cells: Iterable[Cell], kinds: Container[object]) -> Iterator[tuple[object, Key, object]]:
    """As `Database.observing` gives it."""
    left, seen = list(cells), set[Cell]()
    while left:
        cell = left.pop()
        if cell in seen:
            continue
        seen.add(cell)
        if cell.kind in kinds:
            yield cell.kind, cell.key, cell.value
        else:
            left.extend(cell.depends_on)
