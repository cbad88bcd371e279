"""LCH031: something in the settings file is not understood."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.model import Environment
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

GOOD = """external: {topics: [/a]}
roots: [a.launch]
nodes:
  - package: p
    executable: t
    topics: [{name: chatter, type: std_msgs/String, class: pub}]
"""


def settings_findings(folder: Path, settings: str) -> list[tuple[str, str, str, str]]:
    """Rule, severity, message and the text underlined, of the findings in the settings file."""
    (folder / "a.launch").write_text("<launch/>")
    path = folder / ".ros-preflight.yaml"
    path.write_bytes(settings.encode())
    workspace = Workspace(Environment(1, "noetic", {}, (), {}, {}, (), (), None, str(folder)), Sources())
    analysis = workspace.with_interfaces(workspace.static(str(folder / "a.launch")), [], None)
    found = []
    for finding in analysis.findings:
        start, end = finding.location.span
        text = analysis.documents[finding.location.file].text[start:end]
        assert finding.location.file == str(path)
        found.append((finding.rule, finding.severity, finding.message, text))
    return found


def test_what_is_wrong_in_it_is_a_finding_at_its_place(tmp_path: Path) -> None:
    assert settings_findings(tmp_path, "external:\r\n  topic: [/a]  \r\nroots: 1\r\n") == [
        (
            "LCH031",
            "warning",
            "unknown key 'topic' of 'external'; expected topics",
            "topic: [/a]",
        ),
        ("LCH031", "warning", "invalid value of 'roots': expected a list of launch files", "roots: 1"),
    ]
    ((rule, _, message, _),) = settings_findings(tmp_path, "external: [\n")
    assert rule == "LCH031"
    assert message.startswith(("invalid", "expected", "while"))
    ((_, _, message, text),) = settings_findings(tmp_path, "a\0")
    assert ("is not a text file" in message, text) == (True, "")


def test_what_several_roots_say_of_it_is_said_of_one_place(tmp_path: Path) -> None:
    (tmp_path / ".ros-preflight.yaml").write_text("roots: 1\n")
    workspace = Workspace(Environment(1, "noetic", {}, (), {}, {}, (), (), None, str(tmp_path)), Sources())
    places = []
    for name in ("a.launch", "b.launch"):
        (tmp_path / name).write_text("<launch/>")
        analysis = workspace.with_interfaces(workspace.static(str(tmp_path / name)), [], None)
        places += [finding.location for finding in analysis.findings]
    assert len(places) == 2
    assert len(set(places)) == 1


@pytest.mark.silent
def test_a_settings_file_that_is_understood_is_no_finding(tmp_path: Path) -> None:
    assert settings_findings(tmp_path, GOOD) == []
    assert settings_findings(tmp_path, "") == []
