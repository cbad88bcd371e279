"""The extension's grammar colours the substitutions that there are, and no others."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from preflight_analysis.launch.substitutions import SUBSTITUTIONS
from preflight_analysis.launch.substitutions_ros2 import SUBSTITUTIONS_ROS2

GRAMMAR = Path(__file__).parents[2] / "vscode-client/syntaxes/substitutions.tmLanguage.json"
BEGIN = re.compile(json.loads(GRAMMAR.read_text())["repository"]["substitution"]["begin"])


@pytest.mark.parametrize("name", sorted({*SUBSTITUTIONS, *SUBSTITUTIONS_ROS2}))
def test_every_substitution_is_coloured(name: str) -> None:
    for text in (f"$({name} x)", f"$({name})"):
        found = BEGIN.match(text)
        assert found is not None
        assert found.group(2) == name


def test_a_command_of_a_shell_is_not() -> None:
    assert BEGIN.match("$(ls -l)") is None
    assert BEGIN.match("$(argument x)") is None
