"""BRG004: a bridge to a topic that nothing in Gazebo has."""

from pathlib import Path

import pytest
from support.gazebo_launch import DRIVE, SYSTEMS, WORLD, findings, row, sensor

_TWIST = "geometry_msgs/msg/Twist Twist"
_SCAN = "sensor_msgs/msg/LaserScan LaserScan"
_INFO = "sensor_msgs/msg/CameraInfo CameraInfo"
_LIDAR = sensor("gpu_lidar", "<topic>/scan</topic>")
_OWN_INFO = "<topic>cam</topic><camera><camera_info_topic>info</camera_info_topic></camera>"
_OF_FUEL = "<include><uri>https://fuel.gazebosim.org/1.0/a/models/b</uri></include>"
_TOUCH = "<contact><topic>touch</topic></contact>"
_JOINT_STATES = '<plugin filename="libgz-sim-joint-state-publisher-system.so"/>'
_JOINT = '<plugin filename="ignition-gazebo-joint-position-controller-system"><joint_name>j</joint_name></plugin>'


def test_the_default_name_of_a_plugin(tmp_path: Path) -> None:
    # As in https://github.com/Agroecology-Lab/feldfreund_devkit_ros/pull/61, the other way round.
    (found,) = findings(tmp_path, "BRG004", row("/cmd_vel", _TWIST, "ROS_TO_GZ"), DRIVE.format(""))
    assert found.message == (
        "'/cmd_vel' has no subscriber in Gazebo; the plugin diff-drive subscribes to '/model/bot/cmd_vel'"
    )
    assert (found.severity, found.confidence) == ("warning", "likely")
    assert found.fixes[0].edits[0].text == "/model/bot/cmd_vel"
    assert found.related[0].message == "Gazebo starts here with w.sdf"


def test_a_scoped_name_of_a_plugin_with_a_topic(tmp_path: Path) -> None:
    drive = DRIVE.format("<topic>cmd_vel</topic><odom_topic>/odom</odom_topic>")
    rows = row("/model/bot/cmd_vel", _TWIST, "ROS_TO_GZ")
    (found,) = findings(tmp_path, "BRG004", rows, drive)
    assert found.message.endswith("the plugin diff-drive subscribes to '/cmd_vel'")


def test_another_world_in_the_default_name_of_a_sensor(tmp_path: Path) -> None:
    rows = row("/world/other/model/bot/link/l/sensor/s/imu", "sensor_msgs/msg/Imu IMU", "GZ_TO_ROS")
    (found,) = findings(tmp_path, "BRG004", rows, sensor("imu"))
    assert found.message.endswith("the sensor 's' publishes '/world/w/model/bot/link/l/sensor/s/imu'")
    assert found.severity == "warning"


@pytest.mark.silent
@pytest.mark.parametrize(
    ("topic", "types", "direction", "model"),
    [
        ("scan", _SCAN, "GZ_TO_ROS", _LIDAR),
        ("/scan/points", "sensor_msgs/msg/PointCloud2 PointCloudPacked", "GZ_TO_ROS", _LIDAR),
        ("/cam/camera_info", _INFO, "GZ_TO_ROS", sensor("camera", "<topic>cam/image</topic>")),
        ("/info", _INFO, "GZ_TO_ROS", sensor("camera", _OWN_INFO)),
        ("/rgbd/depth_image", "sensor_msgs/msg/Image Image", "GZ_TO_ROS", sensor("rgbd_camera", "<topic>rgbd</topic>")),
        ("/touch", "ros_gz_interfaces/msg/Contacts Contacts", "GZ_TO_ROS", sensor("contact", _TOUCH)),
        ("/world/w/model/bot/joint_state", "sensor_msgs/msg/JointState Model", "GZ_TO_ROS", _JOINT_STATES),
        ("/model/bot/joint/j/0/cmd_pos", "std_msgs/msg/Float64 Double", "ROS_TO_GZ", _JOINT),
        ("/model/bot/odometry", "nav_msgs/msg/Odometry Odometry", "GZ_TO_ROS", DRIVE.format("")),
        ("/clock", "rosgraph_msgs/msg/Clock Clock", "GZ_TO_ROS", ""),
        ("/world/w/dynamic_pose/info", "tf2_msgs/msg/TFMessage Pose_V", "GZ_TO_ROS", ""),
        ("/cmd_vel", _TWIST, "GZ_TO_ROS", DRIVE.format("")),  # the window of Gazebo has a teleoperation
    ],
)
def test_what_gazebo_has(topic: str, types: str, direction: str, model: str, tmp_path: Path) -> None:
    assert not findings(tmp_path, "BRG004", row(topic, types, direction), model)


def test_nothing_with_a_like_name_is_information(tmp_path: Path) -> None:
    (found,) = findings(tmp_path, "BRG004", row("/front/scan", _SCAN, "GZ_TO_ROS"), sensor("camera"))
    assert (found.message, found.severity) == ("'/front/scan' has no publisher in Gazebo", "info")


@pytest.mark.parametrize(
    "unknown",
    [
        {"world": WORLD.replace("</world>", _OF_FUEL + "</world>")},
        {"world": WORLD.replace("</world>", '<plugin filename="libmine.so" name="m"/></world>')},
        {"start": "gz sim -r other.sdf"},
        {"more": '<include file="$(find-pkg-share somewhere)/launch/robots.launch.xml"/>'},
    ],
)
def test_what_is_not_known_of_gazebo_may_have_the_topic(unknown: dict[str, str], tmp_path: Path) -> None:
    assert not findings(tmp_path, "BRG004", row("/front/scan", _SCAN, "GZ_TO_ROS"), **unknown)  # type: ignore[arg-type]


def test_a_like_name_beside_what_is_not_known_is_information(tmp_path: Path) -> None:
    world = WORLD.replace("</world>", '<plugin filename="libmine.so" name="m"/></world>')
    (found,) = findings(tmp_path, "BRG004", row("/cmd_vel", _TWIST, "ROS_TO_GZ"), DRIVE.format(""), world=world)
    assert (found.severity, found.confidence) == ("info", "possible")


@pytest.mark.silent
def test_a_file_for_several_worlds(tmp_path: Path) -> None:
    types = "tf2_msgs/msg/TFMessage Pose_V"
    rows = row("/world/other/pose/info", types, "GZ_TO_ROS") + row("/world/w/pose/info", types, "GZ_TO_ROS")
    assert not findings(tmp_path, "BRG004", rows)


@pytest.mark.silent
def test_a_launch_without_a_simulator(tmp_path: Path) -> None:
    assert not findings(tmp_path, "BRG004", row("/front/scan", _SCAN, "GZ_TO_ROS"), start="")
    assert not findings(tmp_path, "BRG004", row("/front/scan", _SCAN, "GZ_TO_ROS"), start="gz sim -g")


def test_the_robot_of_a_description_and_an_included_model(tmp_path: Path) -> None:
    urdf = "<robot name='r'><gazebo><plugin filename='gz-sim-diff-drive-system' name='d'/></gazebo></robot>"
    state = f"""<node pkg="robot_state_publisher" exec="robot_state_publisher" name="state">
      <param name="robot_description" value="{urdf.replace("<", "&lt;")}"/></node>"""
    rows = row("/model/r/cmd_vel", _TWIST, "ROS_TO_GZ")
    (found,) = findings(tmp_path / "a", "BRG004", rows, spawn="-topic robot_description -name car", more=state)
    assert found.message.endswith("subscribes to '/model/car/cmd_vel'")
    world = f'<sdf><world name="w">{SYSTEMS}<include><uri>file://{tmp_path}/m</uri></include></world></sdf>'
    (tmp_path / "m").mkdir()
    (tmp_path / "m" / "model.sdf").write_text(f'<sdf><model name="car">{DRIVE.format("")}</model></sdf>')
    assert not findings(tmp_path / "b", "BRG004", row("/model/car/cmd_vel", _TWIST, "ROS_TO_GZ"), world=world)


def test_the_launch_file_of_ros_gz_sim(tmp_path: Path) -> None:
    start = f"""<include file="$(find-pkg-share ros_gz_sim)/launch/gz_sim.launch.py">
      <arg name="gz_args" value="-r {tmp_path}/ws/src/robot/w.sdf"/></include>"""
    rows = row("/cmd_vel", _TWIST, "ROS_TO_GZ")
    (found,) = findings(tmp_path, "BRG004", rows, DRIVE.format(""), start="", more=start)
    assert found.severity == "warning"


@pytest.mark.silent
def test_a_world_that_is_no_sdf(tmp_path: Path) -> None:
    assert not findings(tmp_path, "BRG004", row("/front/scan", _SCAN, "GZ_TO_ROS"), world="<sdf><world")
