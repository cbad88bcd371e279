"""The actions that MoveIt is a client of."""

from __future__ import annotations

from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.incremental.kept import Kept
from preflight_analysis.nodl.moveit_clients import with_moveit_clients
from preflight_analysis.tracing.interface import NOT_RUN
from support.check import analyse, read_fixture
from support.planned_robot import MOVEIT, ros1, ros2


def _clients(tree: LaunchTree) -> list[tuple[str, str | None]]:
    interfaces = with_moveit_clients(tree, [NOT_RUN for _ in tree.nodes], Kept())
    ends = [end for interface in interfaces for end in interface.endpoints]
    assert {end.role for end in ends} <= {"action_client"}
    return [(end.name, end.type) for end in ends]


def test_the_controllers_of_ros2() -> None:
    tree = analyse(read_fixture(ros2())).tree
    assert _clients(tree) == [("arm/follow_joint_trajectory", "control_msgs/action/FollowJointTrajectory")]


def test_the_list_of_ros1() -> None:
    tree = analyse(read_fixture(ros1())).tree
    assert _clients(tree) == [("arm/follow_joint_trajectory", "control_msgs/FollowJointTrajectory")]


def test_another_manager_has_its_own_ones() -> None:
    tree = analyse(read_fixture(ros2(MOVEIT.replace("MoveItSimpleControllerManager", "Other")))).tree
    assert not _clients(tree)
