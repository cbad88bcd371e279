"""xacro by the folder of its package, which is not installed."""

import pytest
from preflight_analysis.environment.own_programs import own_program


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("$(find xacro)/xacro a.xacro", "xacro a.xacro"),
        ("$(find xacro)/xacro.py 'a.xacro' b:=c", None),
        ("\n  $(find xacro)/xacro\n a.xacro", "xacro\n a.xacro"),
        ("$(find arm)/scripts/env_run e.sh $(find xacro)/xacro a.xacro", None),
        ("$(find xacro)/xacro2 a.xacro", None),
        ("$(find xacro)", None),
    ],
)
def test_a_command_line(text: str, found: str | None) -> None:
    assert own_program(text, "$(find xacro)", "xacro") == found


def test_another_package() -> None:
    assert own_program("$(find arm)/arm a", "$(find arm)", "arm") is None
