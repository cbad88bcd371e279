"""Severities that the settings want instead of the rules' own."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.model import Environment
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

MAIN = '<launch>\n  <nod/>\n  <include file="$(dirname)/third/party.launch"/>\n</launch>\n'
PARTY = '<launch>\n  <nod/>\n  <param name="p" value="$(arg gone)"/>\n</launch>\n'
UNKNOWN = "LCH004"


def severities(folder: Path, settings: str) -> list[tuple[str, str, str]]:
    (folder / "third").mkdir(exist_ok=True)
    (folder / "third" / "party.launch").write_text(PARTY)
    (folder / "main.launch").write_text(MAIN)
    (folder / ".ros-preflight.yaml").write_text(settings)
    workspace = Workspace(Environment(1, "noetic", {}, (), {}, {}, (), (), None, str(folder)), Sources())
    static = workspace.static(str(folder / "main.launch"))
    found = workspace.with_interfaces(static, [], None).findings
    assert static.findings == found
    return [(Path(f.location.file).name, f.rule, f.severity) for f in found]


OWN = [("main.launch", UNKNOWN, "warning"), ("party.launch", UNKNOWN, "warning"), ("party.launch", "ARG001", "error")]


@pytest.mark.parametrize(
    ("settings", "found"),
    [
        ("", OWN),
        ("severities: {}", OWN),
        ("severities: {LCH004: off}", OWN[2:]),
        ("severities: {LCH004: error}", [(file, rule, "error") for file, rule, _ in OWN]),
        ("severities: {all: hint, ARG001: info}", [*((f, r, "hint") for f, r, _ in OWN[:2]), (*OWN[2][:2], "info")]),
        ("paths: [{path: third, severities: {all: off}}]", OWN[:1]),
        ("paths: [{path: third/, severities: {all: off}}]", OWN[:1]),
        ("paths: [{path: 'th*.launch', severities: {all: off}}]", OWN[:1]),
        ("paths: [{path: thi, severities: {all: off}}]", OWN),
        ("paths: [{path: '*', severities: {all: off}}, {path: third, severities: {ARG001: error}}]", OWN[2:]),
        ("paths: [{path: main.launch, severities: {LCH004: warning}}]\nseverities: {all: off}", OWN[:1]),
    ],
)
def test_severities(tmp_path: Path, settings: str, found: list[tuple[str, str, str]]) -> None:
    assert severities(tmp_path, settings) == found


def test_a_change_of_the_settings_counts_at_once(tmp_path: Path) -> None:
    folder = str(tmp_path)
    (tmp_path / "main.launch").write_text("<launch><nod/></launch>")
    workspace = Workspace(Environment(1, "noetic", {}, (), {}, {}, (), (), None, folder), Sources())
    assert [f.severity for f in workspace.static(f"{folder}/main.launch").findings] == ["warning"]
    (tmp_path / ".ros-preflight.yaml").write_text("severities: {LCH004: error}")
    assert [f.severity for f in workspace.static(f"{folder}/main.launch").findings] == ["error"]
