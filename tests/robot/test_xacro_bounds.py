"""What reading xacro costs grows with the length of a file, whatever is in it."""

import time

import pytest
from preflight_analysis.robot.xacro import is_made_of
from support.descriptions import findings, xacro

HOSTILE = {
    "unclosed braces": "${" * 60_000,
    "dollars": "$" * 120_000,
    "unclosed brackets": "$(" * 60_000,
    "braces": "{" * 120_000,
    "dollars in braces": "({$" * 40_000,
    "expressions": "${a} " * 10_000,
}


@pytest.mark.parametrize("text", HOSTILE.values(), ids=HOSTILE.keys())
def test_a_long_name(text: str) -> None:
    began = time.process_time()
    findings({"r.xacro": xacro(f'<link name="{text}"/><xacro:include filename="{text}"/>')})
    assert time.process_time() - began < 5, "it was minutes"


@pytest.mark.parametrize(
    ("text", "pieces", "fits"),
    [
        ("arm_left.xacro", ["arm_", ".xacro"], True),
        ("arm.xacro", ["arm_", ".xacro"], False),
        ("aXbXc", ["a", "b", "c"], True),
        ("ab", ["ab", "b"], False),
        ("acb", ["a", "b", "b"], False),
        ("a" * 3_000 + "b", ["", *["a"] * 40, "c"], False),
    ],
)
def test_a_text_made_of_pieces(text: str, pieces: list[str], fits: bool) -> None:
    assert is_made_of(text, pieces) == fits
