"""MVT004: kinematics and limits that MoveIt asks for in a group, and that are given without it."""

import pytest
from support.check import findings_of
from support.planned_robot import MOVEIT, messages, ros2

_SOLVER = "manipulator: {kinematics_solver: kdl_kinematics_plugin/KDLKinematicsPlugin}"
_LIMITS = "joint_limits: {elbow: {has_velocity_limits: true, max_velocity: 1.0}}"
_SPEED = "cartesian_limits: {max_trans_vel: 1.0}"


def _given(*lines: str) -> str:
    return ros2(MOVEIT + "".join(f"        {line}\n" for line in lines))


@pytest.mark.parametrize(
    ("line", "name", "asked"),
    [
        (_SOLVER, "manipulator.kinematics_solver", "robot_description_kinematics.manipulator.kinematics_solver"),
        (
            _LIMITS,
            "joint_limits.elbow.has_velocity_limits",
            "robot_description_planning.joint_limits.elbow.has_velocity_limits",
        ),
        (_SPEED, "cartesian_limits.max_trans_vel", "robot_description_planning.cartesian_limits.max_trans_vel"),
    ],
)
def test_what_stands_outside_of_its_group(line: str, name: str, asked: str) -> None:
    assert messages(_given(line), "MVT004") == [f"parameter '{name}' has no effect: MoveIt reads '{asked}'"]


@pytest.mark.silent
def test_what_stands_in_its_group() -> None:
    kinematics = f"robot_description_kinematics: {{{_SOLVER}}}"
    assert not messages(_given(kinematics, f"robot_description_planning: {{{_LIMITS}, {_SPEED}}}"), "MVT004")
    assert not messages(_given(kinematics, _SOLVER), "MVT004"), "it is given twice, once where it is asked for"


_ROS1 = """
    <launch>
      <group ns="{}">
        <rosparam>manipulator: {{kinematics_solver: kdl_kinematics_plugin/KDLKinematicsPlugin}}</rosparam>
      </group>
      <node pkg="moveit_ros_move_group" type="move_group" name="move_group"/>
    </launch>
"""


@pytest.mark.parametrize(("namespace", "count"), [("/", 1), ("move_group", 1), ("robot_description_kinematics", 0)])
def test_of_ros1(namespace: str, count: int) -> None:
    found = [each for each in findings_of(_ROS1.format(namespace)) if each.rule == "MVT004"]
    assert len(found) == count
    assert all("MoveIt reads 'robot_description_kinematics/manipulator/kinematics_solver'" in f.message for f in found)
