"""Knowledge files that the settings name."""

from pathlib import Path

from preflight_analysis.workspace.workspace import Analysis
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
