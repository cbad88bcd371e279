"""MVT001: a controller of MoveIt that the launch loads under another name."""

import pytest
from support.planned_robot import LIST, MOVEIT, messages, ros1, ros2


def test_another_name() -> None:
    wrong = MOVEIT.replace("[arm]", "[arm_controller]").replace("arm: {", "arm_controller: {")
    (found,) = messages(ros2(wrong), "MVT001")
    assert found == (
        "MoveIt controller 'arm_controller' has no action server '/arm_controller/follow_joint_trajectory'; "
        "did you mean 'arm', which moves the same joints?"
    )


def test_another_namespace() -> None:
    (found,) = messages(ros2(namespace="/left"), "MVT001")
    assert "did you mean 'left/arm', which the launch loads?" in found


def test_another_action() -> None:
    wrong = MOVEIT.replace("FollowJointTrajectory", "GripperCommand").replace("follow_joint_trajectory", "gripper_cmd")
    (found,) = messages(ros2(wrong), "MVT001")
    assert found.startswith(
        "MoveIt controller 'arm' asks for action 'gripper_cmd'; 'arm' (joint_trajectory_controller/"
    )


def test_ros1() -> None:
    (found,) = messages(ros1(LIST.replace("name: arm", "name: arm_ctrl")), "MVT001")
    assert "did you mean 'arm', which moves the same joints?" in found


@pytest.mark.silent
def test_controllers_that_are_loaded() -> None:
    for fixture in (ros2(), ros1()):
        assert not messages(fixture, "MVT001")


@pytest.mark.silent
def test_a_controller_of_other_joints() -> None:
    """Another launch may start it."""
    wrong = MOVEIT.replace("[arm]", "[gripper_jaw]").replace("arm: {", "gripper_jaw: {").replace("[shoulder", "[finger")
    assert not messages(ros2(wrong), "MVT001")


@pytest.mark.silent
def test_another_manager_of_moveit() -> None:
    wrong = MOVEIT.replace("[arm]", "[other]").replace("arm: {", "other: {")
    assert not messages(ros2(wrong.replace("MoveItSimpleControllerManager", "Other")), "MVT001")
