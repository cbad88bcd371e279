"""How hover and completion say what a parameter is."""

import pytest
from preflight_analysis.queries.param_texts import default_text
from preflight_analysis.tracing.interface import ParamUse, Range


@pytest.mark.parametrize(
    ("use", "text"),
    [
        (ParamUse("~a", "get", 10.0, has_default=True), "double, default `10.0`"),
        (
            ParamUse("~a", "get", 5, has_default=True, type="integer", read_only=True, range=Range(0, 10, 5)),
            "integer, default `5`, 0 to 10 in steps of 5, read-only",
        ),
        (ParamUse("~a", "get", type="string array"), "string array"),
        (ParamUse("~a", "get", 1, has_default=True, dynamic=True), "any type, default `1`"),
        (ParamUse("~a", "get", mandatory=True), "no default"),
        (ParamUse("~a", "get"), ""),
    ],
)
def test_what_a_parameter_is(use: ParamUse, text: str) -> None:
    assert default_text(use) == text
