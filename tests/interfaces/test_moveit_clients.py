"""The actions that MoveIt is a client of."""

from __future__ import annotations

from itertools import repeat

from preflight_analysis.documents.disk import Disk
from preflight_analysis.evaluation.meanings import KnownMeanings
from preflight_analysis.incremental.kept import Kept
from preflight_analysis.interfaces.moveit_clients import clients_asked, moveit_clients
from preflight_analysis.interfaces.part import Launch
from preflight_analysis.tracing.interface import NOT_RUN
from support.check import Fixture, analyse, environment_of, read_fixture
from support.planned_robot import MOVEIT, ros1, ros2


def _clients(fixture: Fixture) -> list[tuple[str, str | None]]:
    tree = analyse(fixture).tree
    known = KnownMeanings((), None, tree.generation)
    launch = Launch(tree, environment_of(fixture), {}, Disk(), Kept(), known)
    rows = clients_asked(launch, [NOT_RUN for _ in tree.nodes])
    parts = map(moveit_clients, tree.nodes, repeat(NOT_RUN), *rows.columns) if rows is not None else ()
    ends = [end for part in parts if part is not None for end in part.endpoints]
    assert {end.role for end in ends} <= {"action_client"}
    return [(end.name, end.type) for end in ends]


def test_the_controllers_of_ros2() -> None:
    assert _clients(read_fixture(ros2())) == [
        ("arm/follow_joint_trajectory", "control_msgs/action/FollowJointTrajectory")
    ]


def test_the_list_of_ros1() -> None:
    assert _clients(read_fixture(ros1())) == [("arm/follow_joint_trajectory", "control_msgs/FollowJointTrajectory")]


def test_another_manager_has_its_own_ones() -> None:
    assert not _clients(read_fixture(ros2(MOVEIT.replace("MoveItSimpleControllerManager", "Other"))))
