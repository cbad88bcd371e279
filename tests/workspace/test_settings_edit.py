"""Edits of the settings file: nothing of what is written there is lost."""

from __future__ import annotations

import pytest
from preflight_analysis.edits.edit import applied
from preflight_analysis.workspace.settings_edit import turn_off

FILE = "/ws/launch/robot.launch"
SETTINGS = "/ws/.ros-preflight.yaml"


def edited(text: str, rule: str = "TOP001", file: str | None = None) -> str:
    found = turn_off("/ws", SETTINGS, text, rule, file)
    assert found is not None
    return applied(text, [found])


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("", "severities:\n  TOP001: off\n"),
        ("# ours\n", "# ours\nseverities:\n  TOP001: off\n"),
        ("# ours", "# ours\nseverities:\n  TOP001: off\n"),
        ("roots: [a.launch]  # one\n# end\n", "roots: [a.launch]  # one\nseverities:\n  TOP001: off\n# end\n"),
        ("severities:\n", "severities:\n  TOP001: off\n"),
        (
            "severities:\n    TOP002: off # x\n\nroots: []",
            "severities:\n    TOP002: off # x\n    TOP001: off\n\nroots: []",
        ),
        ("severities: {TOP002: off }\n", "severities: {TOP002: off, TOP001: off }\n"),
        ("severities: {}\n", "severities: {TOP001: off}\n"),
        ("severities:\n  TOP001: hint  # for now\n", "severities:\n  TOP001: off  # for now\n"),
        ("severities:\r\n  TOP002: off\r\n", "severities:\r\n  TOP002: off\r\n  TOP001: off\r\n"),
        ("{roots: []}", "{roots: [], severities: {TOP001: off}}"),
    ],
)
def test_a_rule_is_turned_off_in_the_workspace(before: str, after: str) -> None:
    assert edited(before) == after


ENTRY = "  - path: launch/robot.launch\n    severities: {TOP001: off}\n"


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("", f"paths:\n{ENTRY}"),
        ("paths:\n", f"paths:\n{ENTRY}"),
        (
            "paths:\n  - path: third_party  # not ours\n    severities:\n      all: off\nroots: []\n",
            "paths:\n  - path: third_party  # not ours\n    severities:\n      all: off\n" + ENTRY + "roots: []\n",
        ),
        (
            "paths:\n  - path: launch/robot.launch\n    severities: {ARG001: off}\n",
            "paths:\n  - path: launch/robot.launch\n    severities: {ARG001: off, TOP001: off}\n",
        ),
        ("paths: []\n", "paths: [{path: launch/robot.launch, severities: {TOP001: off}}]\n"),
    ],
)
def test_a_rule_is_turned_off_in_a_file(before: str, after: str) -> None:
    assert edited(before, file=FILE) == after


def test_a_later_entry_that_says_otherwise_gets_another_behind_it() -> None:
    text = "paths:\n" + ENTRY.replace("off", "hint") + "  - path: launch\n    severities: {TOP001: error}\n"
    assert edited(text, file=FILE) == text + ENTRY


@pytest.mark.silent
@pytest.mark.parametrize("text", ["[1, 2]", "a: [", "text", "severities: 5\n", "severities: [a]\n"])
def test_what_is_no_settings_file_is_left_alone(text: str) -> None:
    assert turn_off("/ws", SETTINGS, text, "TOP001", None) is None
