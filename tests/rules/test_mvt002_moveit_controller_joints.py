"""MVT002: joints of a controller of MoveIt that are not those of the robot or of the controller."""

import pytest
from support.planned_robot import CONTROLLERS, LIST, MOVEIT, messages, ros1, ros2

_JOINTS = "[shoulder, elbow]"


def test_a_slip() -> None:
    assert messages(ros2(MOVEIT.replace(_JOINTS, "[shoulder, elbo]")), "MVT002") == [
        "joint 'elbo' does not exist: MoveIt controller 'arm' has it; did you mean 'elbow'?"
    ]
    assert messages(ros1(LIST.replace(_JOINTS, "[shoulder, elbo]")), "MVT002") == [
        "joint 'elbo' does not exist: MoveIt controller 'arm' has it; did you mean 'elbow'?"
    ]


def test_a_joint_that_the_controller_does_not_have() -> None:
    expected = (
        "MoveIt controller 'arm' has joint 'elbow', which the controller does not have: it refuses the trajectories"
    )
    assert messages(ros2(controllers=CONTROLLERS.replace(_JOINTS, "[shoulder]")), "MVT002") == [expected]
    assert messages(ros1(joints="[shoulder]"), "MVT002") == [expected]


def test_a_joint_that_moveit_does_not_have() -> None:
    expected = "MoveIt controller 'arm' lacks joint 'elbow', which the controller has: it refuses the trajectories"
    assert messages(ros2(MOVEIT.replace(_JOINTS, "[shoulder]")), "MVT002") == [expected]
    assert messages(ros1(LIST.replace(_JOINTS, "[shoulder]")), "MVT002") == [expected]


@pytest.mark.silent
def test_the_joints_of_the_robot_and_of_the_controller() -> None:
    assert not messages(ros2(), "MVT002")
    assert not messages(ros1(), "MVT002")


@pytest.mark.silent
def test_a_controller_that_takes_goals_for_some_joints() -> None:
    partial = CONTROLLERS.replace(_JOINTS, f"{_JOINTS}\n          allow_partial_joints_goal: true")
    assert not messages(ros2(MOVEIT.replace(_JOINTS, "[shoulder]"), partial), "MVT002")


@pytest.mark.silent
def test_a_controller_of_another_variant_of_the_robot() -> None:
    other = (
        MOVEIT.replace(_JOINTS, "[left_finger, right_finger]").replace("[arm]", "[hand]").replace("arm: {", "hand: {")
    )
    assert not messages(ros2(other), "MVT002")


@pytest.mark.silent
def test_a_joint_that_follows_another_one() -> None:
    """MoveIt does not send it (`TrajectoryExecutionManager::distributeTrajectory`)."""
    fixture = ros2(controllers=CONTROLLERS.replace(_JOINTS, "[shoulder]"))
    follows = "<child link='tool'/>".replace("<", "&lt;")
    mimic = "<mimic joint='shoulder'/>".replace("<", "&lt;")
    assert follows in fixture
    assert not messages(fixture.replace(follows, f"{follows}{mimic}"), "MVT002")
