"""Whether a file will be in the share folder of its package: asked of the rule, hover and completion."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.queries.completion_paths import listed
from preflight_analysis.queries.hover import hover
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Analysis, Workspace
from support.unbuilt_packages import create_unbuilt_packages


@pytest.fixture
def analysis(tmp_path: Path) -> Analysis:
    workspace = create_unbuilt_packages(tmp_path)
    environment = detect_environment(str(workspace), {}, root=str(workspace / "nothing"))
    return Workspace(environment, Sources()).static(str(workspace / "src/robot/launch/robot.launch.xml"))


def hovered(analysis: Analysis, written: str) -> str:
    text = analysis.documents[analysis.root].text
    found = hover([analysis], analysis.root, text.index(written) + 1)
    return found.markdown if found is not None else ""


def test_rule_and_hover_say_the_same_of_a_file(analysis: Analysis) -> None:
    for name in ("robot)/config/driver.yaml", "arm)/cfg/arm.yaml"):
        at = analysis.documents[analysis.root].text.index(name)
        (said,) = [f for f in analysis.findings if f.rule == "PKG005" and f.location.span.contains(at)]
        assert said.message.removeprefix("f").replace("_", "\\_") in hovered(analysis, name)
    for name in ("robot)/params/renamed.yaml", "arm)/config/arm.yaml"):
        assert "not installed" not in hovered(analysis, name)


def test_completion_has_what_is_installed(analysis: Analysis) -> None:
    def offered(package: str, below: str) -> list[tuple[str, str]]:
        folder = f"{analysis.environment.packages[package].share}{below}"
        written = f"$(find-pkg-share {package}){below}"
        return [(each.label, each.detail) for each in listed(analysis.context, written, folder, (".yaml",))]

    assert [name for name, _ in offered("robot", "")] == ["config/", "launch/", "params/", "resource/", "robot/"]
    assert offered("robot", "/config") == [("driver.yaml", "not installed"), ("renamed.yaml", "not installed")]
    assert offered("robot", "/params") == [("renamed.yaml", "")]
    assert offered("arm", "/config") == [("arm.yaml", "")]
    assert offered("arm", "/cfg") == [("arm.yaml", "not installed")]
