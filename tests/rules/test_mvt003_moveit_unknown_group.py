"""MVT003: groups and joints in the parameters of MoveIt that are slips."""

import pytest
from support.planned_robot import MOVEIT, messages, ros2

_SRDF = "<robot name='r'><group name='manipulator'><chain base_link='base' tip_link='tool'/></group></robot>"
_MORE = """\
        robot_description_kinematics:
          {group}:
            kinematics_solver: kdl_kinematics_plugin/KDLKinematicsPlugin
        ompl:
          {group}:
            planner_configs: [RRTConnect]
        robot_description_planning:
          joint_limits:
            {joint}: {{has_velocity_limits: true, max_velocity: 1.0}}
"""


def _robot(group: str = "manipulator", joint: str = "elbow") -> str:
    return ros2(f"{MOVEIT}{_MORE.format(group=group, joint=joint)}", srdf=_SRDF)


def test_a_slip_of_a_group() -> None:
    kinematics, planners = messages(_robot(group="manipulater"), "MVT003")
    assert kinematics == (
        "group 'manipulater' does not exist: MoveIt does not read "
        "'robot_description_kinematics.manipulater.kinematics_solver'; did you mean 'manipulator'?"
    )
    assert "'ompl.manipulater.planner_configs'" in planners


def test_a_slip_of_a_joint() -> None:
    (found,) = messages(_robot(joint="elbw"), "MVT003")
    assert found.startswith("joint 'elbw' does not exist: MoveIt does not read")


@pytest.mark.silent
def test_groups_and_joints_of_the_robot() -> None:
    assert not messages(_robot(), "MVT003")


@pytest.mark.silent
def test_a_group_of_another_name() -> None:
    """The file may be for several robots."""
    assert not messages(_robot(group="gripper", joint="finger_joint"), "MVT003")
