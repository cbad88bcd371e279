"""Our classes of values are made by `preflight_analysis.dataclass`, which does as the standard library's does."""

from __future__ import annotations

import copy
import dataclasses
import itertools
import operator
import pickle
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import preflight_analysis
import preflight_server
import pytest
from preflight_analysis.dataclass import dataclass

OPTIONS: list[dict[str, bool]] = [
    {},
    {"slots": True},
    {"frozen": True},
    {"frozen": True, "slots": True},
    {"frozen": True, "slots": True, "eq": False},
    {"eq": False, "slots": True},
    {"frozen": True, "slots": True, "repr": False},
]
NAN = float("nan")


class Silent:
    """A value that equals nothing, not even itself."""

    def __eq__(self, other: object) -> bool:
        return False

    __hash__ = object.__hash__


ALIKE = Silent()


def kinds(make: Callable[..., Any], options: dict[str, bool]) -> list[tuple[Any, list[tuple[Any, ...]]]]:
    """Classes, each with arguments to make objects of it."""
    deco = make(**options)

    @deco
    class Empty:
        pass

    @deco
    class One:
        a: Any

    @deco
    class Several:
        a: Any
        b: Any = 2
        unseen: int = dataclasses.field(default=3, compare=False, repr=False)
        made: list[int] = dataclasses.field(default_factory=list, init=False, compare=False)

    @deco
    class Derived(One):
        b: int = 0

    @deco
    class Own:
        a: Any

        def __repr__(self) -> str:
            return "own"

        def __hash__(self) -> int:
            return 7

    @deco
    class Judging:
        a: Any

        def __eq__(self, other: object) -> bool:
            return isinstance(other, Judging)

    values = [(1,), ((1, 2),), (NAN,), (ALIKE,), ("a%s",), (None,)]
    several = [*values, (1, 3), (1, 2, 4), (2, 1)]
    return [(Empty, [()]), (One, values), (Several, several), (Derived, values), (Own, values), (Judging, values)]


def told(function: Callable[..., Any], *arguments: Any) -> Any:
    try:
        return function(*arguments)
    except TypeError as error:
        return re.sub(r"'[^']*'|\S*__init__", "", str(error))


@pytest.mark.parametrize("options", OPTIONS, ids=str)
def test_classes_are_as_those_of_the_standard_library(options: dict[str, bool]) -> None:
    for (ours, arguments), (theirs, _) in zip(
        kinds(dataclass, options), kinds(dataclasses.dataclass, options), strict=True
    ):
        one, other = ([kind(*each) for each in arguments] for kind in (ours, theirs))
        if options.get("repr", True):
            assert [repr(each) for each in one] == [repr(each) for each in other]
        for compare in (operator.eq, operator.ne):
            assert [told(compare, *pair) for pair in itertools.product(one, repeat=2)] == [
                told(compare, *pair) for pair in itertools.product(other, repeat=2)
            ], compare
        assert [each == 1 for each in one] == [False] * len(one)
        assert isinstance(told(hash, one[0]), int) == isinstance(told(hash, other[0]), int)
        for a, b in itertools.product(one, repeat=2):
            if a == b and isinstance(told(hash, a), int) and ours.__name__ != "Judging":
                assert hash(a) == hash(b)
        assert told(ours, *"abcdef") == told(theirs, *"abcdef")
        assert ours.__match_args__ == theirs.__match_args__
        assert hasattr(one[0], "__dict__") == hasattr(other[0], "__dict__")
        assert [field.name for field in dataclasses.fields(ours)] == [
            field.name for field in dataclasses.fields(theirs)
        ]


@dataclass(frozen=True, slots=True)
class Kept:
    a: int
    b: tuple[str, ...] = ()


def test_values_can_be_copied_replaced_and_pickled() -> None:
    kept = Kept(1, ("a",))
    assert pickle.loads(pickle.dumps(kept)) == copy.deepcopy(kept) == dataclasses.replace(kept, a=1) == kept
    assert {kept: 1}[Kept(1, ("a",))] == 1


def test_nothing_else_makes_classes_of_values() -> None:
    folders = [Path(package.__file__ or "").parent for package in (preflight_analysis, preflight_server)]
    others = [
        str(path.relative_to(folder))
        for folder in folders
        for path in folder.rglob("*.py")
        if re.search(r"^from dataclasses import .*\bdataclass\b|\bdataclasses\.dataclass\(", path.read_text(), re.M)
    ]
    assert {name for name in others if not name.startswith("tracing/agents/")} == {"dataclass.py"}
