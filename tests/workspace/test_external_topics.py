"""Topics that the settings file declares external."""

from __future__ import annotations

from pathlib import Path

from preflight_analysis.environment.model import Environment
from preflight_analysis.tracing.interface import NOT_RUN
from preflight_analysis.workspace.project_settings import read_project_settings
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

LAUNCH = """<launch>
<node pkg="p" type="t" name="a"><topics><topic name="/teleop/joy" type="x/Joy" class="sub"/></topics></node>
<node pkg="p" type="t" name="b"><topics><topic name="/teleop/joyy" type="x/Joy" class="pub"/></topics></node>
</launch>"""


def rules(folder: Path, settings: str | None) -> list[str]:
    (folder / "a.launch").write_text(LAUNCH)
    if settings is not None:
        (folder / ".ros-preflight.yaml").write_text(settings)
    environment = Environment(1, "noetic", {}, (), {}, {}, (), (), None, str(folder))
    workspace = Workspace(environment, Sources(), str(folder))
    static = workspace.static(str(folder / "a.launch"))
    found = workspace.with_interfaces(static, [NOT_RUN, NOT_RUN], None).findings
    return sorted(finding.rule for finding in found if finding.rule.startswith("TOP"))


def test_without_settings_the_dangling_ends_are_found(tmp_path: Path) -> None:
    assert rules(tmp_path, None) == ["TOP001"]


def test_an_external_topic_does_not_dangle(tmp_path: Path) -> None:
    assert rules(tmp_path, "external: {topics: [/teleop/joy]}") == ["TOP002"], "the other one is still nobody's"
    assert rules(tmp_path, "external: {topics: ['teleop/*']}") == []


def test_what_is_wrong_in_it_is_told_with_its_line(tmp_path: Path) -> None:
    (tmp_path / ".ros-preflight.yaml").write_text(
        "external:\n  topic: [/a]\n  topics:\n    - /ok\n    - {a: b}\nother: 1\n"
    )
    settings = read_project_settings(str(tmp_path))
    assert settings.external_topics == ("/ok",)
    assert [(p.line, p.message.partition(";")[0]) for p in settings.problems] == [
        (2, "'topic' does not belong into external"),
        (5, "a topic is a name or a pattern"),
        (6, "'other' is no setting"),
    ]
