"""Knowledge files that the settings name."""

import os
from pathlib import Path

import pytest
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Analysis, Workspace
from support.package_elsewhere import analysed

LAUNCH = """
<launch>
  <node pkg="merger" exec="merge" name="merge"><param name="scan0" value="/front"/></node>
</launch>
"""
KNOWLEDGE = """package: merger
entries:
  - executables: [merge]
    parameters:
      scan{N}: {topic: subscriber, type: sensor_msgs/LaserScan}
      out: {topic: publisher, type: sensor_msgs/LaserScan, default: merged}
"""


def ends(analysis: Analysis) -> list[tuple[str, str, str | None]]:
    graph = analysis.graph
    assert graph is not None
    return [(end.role, end.name, end.type) for end in graph.interfaces[0].endpoints]


def said(analysis: Analysis) -> list[tuple[str, str, int]]:
    """Message, file and line of what LCH031 finds."""
    return [
        (each.message, Path(each.location.file).name, text[: each.location.span.start].count("\n") + 1)
        for each in analysis.findings
        if each.rule == "LCH031"
        for text in (analysis.documents[each.location.file].text,)
    ]


def of_settings(folder: Path, knowledge: str, settings: str = "knowledge: [own.yaml]") -> Analysis:
    files = {"../../own.yaml": knowledge, "../../.ros-preflight.yaml": settings}
    return analysed(folder, LAUNCH, "a.launch.xml", **files)


def test_they_say_what_parameters_mean(tmp_path: Path) -> None:
    analysis = of_settings(tmp_path, KNOWLEDGE)
    assert ends(analysis) == [
        ("subscriber", "/front", "sensor_msgs/msg/LaserScan"),
        ("publisher", "merged", "sensor_msgs/msg/LaserScan"),
    ]
    assert said(analysis) == []


def test_a_mistake_is_a_finding_at_its_line(tmp_path: Path) -> None:
    analysis = of_settings(tmp_path, KNOWLEDGE.replace("subscriber", "reader"))
    assert said(analysis) == [("invalid value of 'topic': expected publisher or subscriber", "own.yaml", 5)]
    assert ends(analysis) == [("publisher", "merged", "sensor_msgs/msg/LaserScan")]


def test_a_file_that_is_not_there_is_a_finding_in_the_settings(tmp_path: Path) -> None:
    analysis = of_settings(tmp_path, "", "external: {}\nknowledge:\n  - other.yaml")
    ((message, file, line),) = said(analysis)
    assert message.startswith("knowledge file '")
    assert (file, line) == (".ros-preflight.yaml", 3)


CONFIG = """package: merger
entries:
  - executables: [merge]
    parameters:
      config: {file: yaml}
      config.sources.*.topic: {topic: subscriber, type: sensor_msgs/LaserScan}
"""
WITH_CONFIG = """
<launch>
  <node pkg="merger" exec="merge" name="merge"><param name="config" value="$(dirname)/merge.yaml"/></node>
</launch>
"""


def with_config(folder: Path, knowledge: str = CONFIG, **files: str) -> Analysis:
    settings = {"../../own.yaml": knowledge, "../../.ros-preflight.yaml": "knowledge: [own.yaml]"}
    return analysed(folder, WITH_CONFIG, "a.launch.xml", **settings, **files)


def test_a_file_that_a_parameter_names_is_read(tmp_path: Path) -> None:
    analysis = with_config(tmp_path, **{"merge.yaml": "sources: [{topic: /front}, {topic: /rear}]"})
    assert [name for _, name, _ in ends(analysis)] == ["/front", "/rear"]
    place = analysis.tree.file_params["/merge"][1].place
    assert Path(place.file).name == "merge.yaml"
    assert analysis.documents[place.file].text[slice(*place.span)] == "topic"


@pytest.mark.parametrize("content", ["", "[", "sources: 3", "&a [*a]", "sources: {a: &a {topic: *a}}"])
def test_a_file_that_is_no_such_thing_says_nothing(tmp_path: Path, content: str) -> None:
    assert ends(with_config(tmp_path, **{"merge.yaml": content})) == []
    assert ends(with_config(tmp_path / "none")) == []


def test_the_knowledge_counts_when_it_comes_later(tmp_path: Path) -> None:
    analysis = with_config(tmp_path, "package: merger", **{"merge.yaml": "sources: [{topic: /front}]"})
    assert ends(analysis) == []
    own = tmp_path / "ws" / "own.yaml"
    own.write_text(CONFIG)
    workspace = Workspace(analysis.environment, Sources(), str(tmp_path / "ws"))
    before = workspace.static(analysis.tree.file)
    assert [param.name for param in before.tree.file_params["/merge"]] == ["config.sources.0.topic"]
    own.write_text("package: other")
    workspace.refresh()
    assert not workspace.static(analysis.tree.file).tree.file_params


def test_what_is_no_regular_file_is_not_waited_for(tmp_path: Path) -> None:
    pipe = tmp_path / "ws" / "src" / "robot" / "merge.yaml"
    pipe.parent.mkdir(parents=True)
    os.mkfifo(pipe)
    assert ends(with_config(tmp_path)) == []
