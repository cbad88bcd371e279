"""TOP006: the same nodes in two namespaces meet on one topic, as its name is absolute."""

from __future__ import annotations

import json

import pytest
from support.check import check

TWIST = "geometry_msgs/msg/Twist"
LAUNCH = """
    //- /robots.launch.xml
    <launch>
      <node pkg="p" exec="pilot" name="pilot" namespace="r1"/>
      <node pkg="p" exec="driver" name="driver" namespace="r1"/>
      <node pkg="p" exec="pilot" name="pilot" namespace="r2"/>
      {expected}
      <node pkg="p" exec="driver" name="driver" namespace="{other}"/>
    </launch>
    //- interfaces
    {interfaces}
"""
UNDER = "^" * len('<node pkg="p" exec="pilot" name="pilot" namespace="r2"/>')


def _launch(topic: str, type_: str = TWIST, *, expected: str = "", other: str = "r2", talks: bool = False) -> str:
    pilot = {"publishers": {topic: type_}, **({"subscribers": {topic: type_}} if talks else {})}
    driver = {"subscribers": {topic: type_}}
    interfaces = {"/r1/pilot": pilot, "/r2/pilot": pilot, "/r1/driver": driver, f"/{other}/driver": driver}
    return LAUNCH.format(expected=expected, other=other, interfaces=json.dumps(interfaces))


def test_commands_of_one_robot_reach_the_other() -> None:
    said = f"{UNDER} warning[TOP006] '/cmd_vel' is outside of the namespaces of both robots: /r1/driver receives from"
    check(_launch("/cmd_vel", expected=said))


@pytest.mark.silent
@pytest.mark.parametrize(
    ("topic", "type_", "talks"),
    [
        ("cmd_vel", TWIST, False),
        ("/tf", "tf2_msgs/msg/TFMessage", False),
        ("/markers", "visualization_msgs/msg/Marker", False),
        ("/joint_states", "sensor_msgs/msg/JointState", False),
        ("/fleet/offers", "std_msgs/msg/String", True),
    ],
)
def test_robots_that_are_apart_or_mean_to_talk(topic: str, type_: str, *, talks: bool) -> None:
    check(_launch(topic, type_, talks=talks))


def test_a_name_of_several_parts_may_be_meant_so() -> None:
    check(
        _launch(
            "/fleet/poses", "geometry_msgs/msg/PoseStamped", expected=f"{UNDER} info[TOP006] '/fleet/poses' is outside"
        )
    )


@pytest.mark.silent
def test_one_listener_for_both_is_a_station() -> None:
    check(_launch("/status", "std_msgs/msg/String", other="r1/arm"))


def test_a_remap_that_leaves_the_namespace_is_mended() -> None:
    found = check("""
        //- /robots.launch.xml
        <launch>
          <node pkg="p" exec="driver" name="driver" namespace="r1"><remap from="cmd_vel" to="/cmd_vel"/></node>
          <node pkg="p" exec="driver" name="driver" namespace="r2"><remap from="cmd_vel" to="/cmd_vel"/></node>
          <node pkg="p" exec="pilot" name="pilot" namespace="r1"><remap from="cmd_vel" to="/cmd_vel"/></node>
          <node pkg="p" exec="pilot" name="pilot" namespace="r2"><remap from="cmd_vel" to="/cmd_vel"/></node>
                                                                                           ^^^^^^^^ warning[TOP006] /r1/
        </launch>
        //- interfaces
        {"/r1/pilot": {"publishers": {"cmd_vel": "geometry_msgs/msg/Twist"}},
         "/r2/pilot": {"publishers": {"cmd_vel": "geometry_msgs/msg/Twist"}},
         "/r1/driver": {"subscribers": {"cmd_vel": "geometry_msgs/msg/Twist"}},
         "/r2/driver": {"subscribers": {"cmd_vel": "geometry_msgs/msg/Twist"}}}
    """)
    assert [fix.edits[0].text for fix in found[0].fixes] == ["cmd_vel"]
