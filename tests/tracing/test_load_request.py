"""The request by which a container loads a component, of values that no parameter can have."""

from __future__ import annotations

from typing import Any

import pytest
from preflight_analysis.tracing.load_request import load_request
from preflight_analysis.tracing.request import Component, TraceRequest


def asked(params: dict[str, Any], name: str = "n") -> bytes:
    """The request for a component with these parameters."""
    given = {f"/{name}/{param}": value for param, value in params.items()}
    component = Component("p::C", "/bin/container", "/box")
    return load_request(TraceRequest(f"/{name}", "p", "/lib.so", params=given, generation=2, component=component))


@pytest.mark.parametrize(
    "value", [10**40, -(2**63) - 1, [1, "a"], [1, True], [], [[1]], {"a": 1}, None, b"x", [2**63], ()], ids=repr
)
def test_what_is_no_parameter_is_left_out(value: Any) -> None:
    assert asked({"odd": value, "plain": 1}) == asked({"plain": 1})


@pytest.mark.parametrize(
    "value", [True, 2**63 - 1, -(2**63), float("nan"), float("-inf"), "", "a\0b", "\ud800", [True], [0.5], ["a", ""]]
)
def test_what_is_one_is_in_it(value: Any) -> None:
    assert len(asked({"odd": value})) > len(asked({})) + len("odd")


def test_names_end_at_a_zero_as_in_c() -> None:
    assert asked({"a\0b": 1}) == asked({"a": 1})
    assert asked({}, "n\0m") == asked({}, "n")
