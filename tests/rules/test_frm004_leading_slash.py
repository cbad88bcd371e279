"""FRM004: a frame with a slash in front, which tf2 refuses."""

import json

import pytest
from support.check import apply, check, findings_of
from support.frame_launch import EKF, EKF_COLUMN, below, fixture, static


def test_a_parameter() -> None:
    said = (
        "warning[FRM004] frame '/base' begins with '/', which tf2 refuses: /ekf uses it (parameter 'base_link_frame')"
    )
    expected = below(EKF_COLUMN, 5, said)
    text = fixture(f"{static('s', 'odom', 'base')}\n{EKF.format('/base', chr(10) + expected + chr(10))}")
    (found,) = check(text)
    assert 'name="base_link_frame" value="base"' in apply(text, found.fixes[0].edits)["/main.launch.xml"]


@pytest.mark.silent
def test_what_is_taken() -> None:
    # Broadcasters take the slash off.
    check(fixture(f"{static('s', '/odom', '/base')}\n{EKF.format('base', '')}"))


@pytest.mark.silent
def test_a_component_that_broadcasts_it() -> None:
    """As in moveit_servo."""
    params = '<param name="frame_id" value="/odom"/><param name="child_frame_id" value="/base"/>'
    plugin = f'<composable_node pkg="tf2_ros" plugin="tf2_ros::StaticTransformBroadcasterNode" name="s">{params}'
    container = '<node_container pkg="rclcpp_components" exec="component_container" name="c">'
    packages = "\n//- /rclcpp_components/package.xml\n<package><name>rclcpp_components</name></package>"
    found = findings_of(fixture(f"{container}{plugin}</composable_node></node_container>", {}, packages))
    assert not [each for each in found if each.rule == "FRM004"]


@pytest.mark.silent
def test_ros_1_takes_it_off() -> None:
    node = """<node pkg="robot_localization" type="ekf_localization_node" name="ekf">
      <param name="base_link_frame" value="/base"/></node>"""
    package = "\n//- /robot_localization/package.xml\n<package><name>robot_localization</name></package>"
    check(f"<launch>{node}</launch>{package}")


_UNKNOWN = '<node pkg="p" {}="driver" name="driver"/>'


def _source(call: str, looked_up: bool = True) -> dict[str, object]:
    return {"/driver": {"frame_uses": [["/map", call, looked_up, False, "/p/src/d.cpp", 7]], "source": "settings"}}


@pytest.mark.parametrize(
    ("call", "severity"), [("lookup_transform", "warning"), ("sensor_msgs/Imu", "info"), ("lookupTransform", "warning")]
)
def test_the_source_of_a_node(call: str, severity: str) -> None:
    node = _UNKNOWN.format("exec")
    said = f"{severity}[FRM004] frame '/map' begins with '/', which tf2 refuses: /driver uses it ({call} in d.cpp:7)"
    check(fixture(f"{node}\n{below(0, len(node), said)}", _source(call, "/" not in call)))


@pytest.mark.silent
@pytest.mark.parametrize("call", ["MessageFilter", "sensor_msgs/Joy"])
def test_what_takes_the_slash_off_or_is_no_frame(call: str) -> None:
    check(fixture(_UNKNOWN.format("exec"), _source(call, "/" not in call)))


def test_tf2_in_ros_1() -> None:
    node = _UNKNOWN.format("type")
    said = (
        "warning[FRM004] frame '/map' begins with '/', which tf2 refuses: /driver uses it (Buffer::lookupTransform in"
    )
    interfaces = json.dumps(_source("Buffer::lookupTransform"))
    check(f"<launch>\n{node}\n{below(0, len(node), said)}\n</launch>\n//- interfaces\n{interfaces}")


@pytest.mark.silent
@pytest.mark.parametrize(("call", "looked_up"), [("lookupTransform", True), ("sensor_msgs/Imu", False)])
def test_tf_in_ros_1(call: str, looked_up: bool) -> None:
    interfaces = json.dumps(_source(call, looked_up))
    check(f"<launch>\n{_UNKNOWN.format('type')}\n</launch>\n//- interfaces\n{interfaces}")


_MOVE_BASE = (
    '<node pkg="move_base" type="move_base" name="m"><param name="global_costmap/global_frame" value="/map"/></node>'
)


def test_move_base_asks_tf2() -> None:
    said = (
        "warning[FRM004] frame '/map' begins with '/', which tf2 refuses: /m uses it (parameter 'global_costmap.global"
    )
    expected = below(_MOVE_BASE.index("/map"), 4, said)
    package = "//- /move_base/package.xml\n<package><name>move_base</name></package>"
    check(f"<launch>\n{_MOVE_BASE}\n{expected}\n</launch>\n{package}")


_COSTMAP = """
        <launch>
          <node pkg="own" type="explore" name="explore">
            <rosparam ns="local_costmap">{{global_frame: {}, robot_base_frame: base_link}}</rosparam>
          </node>
        </launch>
        //- /own/package.xml
        <package><name>own</name></package>
    """


def test_a_costmap_of_another_node_of_ros_1() -> None:
    (found,) = [f for f in findings_of(_COSTMAP.format("/odom")) if f.rule == "FRM004"]
    assert found.message == (
        "frame '/odom' begins with '/', which tf2 refuses: '/explore/local_costmap/global_frame' has it"
    )


@pytest.mark.silent
def test_a_costmap_of_another_node_of_ros_1_without_a_slash() -> None:
    assert [f for f in findings_of(_COSTMAP.format("odom")) if f.rule == "FRM004"] == []


_LIDAR = """
        //- /main.launch.xml
        <launch>
          <node pkg="own" exec="lidar" name="lidar"><param name="frame_id" value="{}"/></node>
        </launch>
        //- /own/package.xml
        <package><name>own</name></package>
    """


def test_a_parameter_of_a_node_that_is_not_known() -> None:
    (found,) = [f for f in findings_of(_LIDAR.format("/laser")) if f.rule == "FRM004"]
    assert found.message == "frame '/laser' begins with '/', which tf2 refuses: /lidar gets it as 'frame_id'"


def test_one_of_a_node_that_broadcasts_transforms() -> None:
    """Plankton's message_to_tf, whose frames tf2 takes."""
    seen = '{"/lidar": {"publishers": {"/tf": "tf2_msgs/msg/TFMessage"}}}'
    text = f"{_LIDAR.format('/laser').rstrip()}\n        //- interfaces\n        {seen}\n"
    (found,) = [f for f in findings_of(text) if f.rule == "FRM004"]
    assert found.severity == "info"


@pytest.mark.silent
def test_a_parameter_of_a_node_that_is_not_known_without_a_slash() -> None:
    assert [f for f in findings_of(_LIDAR.format("laser")) if f.rule == "FRM004"] == []
