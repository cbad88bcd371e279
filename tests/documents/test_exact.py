"""What Python takes for equal and a node does not is not equal where it stands in a tree."""

from __future__ import annotations

from typing import Any

import pytest
from preflight_analysis.documents.span import Span
from preflight_analysis.evaluation.ros2.param_files import FileParam
from preflight_analysis.evaluation.tree import Param
from preflight_analysis.launch.model import Typed
from preflight_analysis.tracing.interface import ParamUse

DIFFERENT = [
    (1, 1.0),
    (1, True),
    (0.0, -0.0),
    ([1, 2], [1, 2.0]),
    ({"a": {"b": 0}}, {"a": {"b": False}}),
    ({"a": 1, "b": 2}, {"b": 2, "a": 1}),
]


def holders(value: Any) -> tuple[object, ...]:
    nowhere = Span(0, 0)
    return (
        Param("/p", value, ()),
        Param("/p", 0, (), overrides=(Param("/p", value, ()),)),
        Param("/p", 0, (), by_launch=value),
        FileParam("p", value, None, nowhere, nowhere),
        Typed(value),
        ParamUse("p", "get", value),
    )


@pytest.mark.parametrize(("one", "other"), DIFFERENT, ids=repr)
def test_values_of_other_types_are_others(one: object, other: object) -> None:
    for first, second in zip(holders(one), holders(other), strict=True):
        assert first != second
        assert not first == second  # noqa: SIM201 - both operators are told apart
        assert (first,) != (second,)


@pytest.mark.parametrize("value", [1, 2.5, True, "x", b"x", None, [1, {"a": 2.0}]], ids=repr)
def test_the_same_values_are_equal(value: object) -> None:
    for first, second in zip(holders(value), holders(value), strict=True):
        assert first == second
        assert not first != second  # noqa: SIM202 - both operators are told apart


def test_a_value_nested_too_deeply_to_be_compared_is_another_one() -> None:
    nested: list[Any] = []
    for _ in range(100_000):
        nested = [nested]
    assert Typed([1]) != Typed(nested)
