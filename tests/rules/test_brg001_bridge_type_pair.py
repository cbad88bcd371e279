"""BRG001: types of ROS and Gazebo that the bridge does not convert into each other."""

from pathlib import Path

import pytest
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.registry import run_rules
from support import gazebo_launch, package_elsewhere

_NODE = '<launch><node pkg="ros_gz_bridge" exec="parameter_bridge" args="{}"/></launch>'


def found_in(folder: Path, args: str, **files: str) -> list[Finding]:
    analysis = package_elsewhere.analysed(folder, _NODE.format(args), "a.launch.xml", **files)
    return [each for each in run_rules(analysis.context) if each.rule == "BRG001"]


def test_an_argument(tmp_path: Path) -> None:
    (found,) = found_in(tmp_path, "/scan@sensor_msgs/msg/LaserScan[gz.msgs.PointCloudPacked")
    assert (found.severity, found.confidence) == ("warning", "likely")
    assert found.message == (
        "the bridge cannot convert 'sensor_msgs/msg/LaserScan' and 'gz.msgs.PointCloudPacked'; "
        "it converts 'sensor_msgs/msg/LaserScan' and 'gz.msgs.LaserScan'"
    )
    assert found.fixes[0].edits[0].text == "gz.msgs.LaserScan"


def test_an_entry_of_a_file(tmp_path: Path) -> None:
    row = "- {topic_name: imu, ros_type_name: sensor_msgs/msg/Imu, gz_type_name: gz.msgs.Imu}"
    args = "--ros-args -p config_file:=$(dirname)/bridge.yaml"
    (found,) = found_in(tmp_path, args, **{"bridge.yaml": row})
    assert found.location.file.endswith("/bridge.yaml")
    assert row[found.location.span.start : found.location.span.end] == "gz.msgs.Imu"
    assert found.fixes[0].edits[0].text == "gz.msgs.IMU"


def test_a_type_that_the_bridge_does_not_know_is_information(tmp_path: Path) -> None:
    (found,) = found_in(tmp_path, "/a@my_msgs/msg/A@gz.msgs.A")
    assert (found.severity, found.confidence) == ("info", "possible")


def test_a_type_without_its_kind(tmp_path: Path) -> None:
    (found,) = found_in(tmp_path, "/odom@nav_msgs/Odometry[gz.msgs.Odometry")
    assert found.message == "the bridge does not know 'nav_msgs/Odometry'; did you mean 'nav_msgs/msg/Odometry'?"
    assert (found.severity, found.fixes[0].edits[0].text) == ("warning", "nav_msgs/msg/Odometry")


def test_a_slip_of_a_type(tmp_path: Path) -> None:
    (found,) = found_in(tmp_path, "/clock@rosgraph_msgs/msg/clock[gz.msgs.Clock")
    assert (
        found.message == "the bridge does not know 'rosgraph_msgs/msg/clock'; did you mean 'rosgraph_msgs/msg/Clock'?"
    )
    assert (found.severity, found.fixes[0].edits[0].text) == ("warning", "rosgraph_msgs/msg/Clock")


@pytest.mark.silent
@pytest.mark.parametrize(
    "args",
    [
        "/cmd_vel@geometry_msgs/msg/Twist@gz.msgs.Twist /tf@tf2_msgs/msg/TFMessage[ignition.msgs.Pose_V",
        "/odom@nav_msgs/msg/Odometry]gz.msgs.OdometryWithCovariance",
        "/world/w/control@ros_gz_interfaces/srv/ControlWorld",
    ],
)
def test_types_that_go_together(tmp_path: Path, args: str) -> None:
    assert not found_in(tmp_path, args)


def test_the_type_that_gazebo_has(tmp_path: Path) -> None:
    points = "<topic>scan</topic>"
    rows = gazebo_launch.row("/scan/points", "sensor_msgs/msg/LaserScan LaserScan", "GZ_TO_ROS")
    (found,) = gazebo_launch.findings(tmp_path / "a", "BRG001", rows, gazebo_launch.sensor("gpu_lidar", points))
    assert found.message == (
        "the bridge expects 'gz.msgs.LaserScan' on '/scan/points', but the sensor 's' has 'gz.msgs.PointCloudPacked'"
    )
    assert (found.severity, found.confidence) == ("warning", "likely")
    rows = gazebo_launch.row("/scan/points", "sensor_msgs/msg/PointCloud2 PointCloudPacked", "GZ_TO_ROS")
    assert not gazebo_launch.findings(tmp_path / "b", "BRG001", rows, gazebo_launch.sensor("gpu_lidar", points))


def test_a_topic_of_several_plugins(tmp_path: Path) -> None:
    lights = '<plugin filename="gz-sim-thruster-system"><namespace>bot</namespace><topic>cmd_vel</topic></plugin>'
    model = gazebo_launch.DRIVE.format("<topic>/bot/cmd_vel</topic>") + lights
    rows = gazebo_launch.row("/bot/cmd_vel", "std_msgs/msg/Float64 Double", "ROS_TO_GZ")
    assert not gazebo_launch.findings(tmp_path, "BRG001", rows, model)


@pytest.mark.parametrize(
    "types",
    [
        "sensor_msgs/msg/Range LaserScan",
        "ros_gz_interfaces/msg/WorldStatistics WorldStatistics",
        "ros_gz_interfaces/msg/AirSpeed AirSpeed",
    ],
)
def test_types_of_newer_bridges(types: str, tmp_path: Path) -> None:
    rows = gazebo_launch.row("/t", types, "GZ_TO_ROS")
    assert not gazebo_launch.findings(tmp_path, "BRG001", rows)
