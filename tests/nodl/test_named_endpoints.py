"""Topics that parameters name."""

from pathlib import Path

import pytest
from preflight_analysis.findings.finding import Finding
from preflight_analysis.workspace.workspace import Analysis
from support.package_elsewhere import analysed

EKF = """
<launch>
  <node pkg="robot_localization" exec="ekf_node" name="ekf"><param from="$(dirname)/ekf.yaml"/></node>
  <node pkg="wheels" exec="driver" name="driver">
    <!-- <topics><topic name="/odom" type="nav_msgs/msg/Odometry" class="pub"/></topics> -->
  </node>
</launch>
"""
PARAMS = """ekf:
  ros__parameters:
    odom0: /odmo
    imu0: imu/data
    imu0_config: [true]
"""


def ends(analysis: Analysis, node: str) -> list[tuple[str, str, str | None, str | None]]:
    """Role, name, type and parameter of each end that a parameter names."""
    graph = analysis.graph
    assert graph is not None
    at = next(at for at, each in enumerate(graph.tree.nodes) if each.name == node)
    found = graph.interfaces[at].endpoints
    return [(e.role, e.name, e.type, e.named_by.parameter) for e in found if e.named_by is not None]


def finding(analysis: Analysis, rule: str) -> Finding:
    (found,) = [each for each in analysis.findings if each.rule == rule and "odm" in each.message]
    return found


def test_they_are_known_by_what_the_parameters_mean(tmp_path: Path) -> None:
    analysis = analysed(tmp_path, EKF, "a.launch.xml", distro="jazzy", **{"ekf.yaml": PARAMS})
    assert sorted(ends(analysis, "/ekf")) == [
        ("subscriber", "/odmo", "nav_msgs/msg/Odometry", "odom0"),
        ("subscriber", "imu/data", "sensor_msgs/msg/Imu", "imu0"),
    ]


def test_of_a_distribution_that_the_catalogue_does_not_have_in_its_types(tmp_path: Path) -> None:
    launch = """
    <launch>
      <node pkg="robot_localization" type="ekf_localization_node" name="ekf">
        <param name="odom3" value="/odom"/>
      </node>
    </launch>
    """
    analysis = analysed(tmp_path, launch, distro="noetic")
    assert ends(analysis, "/ekf") == [("subscriber", "/odom", "nav_msgs/Odometry", "/ekf/odom3")]


def test_a_finding_is_at_the_parameter_and_mends_it(tmp_path: Path) -> None:
    analysis = analysed(tmp_path, EKF, "a.launch.xml", distro="jazzy", **{"ekf.yaml": PARAMS})
    found = finding(analysis, "TOP001")
    text = analysis.documents[found.location.file].text
    assert text[slice(*found.location.span)] == "odom0"
    (fix,) = found.fixes
    (edit,) = fix.edits
    assert (fix.title, text[slice(*edit.location.span)]) == ("Replace '/odmo' with '/odom'", "/odmo")


def test_a_parameter_of_any_node_that_says_so_by_its_name(tmp_path: Path) -> None:
    launch = """
    <launch>
      <node pkg="mine" type="reader" name="reader">
        <param name="scan_topic" value="/scan"/>
        <param name="frame" value="laser"/>
      </node>
    </launch>
    """
    settings = (
        "nodes: [{package: mine, executable: reader, topics: [{name: /scan, type: sensor_msgs/LaserScan, class: sub}, "
        "{name: laser, type: sensor_msgs/LaserScan, class: sub}]}]"
    )
    analysis = analysed(tmp_path, launch, **{"../../.ros-preflight.yaml": settings})
    assert ends(analysis, "/reader") == [("subscriber", "/scan", "sensor_msgs/LaserScan", "/reader/scan_topic")]


def all_ends(
    folder: Path, node: str, distro: str, files: dict[str, str] | None = None
) -> set[tuple[str, str, str | None]]:
    """Role, name as the node gave it and type of each end of the only node of a launch file."""
    name = "a.launch" if distro == "noetic" else "a.launch.xml"
    graph = analysed(folder, f"<launch>{node}</launch>", name, distro, **(files or {})).graph
    assert graph is not None
    return {(end.role, end.name, end.type) for end in graph.interfaces[0].endpoints if not end.builtin}


@pytest.mark.parametrize("args", ["-topic robot_description -name r -z -0.5", "--topic=robot_description -name r"])
def test_an_option_of_a_command_line_names_a_topic(tmp_path: Path, args: str) -> None:
    node = f'<node pkg="ros_gz_sim" exec="create" name="spawn" args="{args}"/>'
    assert ("subscriber", "robot_description", "std_msgs/msg/String") in all_ends(tmp_path, node, "jazzy")


@pytest.mark.parametrize(
    ("distro", "given"),
    [
        ("humble", 'args="compressed raw"/>'),
        ("jazzy", '><param name="in_transport" value="compressed"/><param name="out_transport" value="raw"/></node>'),
    ],
)
def test_a_transport_is_part_of_the_name(tmp_path: Path, distro: str, given: str) -> None:
    node = f'<node pkg="image_transport" exec="republish" name="r" {given}'
    found = all_ends(tmp_path, node, distro)
    assert ("subscriber", "in/compressed", "sensor_msgs/msg/CompressedImage") in found
    assert ("publisher", "out", "sensor_msgs/msg/Image") in found
