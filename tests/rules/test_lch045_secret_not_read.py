"""LCH045: secrets whose values are not read."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.findings.finding import Finding
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Analysis, Workspace

VARIABLES = {"TURTLEBOT3_MODEL": "burger", "API_KEY": "hunter22"}


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    home = tmp_path / "home"
    for name, text in ((".config/license.yaml", "a: hunter22"), (".ros/camera.yaml", "a: 1"), ("ws/a.yaml", "a: 1")):
        (home / name).parent.mkdir(parents=True)
        (home / name).write_text(text)
    monkeypatch.setenv("HOME", str(home))
    return home


def _analysis(home: Path, text: str, name: str = "a.launch", *, outside: bool = True) -> Analysis:
    (home / "ws" / name).write_text(text)
    variables = {**VARIABLES, "HOME": str(home)}
    environment = detect_environment(str(home / "ws"), variables, root=str(home / "nothing"))
    return Workspace(replace(environment, outside=outside), Sources()).static(str(home / "ws" / name))


def _found(analysis: Analysis) -> list[Finding]:
    return [finding for finding in analysis.findings if finding.rule == "LCH045"]


ROS1 = """<launch>
  <rosparam file="{home}/{file}"/>
  <param name="model" value="$({substitution})"/>
</launch>"""
ROS2 = """<launch>
  <node pkg="a" exec="b">
    <param from="{home}/{file}"/>
    <param name="model" value="$({substitution})"/>
  </node>
</launch>"""


@pytest.mark.parametrize(
    ("name", "form", "substitution"),
    [
        ("a.launch", ROS1, "env API_KEY"),
        ("a.launch", ROS1, "optenv API_KEY none"),
        ("a.launch.xml", ROS2, "env API_KEY"),
    ],
)
def test_a_secret_file_and_variable(home: Path, name: str, form: str, substitution: str) -> None:
    text = form.format(home=home, file=".config/license.yaml", substitution=substitution)
    analysis = _analysis(home, text, name)
    file, variable = sorted(_found(analysis), key=lambda finding: finding.location.span)
    assert file.severity == variable.severity == "info"
    assert not file.stops_launch
    assert file.message == (
        f"'{home}/.config/license.yaml' is not read: it is in a dot folder of a home folder; "
        "ROS_PREFLIGHT_ALLOW_SECRETS allows it"
    )
    assert variable.message == (
        "environment variable 'API_KEY' is a secret and is not read; ROS_PREFLIGHT_ALLOW_SECRETS allows it"
    )
    assert "hunter22" not in repr(analysis.tree)
    assert any("'API_KEY' is a secret" in unknown.reason for unknown in analysis.tree.unknowns)


@pytest.mark.parametrize(
    ("name", "form", "substitution"),
    [
        ("a.launch", ROS1, "env TURTLEBOT3_MODEL"),
        ("a.launch", ROS1, "optenv OTHER_KEY default"),
        ("a.launch.xml", ROS2, "env TURTLEBOT3_MODEL"),
        ("a.launch.xml", ROS2, "env OTHER_KEY default"),
    ],
)
@pytest.mark.parametrize("file", [".ros/camera.yaml", "ws/a.yaml"])
@pytest.mark.silent
def test_ordinary_files_and_variables(home: Path, name: str, form: str, substitution: str, file: str) -> None:
    analysis = _analysis(home, form.format(home=home, file=file, substitution=substitution), name)
    assert _found(analysis) == []
    assert not analysis.tree.unknowns
    assert ("burger" in repr(analysis.tree)) == ("TURTLEBOT3" in substitution)


@pytest.mark.silent
def test_what_the_user_allows(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_PREFLIGHT_ALLOW_SECRETS", f"{home}/.config:API_KEY")
    text = ROS1.format(home=home, file=".config/license.yaml", substitution="env API_KEY")
    analysis = _analysis(home, text)
    assert _found(analysis) == []
    assert {param.value for param in analysis.tree.params.values()} == {"hunter22"}


def test_a_workspace_cannot_allow_itself(home: Path) -> None:
    text = ROS1.format(home=home, file=".config/license.yaml", substitution="env API_KEY")
    (home / "ws/a.launch").write_text(text)
    variables = {**VARIABLES, "ROS_PREFLIGHT_ALLOW_SECRETS": f"{home}/.config:API_KEY"}
    environment = detect_environment(str(home / "ws"), variables, root=str(home / "nothing"))
    assert len(_found(Workspace(environment, Sources()).static(str(home / "ws/a.launch")))) == 2


def test_an_include_and_a_command(home: Path) -> None:
    secret = home / ".config/license.yaml"
    text = f'<launch><include file="{secret}"/><param name="a" command="cat {secret}"/></launch>'
    analysis = _analysis(home, text)
    assert len(_found(analysis)) == 2
    assert analysis.tree.commands == ()


def test_without_trust_a_file_outside_is_not_read(home: Path) -> None:
    (home / "license.yaml").write_text("a: ordinary")
    text = ROS1.format(home=home, file="license.yaml", substitution="env TURTLEBOT3_MODEL")
    assert _found(_analysis(home, text)) == []
    (found,) = _found(_analysis(home, text, outside=False))
    assert "outside of the workspace" in found.message
