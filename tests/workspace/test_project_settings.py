"""What the settings file says of topics and nodes."""

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
        (2, "unknown key 'topic' of 'external'"),
        (5, "invalid item of 'topics': expected a name or a pattern"),
        (6, "unknown setting 'other'"),
    ]


NODES = """nodes:
  - package: p
    executable: t
    topics: [{name: chatter, type: std_msgs/String, class: pub}]
    params: [{name: ~rate, default: 10}]
  - name: /b
    services: [{name: reset, type: std_srvs/Empty, class: server}]
"""


def test_nodes_that_cannot_be_run_are_known_from_the_settings(tmp_path: Path) -> None:
    (tmp_path / "a.launch").write_text(
        '<launch><node pkg="p" type="t" name="a"/><node pkg="q" type="t" name="b"/><node pkg="p" type="u" name="c"/>'
        '<node pkg="p" type="t" name="d"><topics><topic name="own" type="*" class="sub"/></topics></node></launch>'
    )
    (tmp_path / ".ros-preflight.yaml").write_text(NODES)
    workspace = Workspace(Environment(1, "noetic", {}, (), {}, {}, (), (), None, str(tmp_path)), Sources())
    static = workspace.static(str(tmp_path / "a.launch"))
    graph = workspace.with_interfaces(static, [NOT_RUN] * 4, None).graph
    assert graph is not None
    assert [interface.source for interface in graph.interfaces] == ["settings", "settings", "none", "annotation"]
    assert [c.node.name for c in graph.topics["/chatter"].providers] == ["/a"]
    assert [c.node.name for c in graph.services["/reset"].providers] == ["/b"]
    assert [read.name for read in graph.param_reads] == ["/a/rate"]


def test_what_is_wrong_with_a_node_is_told_with_its_line(tmp_path: Path) -> None:
    (tmp_path / ".ros-preflight.yaml").write_text(
        "nodes:\n  - package: p\n  - name: /a\n    topic: []\n    topics:\n      - name: x\n        class: wrong\n"
    )
    problems = read_project_settings(str(tmp_path)).problems
    assert [(p.line, p.message.partition(";")[0]) for p in problems] == [
        (2, "'package' and 'executable', or 'name', of a node are missing"),
        (4, "unknown key 'topic' of a node"),
        (7, "unknown class 'wrong'"),
    ]


def test_settings_count_as_an_editor_has_them(tmp_path: Path) -> None:
    settings = tmp_path / ".ros-preflight.yaml"
    settings.write_text("external: {topics: [/joy]}")
    sources = Sources()
    environment = Environment(1, "noetic", {}, (), {}, {}, (), (), None, workspace=str(tmp_path))
    workspace = Workspace(environment, sources)
    assert workspace.settings.external_topics == ("/joy",)
    sources.open(str(settings), "external: {topics: [/other]}")
    assert workspace.settings.external_topics == ("/other",)
