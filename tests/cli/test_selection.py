"""Which rules speak: `--select`, `--extend-select`, `--ignore`, profiles, and the settings."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

pytestmark = pytest.mark.ros
Run = Callable[..., Any]

TEXT = """<launch>
  <arg name="unused" default="10"/>
  <nod/>
  <node pkg="rospy" type="x" name="a" colour="red"/>
  <param name="p" value="$(arg none)"/>
</launch>
"""


@pytest.fixture
def rules(tmp_path: Path, preflight: Run) -> Callable[..., set[str]]:
    workspace = tmp_path / "robots"
    (workspace / ".git").mkdir(parents=True)
    (workspace / "robot.launch").write_text(TEXT)

    def found(*options: str, settings: str = "") -> set[str]:
        (workspace / ".ros-preflight.yaml").write_text(settings)
        done = preflight("check", "robot.launch", "--no-run", "--format", "json", *options, cwd=workspace)
        return {each["rule"] for each in done.json["findings"]}

    return found


def test_rules_and_families_are_selected(rules: Callable[..., set[str]]) -> None:
    every = rules()
    assert {"LCH004", "LCH005", "ARG001"} < every
    assert rules("--select", "ARG") == {rule for rule in every if rule.startswith("ARG")}
    assert rules("--select", "LCH,ARG001", "--ignore", "LCH005") == {"LCH004", "ARG001"} | {
        rule for rule in every if rule.startswith("LCH") and rule != "LCH005"
    }
    assert rules("--ignore", "LCH", "--ignore", "ARG001") == {
        rule for rule in every if not rule.startswith("LCH") and rule != "ARG001"
    }
    assert rules("--select", "LCH005", "--ignore", "LCH") == {"LCH005"}, "the nearer name counts"


def test_the_settings_select_too_and_the_command_counts_more(rules: Callable[..., set[str]]) -> None:
    every = rules()
    assert rules(settings="select: [ARG]\nignore: [ARG001]\n") == {
        rule for rule in every if rule.startswith("ARG") and rule != "ARG001"
    }
    assert rules("--extend-select", "LCH004", settings="select: [ARG001]\n") == {"ARG001", "LCH004"}
    assert rules("--select", "LCH004", settings="select: [ARG001]\n") == {"LCH004"}
    assert rules("--select", "LCH004", settings="paths: [{path: robot.launch, ignore: [LCH004]}]\n") == set()
    assert rules(settings="paths: [{path: robot.launch, select: [LCH004]}]\n") == {"LCH004"}
    assert rules(settings="severities: {all: off, LCH: on}\n") == {rule for rule in every if rule.startswith("LCH")}
    assert "LCH031" in rules(settings="select: [XYZ]\n"), "an unknown family is told"


def test_profiles(rules: Callable[..., set[str]], tmp_path: Path, preflight: Run) -> None:
    every = rules()
    stopping = rules("--profile", "launch")
    assert {"ARG001"} <= stopping < every
    assert rules(settings="profile: launch\n") == stopping
    assert rules("--profile", "default", settings="profile: launch\n") == every
    workspace = tmp_path / "robots"
    (workspace / "warned.launch").write_text('<launch><node pkg="rospy" type="x" name="a" colour="red"/></launch>')

    def code(*options: str, settings: str = "") -> int:
        (workspace / ".ros-preflight.yaml").write_text(settings)
        done = preflight("check", "warned.launch", "--no-run", "--select", "LCH005", *options, cwd=workspace)
        found: int = done.code
        return found

    assert (code(), code("--profile", "strict"), code(settings="profile: strict\n")) == (0, 1, 1)
    assert code("--profile", "strict", "--fail-on", "error") == 0, "what is said outright counts"


def test_what_is_no_rule_is_said(preflight: Run) -> None:
    done = preflight("check", "--select", "LHC")
    assert done.code == 2
    assert "'LHC' is neither a rule nor one of the families" in done.err


def test_statistics(preflight: Run, tmp_path: Path, rules: Callable[..., set[str]]) -> None:
    rules()
    done = preflight("check", "robot.launch", "--no-run", "--statistics", "--select", "LCH", cwd=tmp_path / "robots")
    lines = done.out.splitlines()
    assert "LCH004 unknown-element: 1 warning, 1 fixed by --fix" in lines
    assert not any("robot.launch:3" in line for line in lines[:-2])
