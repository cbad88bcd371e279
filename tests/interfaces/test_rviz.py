"""Topics that the displays of RViz subscribe to."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.tracing.interface import Endpoint
from support import package_elsewhere

DISPLAYS = """
Visualization Manager:
  Displays:
    - {Class: rviz_default_plugins/Grid, Enabled: true, Name: Grid}
    - {Class: rviz_default_plugins/Map, Enabled: false, Topic: {Value: /map}}
    - {Class: rviz_default_plugins/Image, Enabled: true, Topic: {Value: /image/compressed}}
    - {Class: rviz_default_plugins/Path, Enabled: true, Topic: {Value: <robot_namespace>/plan}}
    - {Class: some_plugins/LaserScan, Enabled: true, Topic: {Value: /other}}
    - Class: rviz_common/Group
      Enabled: true
      Displays:
        - Class: rviz_default_plugins/LaserScan
          Enabled: true
          Name: Lidar
          Topic:
            Depth: 5
            Durability Policy: System Default
            Reliability Policy: Best Effort
            Value: scan
    - Class: rviz_common/Group
      Enabled: false
      Displays:
        - {Class: rviz_default_plugins/Path, Enabled: true, Topic: {Value: /plan}}
"""
DISPLAYS_1 = """
Visualization Manager:
  Displays:
    - {Class: rviz/MarkerArray, Enabled: true, Marker Topic: /markers}
    - {Class: rviz/Camera, Enabled: true, Image Topic: /image, Transport Hint: raw}
    - {Class: rviz/Image, Enabled: true, Image Topic: /packed, Transport Hint: compressed}
    - {Class: rviz/LaserScan, Enabled: true, Topic: /scan, Unreliable: false}
"""


def shown(folder: Path, node: str, config: str, name: str = "a.launch.xml") -> dict[str, Endpoint]:
    """The subscribers of the one node by their full names."""
    analysis = package_elsewhere.analysed(folder, f"<launch>{node}</launch>", name, **{"a.rviz": config})
    assert analysis.graph is not None
    return {name: each.consumers[0].endpoint for name, each in analysis.graph.topics.items() if each.consumers}


def test_enabled_displays(tmp_path: Path) -> None:
    node = '<node pkg="rviz2" exec="rviz2" namespace="r" args="-d $(dirname)/a.rviz"/>'
    ((name, endpoint),) = shown(tmp_path, node, DISPLAYS).items()
    assert (name, endpoint.type, endpoint.qos) == (
        "/r/scan", "sensor_msgs/msg/LaserScan", {"reliability": "best_effort"},
    )  # fmt: skip
    assert endpoint.displayed and endpoint.uncertain
    assert endpoint.named_by is not None
    place = endpoint.named_by.place
    assert (endpoint.named_by.display, place.file[-6:]) == ("Lidar", "a.rviz")
    assert DISPLAYS[place.span.start :].startswith("Value: scan")


def test_displays_of_ros1(tmp_path: Path) -> None:
    node = '<node pkg="rviz" type="rviz" name="rviz" args="-d $(dirname)/a.rviz"/>'
    found = shown(tmp_path, node, DISPLAYS_1, "a.launch")
    assert {name: each.type for name, each in found.items()} == {
        "/markers": "visualization_msgs/MarkerArray",
        "/image": "sensor_msgs/Image",
        "/scan": "sensor_msgs/LaserScan",
    }


@pytest.mark.parametrize("config", ["", "3", "[", "Visualization Manager: [Displays]", "&a [*a]"])
def test_a_file_without_displays(tmp_path: Path, config: str) -> None:
    assert shown(tmp_path, '<node pkg="rviz2" exec="rviz2" args="-d $(dirname)/a.rviz"/>', config) == {}


def test_rviz_without_a_configuration(tmp_path: Path) -> None:
    assert shown(tmp_path, '<node pkg="rviz2" exec="rviz2"/>', DISPLAYS) == {}


@pytest.mark.parametrize(("topic", "severity"), [("/odom_view_1/path", "info"), ("/odom_veiw/path", "warning")])
def test_a_display_of_another_one_of_several_robots(topic: str, severity: str, tmp_path: Path) -> None:
    config = f"Visualization Manager:\n  Displays:\n    - {{Class: rviz/Path, Enabled: true, Topic: {topic}}}\n"
    nodes = (
        '<node pkg="rviz" type="rviz" name="rviz" args="-d $(dirname)/a.rviz"/>'
        '<node pkg="rostopic" type="rostopic" name="pub" args="pub /odom_view/path nav_msgs/Path"/>'
    )
    launch = f"<launch>{nodes}</launch>"
    findings = package_elsewhere.analysed(tmp_path, launch, "a.launch", **{"a.rviz": config}).findings
    assert [f.severity for f in findings if f.rule == "TOP001"] == [severity]
