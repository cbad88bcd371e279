"""BRG002: a bridge that carries a topic in the direction in which nobody sends it."""

from pathlib import Path

import pytest
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.registry import run_rules
from support import gazebo_launch, package_elsewhere
from support.check import check

_BRIDGE = '<node pkg="ros_gz_bridge" exec="parameter_bridge" name="bridge" args="{}"/>'
_RVIZ = '<node pkg="rviz2" exec="rviz2" name="rviz" args="-d $(dirname)/a.rviz"/>'
_DISPLAY = "Class: rviz_default_plugins/LaserScan, Enabled: true, Topic: {Value: /scan}"
_SHOWN = f"{{Visualization Manager: {{Displays: [{{{_DISPLAY}}}]}}}}"
_TELEOP = '<node pkg="teleop_twist_joy" exec="teleop_node" name="teleop"/>'


def found_in(folder: Path, nodes: str, **files: str) -> list[Finding]:
    analysis = package_elsewhere.analysed(folder, f"<launch>{nodes}</launch>", "a.launch.xml", "humble", **files)
    return [each for each in run_rules(analysis.context) if each.rule == "BRG002"]


def test_a_measurement_from_ros(tmp_path: Path) -> None:
    bridge = _BRIDGE.format("/scan@sensor_msgs/msg/LaserScan]gz.msgs.LaserScan")
    (found,) = found_in(tmp_path, bridge + _RVIZ, **{"a.rviz": _SHOWN})
    assert found.message.startswith(
        "bridge direction: '/scan' goes from ROS to Gazebo, but has no publisher in ROS (subscriber: /rviz)"
    )
    assert (found.severity, found.confidence) == ("warning", "likely")
    assert found.fixes[0].edits[0].text == "/scan@sensor_msgs/msg/LaserScan[gz.msgs.LaserScan"


def test_all_nodes_are_known() -> None:
    check("""
        //- /a.launch.xml
        <launch>
        <node pkg="ros_gz_bridge" exec="parameter_bridge" name="b" args="/s@sensor_msgs/msg/Imu]gz.msgs.IMU"/>
        ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[TOP001] '/s' (sensor_msgs/msg/Imu) has no publisher in this launch (subscriber: /b)
                                                                         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[BRG002] bridge direction: '/s' goes from ROS to Gazebo, but has no publisher in ROS (subscriber: /ekf)
        <node pkg="p" exec="t" name="ekf"/>
        ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[TOP001] '/s' (sensor_msgs/msg/Imu) has no publisher in this launch (subscriber: /ekf)
        </launch>
        //- /ros_gz_bridge/package.xml
        <package format="3"><name>ros_gz_bridge</name></package>
        //- interfaces
        {"/b": {"subscribers": {"/s": "sensor_msgs/msg/Imu"}}, "/ekf": {"subscribers": {"/s": "sensor_msgs/msg/Imu"}}}
    """)  # noqa: E501


def test_a_command_to_ros(tmp_path: Path) -> None:
    row = "- {topic_name: /cmd_vel, ros_type_name: geometry_msgs/msg/Twist, gz_type_name: gz.msgs.Twist, direction: "
    row += "GZ_TO_ROS}"
    bridge = _BRIDGE.format("--ros-args -p config_file:=$(dirname)/bridge.yaml")
    (found,) = found_in(tmp_path, bridge + _TELEOP, **{"bridge.yaml": row})
    assert "'/cmd_vel' goes from Gazebo to ROS, but has no subscriber in ROS (publisher: /teleop)" in found.message
    assert found.severity == "info"  # the nodes are not analysed
    assert row[found.location.span.start : found.location.span.end] == "GZ_TO_ROS"
    assert found.fixes[0].edits[0].text == "ROS_TO_GZ"


@pytest.mark.silent
@pytest.mark.parametrize(
    "nodes",
    [
        _BRIDGE.format("/scan@sensor_msgs/msg/LaserScan[gz.msgs.LaserScan") + _RVIZ,
        _BRIDGE.format("/scan@sensor_msgs/msg/LaserScan@gz.msgs.LaserScan") + _RVIZ,
        _BRIDGE.format("/cmd_vel@geometry_msgs/msg/Twist]gz.msgs.Twist") + _TELEOP,
        _BRIDGE.format("/cmd_vel@geometry_msgs/msg/Twist[gz.msgs.Twist"),
        _BRIDGE.format("/scan@sensor_msgs/msg/LaserScan]gz.msgs.LaserScan"),
    ],
)
def test_directions_that_make_sense(tmp_path: Path, nodes: str) -> None:
    assert not found_in(tmp_path, nodes, **{"a.rviz": _SHOWN})


def test_the_end_that_gazebo_has(tmp_path: Path) -> None:
    lidar = gazebo_launch.sensor("gpu_lidar", "<topic>scan</topic>")
    rows = gazebo_launch.row("/scan", "sensor_msgs/msg/LaserScan LaserScan", "ROS_TO_GZ", "/scan")
    (found,) = gazebo_launch.findings(tmp_path / "a", "BRG002", rows, lidar)
    assert found.message == ("bridge direction: '/scan' goes from ROS to Gazebo, but the sensor 's' publishes it there")
    assert (found.severity, found.fixes[0].edits[0].text) == ("warning", "GZ_TO_ROS")
    rows = rows.replace("ROS_TO_GZ", "GZ_TO_ROS")
    assert not gazebo_launch.findings(tmp_path / "b", "BRG002", rows, lidar)


def test_a_command_that_gazebo_takes(tmp_path: Path) -> None:
    drive = gazebo_launch.DRIVE.format("<topic>cmd_vel</topic>")
    rows = gazebo_launch.row("/cmd_vel", "geometry_msgs/msg/Twist Twist", "GZ_TO_ROS", "/cmd_vel")
    (found,) = gazebo_launch.findings(tmp_path / "a", "BRG002", rows, drive, more=_TELEOP)
    assert "goes from Gazebo to ROS, but the plugin diff-drive subscribes to it there" in found.message
    assert found.severity == "warning"
    (found,) = gazebo_launch.findings(tmp_path / "b", "BRG002", rows, drive)
    assert found.severity == "info"


def test_the_clock_goes_both_ways(tmp_path: Path) -> None:
    # https://github.com/gazebosim/ros_gz/issues/341
    (found,) = found_in(tmp_path / "a", _BRIDGE.format("/clock@rosgraph_msgs/msg/Clock@ignition.msgs.Clock"))
    assert found.message == (
        "bridge direction: '/clock' goes both ways; Gazebo does not publish it if the bridge starts first"
    )
    assert found.fixes[0].edits[0].text == "/clock@rosgraph_msgs/msg/Clock[ignition.msgs.Clock"
    assert not found_in(tmp_path / "b", _BRIDGE.format("/clock@rosgraph_msgs/msg/Clock[ignition.msgs.Clock"))
    assert not found_in(tmp_path / "c", _BRIDGE.format("/world/w/clock@rosgraph_msgs/msg/Clock@gz.msgs.Clock"))
