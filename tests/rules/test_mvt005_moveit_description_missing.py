"""MVT005: a MoveGroupInterface without a robot description."""

import json

import pytest
from support.check import findings_of

_LAUNCH = """//- /robot.launch.xml
<launch>
  {others}
  <node pkg="p" exec="t" name="pick" namespace="{namespace}">{params}</node>
</launch>
//- interfaces
{interfaces}
"""
_CLIENT = {"clients": {"query_planner_interface": "moveit_msgs/srv/QueryPlannerInterfaces"}}
_PUBLISHER = {"publishers": {"robot_description": "std_msgs/msg/String"}}
_STATE = '<node pkg="p" exec="state" name="state"/>'
_GROUP = '<node pkg="moveit_ros_move_group" exec="move_group" name="move_group">{}</node>'
_PUBLISHES = '<param name="publish_robot_description_semantic" value="{}"/>'
_URDF = '<param name="robot_description" value="a"/>'
_SRDF = '<param name="robot_description_semantic" value="a"/>'


def _found(others: str, params: str = "", namespace: str = "", *, has_interface: bool = True) -> list[tuple[str, str]]:
    client = {f"{namespace and '/'}{namespace}/pick": _CLIENT if has_interface else {}}
    interfaces = json.dumps({**client, **({"/state": _PUBLISHER} if _STATE in others else {})})
    text = _LAUNCH.format(others=others, params=params, namespace=namespace, interfaces=interfaces)
    found = [each for each in findings_of(text) if each.rule == "MVT005"]
    return [(each.severity, each.message.partition(": ")[0]) for each in found]


def _says(missing: str, node: str = "/pick") -> str:
    return f"{node} has a MoveGroupInterface and does not get '{missing}'"


@pytest.mark.parametrize(
    ("others", "params", "missing"),
    [
        (_GROUP.format(""), "", "robot_description"),
        (_GROUP.format(""), _SRDF, "robot_description"),
        (_GROUP.format("") + _STATE, "", "robot_description_semantic"),
        (_GROUP.format(_PUBLISHES.format("false")), _URDF, "robot_description_semantic"),
    ],
)
def test_what_it_does_not_get(others: str, params: str, missing: str) -> None:
    assert _found(others, params) == [("warning", _says(missing))]


def test_move_group_may_be_in_another_launch() -> None:
    ((severity, _),) = _found(_STATE)
    assert severity in ("info", "hint")


def test_the_topic_is_in_the_namespace_of_the_node() -> None:
    said = _says("robot_description", "/left/pick")
    assert _found(_GROUP.format("") + _STATE, _SRDF, "left") == [("warning", said)]


@pytest.mark.silent
def test_what_it_gets() -> None:
    assert not _found(_GROUP.format(""), _URDF + _SRDF)
    assert not _found(_STATE + _GROUP.format(_PUBLISHES.format("true")))
    remap = '<remap from="robot_description" to="/robot_description"/>'
    assert not _found(_GROUP.format("") + _STATE, _SRDF + remap, "left")
    elsewhere = '<param from="$(find-pkg-share not_here)/a.yaml"/>'
    assert not _found(_GROUP.format(""), elsewhere), "the file may have them"
    assert not _found(_GROUP.format(""), has_interface=False), "it has no such interface"
