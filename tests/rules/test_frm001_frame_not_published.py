"""FRM001: a frame that a node asks for and nothing publishes."""

import json
from pathlib import Path

import pytest
from support.check import apply, check
from support.frame_launch import EKF, EKF_COLUMN, below, fixture, robot, static

_ODOM = static("s", "odom", "base_link")
_ROBOT = robot(("base_link", "laser"))
_UNKNOWN = '<node pkg="p" exec="driver" name="driver"/>'


def _expected(frame: str, text: str) -> str:
    return f"\n{below(EKF_COLUMN, len(frame), text)}\n"


def test_a_slip() -> None:
    said = "warning[FRM001] frame 'base_lnk' has no publisher: /ekf uses it (parameter 'base_link_frame'); did you mean"
    text = fixture(f"{_ODOM}\n{EKF.format('base_lnk', _expected('base_lnk', said))}", {})
    (found,) = check(text)
    assert found.confidence == "likely"
    assert 'value="base_link"' in apply(text, found.fixes[0].edits)["/main.launch.xml"]


def test_one_that_nothing_resembles() -> None:
    said = "info[FRM001] frame 'trailer' has no publisher: /ekf uses it (parameter 'base_link_frame')"
    check(fixture(f"{_ROBOT}\n{EKF.format('trailer', _expected('trailer', said))}", {}))


def test_where_not_all_is_known() -> None:
    said = "hint[FRM001] (parameter 'base_link_frame'); 1 of 3 nodes are not analysed: /driver"
    nodes = f"{_ROBOT}\n{_UNKNOWN}\n{EKF.format('trailer', _expected('trailer', said))}"
    (found,) = check(fixture(nodes, {}))
    assert found.confidence == "possible"


_SLAM = (
    '<node pkg="slam_toolbox" exec="async_slam_toolbox_node" name="slam"><param name="base_frame" value="{}"/></node>'
)
_SLAM_PACKAGE = "\n//- /slam_toolbox/package.xml\n<package><name>slam_toolbox</name></package>"


def _with_slam(frame: str, said: str, more: str = "") -> str:
    expected = f"\n{below(_SLAM.index('{}'), len(frame), said)}" if said else ""
    return fixture(f"{_ROBOT}\n{more}{_SLAM.format(frame)}{expected}", {}, _SLAM_PACKAGE)


def test_a_base_that_the_robot_does_not_have() -> None:
    """https://github.com/SteveMacenski/slam_toolbox/issues/556"""
    said = "[FRM001] frame 'base_footprint' has no publisher: /slam uses it (parameter 'base_frame'); the robot"
    (found,) = check(_with_slam("base_footprint", f"warning{said}"))
    assert found.confidence == "likely"
    (found,) = check(_with_slam("base_footprint", f"info{said} description begins with 'base_link'", f"{_UNKNOWN}\n"))
    assert found.confidence == "possible"


@pytest.mark.silent
def test_a_base_that_something_joins_with_the_robot() -> None:
    joints = (static("s", "base_footprint", "base_link"), static("o", "odom", "base_footprint"))
    check(_with_slam("base_footprint", "", "\n".join((*joints, ""))))


def test_what_a_run_asked_for() -> None:
    answer = "it waits for the transform odom <- camera_lnk, and was given the identity"
    expected = below(0, len(_UNKNOWN), "warning[FRM001] (transform odom <- camera_lnk); did you mean 'camera_link'?")
    nodes = f"{static('s', 'odom', 'camera_link')}\n{_UNKNOWN}\n{expected}"
    check(fixture(nodes, {"/driver": {"answers": [answer]}}))


def test_the_fixed_frame_of_rviz(tmp_path: Path) -> None:
    config = tmp_path / "a.rviz"
    config.write_text("Visualization Manager:\n  Global Options:\n    Fixed Frame: base_lnk\n")
    node = f'<node pkg="rviz2" exec="rviz2" name="rviz" args="-d {config}"/>'
    package = "\n//- /rviz2/package.xml\n<package><name>rviz2</name></package>"
    said = "warning[FRM001] frame 'base_lnk' has no publisher: /rviz uses it (Fixed Frame of a.rviz); did you mean"
    check(fixture(f"{_ODOM}\n{node}\n{below(0, len(node), said)}", {}, package))


def test_a_driver_that_publishes_other_frames_than_the_robot_has() -> None:
    """https://github.com/IntelRealSense/realsense-ros/issues/2400, https://github.com/TixiaoShan/LIO-SAM/issues/482"""
    answer = "it asks for the transform base_link <- camera_depth_frame again and again, and was given the identity"
    said = "info[FRM001] frame 'camera_depth_frame' has no publisher: /driver uses it (transform base_link <- camera"
    nodes = f"{robot(('base_link', 'camera_link'))}\n{_UNKNOWN}\n{below(0, len(_UNKNOWN), said)}"
    check(fixture(nodes, {"/driver": {"answers": [answer], "source": "settings"}}))


def _of_source(frame: str, call: str = "Buffer::lookupTransform", **more: object) -> dict[str, object]:
    use = [frame, call, "/" not in call, more.pop("conditional", False), "/p/src/d.cpp", 7]
    return {"frame_uses": [use], "source": "source", "status": "not-run", **more}


def test_what_the_source_asks_for() -> None:
    said = "warning[FRM001] 'camera_lnk' has no publisher: /driver uses it (Buffer::lookupTransform in d.cpp:7); did"
    nodes = f"{robot(('base_link', 'camera_link'))}\n{_UNKNOWN}\n{below(0, len(_UNKNOWN), said)}"
    check(fixture(nodes, {"/driver": {**_of_source("camera_lnk"), "source": "settings"}}))


@pytest.mark.parametrize(
    "driver",
    [
        # What the text does not tell of the node may broadcast it.
        _of_source("camera_lnk"),
        {**_of_source("camera_lnk", conditional=True), "source": "settings"},
    ],
)
def test_what_the_source_may_ask_for(driver: dict[str, object]) -> None:
    nodes = f"{robot(('base_link', 'camera_link'))}\n{_UNKNOWN}\n{below(0, len(_UNKNOWN), 'info[FRM001] camera_lnk')}"
    check(fixture(nodes, {"/driver": driver}))


@pytest.mark.silent
@pytest.mark.parametrize(
    "driver",
    [
        {**_of_source("camera_lnk"), "frames": [["base_link", "camera_lnk", False, True, False, "/p/src/d.cpp", 9]]},
        _of_source("trailer"),
    ],
)
def test_what_a_node_broadcasts_by_its_source(driver: dict[str, object]) -> None:
    check(fixture(f"{robot(('base_link', 'camera_link'))}\n{_UNKNOWN}", {"/driver": driver}))


_LIDAR = '<node pkg="rplidar_ros" type="rplidarNode" name="lidar"><param name="frame_id" value="{}"/></node>'
_LIDAR_COLUMN = _LIDAR.index("{}")
_LIDAR_PACKAGES = "".join(
    f"\n//- /{name}/package.xml\n<package><name>{name}</name></package>" for name in ("rplidar_ros", "tf2_ros")
)


def _with_lidar(frame: str, said: str = "", child: str = "laser_link", more: str = "") -> str:
    expected = f"{below(_LIDAR_COLUMN, len(frame), said)}\n" if said else ""
    link = f'<node pkg="tf2_ros" type="static_transform_publisher" name="s" args="0 0 0 0 0 0 base_link {child}"/>'
    lines = f"{link}\n{more}{_LIDAR.format(frame)}\n{expected}"
    seen = {"/s": {}, "/lidar": {"params": {"~frame_id": "laser_frame"}}} | (
        {"/driver": {"publishers": {"/tf": "tf2_msgs/TFMessage"}}} if more else {}
    )
    return f"<launch>\n{lines}</launch>{_LIDAR_PACKAGES}\n//- interfaces\n{json.dumps(seen)}"


def test_the_frame_of_a_sensor() -> None:
    said = (
        "warning[FRM001] 'laser_lnk' has no publisher: /lidar stamps its messages with it (parameter 'frame_id'); did"
    )
    (found,) = check(_with_lidar("laser_lnk", said))
    assert 'value="laser_link"' in apply(_with_lidar("laser_lnk"), found.fixes[0].edits)["/main.launch"]


def test_the_frame_of_a_sensor_that_may_be_another_ones() -> None:
    driver = '<node pkg="p" type="driver" name="driver"/>\n'
    check(_with_lidar("laser_lnk", "info[FRM001] did you mean 'laser_link'?", more=driver))


def test_a_sensor_whose_frame_has_another_ending() -> None:
    said = "info[FRM001] 'laser_frame' has no publisher: /lidar stamps its messages with it (parameter 'frame_id'); did"
    (found,) = check(_with_lidar("laser_frame", said))
    assert not found.fixes


@pytest.mark.silent
@pytest.mark.parametrize(("frame", "child"), [("laser", "laser"), ("rear", "laser_link"), ("map", "mat")])
def test_sensors_of_which_nothing_is_wrong(frame: str, child: str) -> None:
    check(_with_lidar(frame, child=child))


_OWN = '<node pkg="p" exec="driver" name="driver"><param name="frame_id" value="{}"/></node>'


def test_the_frame_of_a_driver_that_nobody_knows() -> None:
    nodes = f"{robot(('base_link', 'laser_link'))}\n{_OWN.format('laser_lnk')}"
    said = (
        "info[FRM001] 'laser_lnk' has no publisher: /driver has it (parameter 'frame_id'); did you mean 'laser_link'?"
    )
    seen = {"/driver": {"params": {"~frame_id": ""}}}
    expected = below(_OWN.index("{}"), 9, said)
    (found,) = check(fixture(f"{nodes}\n{expected}", seen))
    assert 'value="laser_link"' in apply(fixture(nodes, seen), found.fixes[0].edits)["/main.launch.xml"]


@pytest.mark.silent
@pytest.mark.parametrize(
    "nodes",
    [
        _OWN.format("laser_link"),
        _OWN.format("sonar"),
        # It calls its frame so in each place.
        _OWN.format("laser_lnk")
        + '<node pkg="p" exec="driver" name="two"><param name="frame_id" value="laser_lnk"/></node>',
        _OWN.replace("frame_id", "output_frame").format("laser_lnk"),
    ],
)
def test_drivers_that_nobody_knows(nodes: str) -> None:
    params = {"params": {"~frame_id": "", "~output_frame": ""}}
    seen = {"/driver": params} | ({"/two": params} if "two" in nodes else {})
    check(fixture(f"{robot(('base_link', 'laser_link'))}\n{nodes}", seen))


def test_the_frame_of_a_simulated_sensor() -> None:
    sensor = "<gazebo><sensor name='lidar' type='gpu_lidar'><gz_frame_id>{}</gz_frame_id></sensor></gazebo>"
    spawn = '<node pkg="ros_gz_sim" exec="create" name="create"/>'
    node = robot(("base_link", "laser_link")).replace("&lt;/robot>", sensor.replace("<", "&lt;") + "&lt;/robot>")
    assert sensor.replace("<", "&lt;") in node
    package = "\n//- /ros_gz_sim/package.xml\n<package><name>ros_gz_sim</name></package>"
    first, _, last = node.format("laser_lnk").partition("\n")
    said = "info[FRM001] 'laser_lnk' has no publisher: a simulated sensor stamps its messages with it (<gz_frame_id> of"
    column = last.index("robot_description")
    expected = below(column, len("robot_description"), said)
    check(fixture(f"{first}\n{last}\n{expected}\n{spawn}", {}, package))
    check(fixture(f"{node.format('laser_link')}\n{spawn}", {}, package))
    check(fixture(node.format("laser_lnk"), {}, package))  # no simulator reads it


@pytest.mark.silent
@pytest.mark.parametrize(
    "nodes",
    [
        f"{_ODOM}\n{EKF.format('base_link', '')}",
        f"{robot(('base_footprint', 'base_link'))}\n{EKF.format('base_link', '')}",
        # Another launch has the robot.
        f"{_ODOM}\n{EKF.format('trailer', '')}",
        # Of no frame anything is known.
        EKF.format("base_link", ""),
        # Frames of localization are published by another launch, mostly.
        f"{_ODOM}\n{_UNKNOWN}\n{EKF.format('map', '')}",
    ],
)
def test_what_is_published_or_may_be(nodes: str) -> None:
    check(fixture(nodes, {}))


@pytest.mark.silent
def test_before_the_nodes_are_known() -> None:
    check(fixture(f"{_ODOM}\n{EKF.format('base_lnk', '')}"))


@pytest.mark.silent
def test_what_another_node_may_publish() -> None:
    driver = '<node pkg="p" exec="d" name="d"><param name="child_frame" value="trailer"/></node>'
    seen = {"/d": {"params": {"child_frame": ""}}}
    check(fixture(f"{_ROBOT}\n{driver}\n{EKF.format('trailer', '')}", seen))
