"""CTL003: two controllers that claim one interface."""

import pytest
from support.check import check, findings_of
from support.controlled_robot import launch, spawner

_PARAMS = """
    controller_manager:
      ros__parameters:
        base: {type: diff_drive_controller/DiffDriveController}
        wheels: {type: velocity_controllers/JointGroupVelocityController}
    base:
      ros__parameters:
        left_wheel_names: [left_wheel]
        right_wheel_names: [right_wheel]
    wheels:
      ros__parameters:
        joints: [right_wheel]
"""


def test_both_are_activated() -> None:
    second = spawner("wheels", "t")
    expected = f"{'^' * len(second)} warning[CTL003] command interface 'right_wheel/velocity' is claimed by 'base'"
    (found,) = check(launch(spawner("base"), f"{second}\n{expected}", params=_PARAMS))
    assert [each.message for each in found.related] == ["'wheels' has the joint here", "'base' is spawned here"]


@pytest.mark.silent
@pytest.mark.parametrize("option", ["--inactive", "--load-only", "--stopped"])
def test_one_is_only_loaded(option: str) -> None:
    check(launch(spawner("base"), spawner(f"wheels {option}", "t"), params=_PARAMS))


@pytest.mark.silent
def test_two_spawners_of_one_controller() -> None:
    check(launch(spawner("base"), spawner("base", "t"), params=_PARAMS))


@pytest.mark.silent
def test_other_joints() -> None:
    lists = "left_wheel_names: [left_wheel]\n        right_wheel_names: [right_wheel]"
    params = _PARAMS.replace("diff_drive_controller/DiffDrive", "velocity_controllers/JointGroupVelocity")
    check(launch(spawner("base wheels"), params=params.replace(lists, "joints: [left_wheel]")))


def test_a_launch_that_is_not_known_in_full_is_information() -> None:
    unknown = '<node pkg="p" exec="n" name="n"><param name="x" value="$(command \'date\')"/></node>'
    spawners = (spawner("base", "a"), spawner("wheels", "b"))
    found = findings_of(launch(*spawners, unknown, params=_PARAMS))
    assert [each.severity for each in found if each.rule == "CTL003"] == ["info"]


@pytest.mark.parametrize(("right", "twice"), [("rear_left", True), ("rear_right", False)])
def test_a_joint_on_both_sides(right: str, twice: bool) -> None:
    """https://github.com/warthog-cpr/warthog, before 27863465"""
    found = findings_of(
        f"""
        <launch>
          <rosparam ns="base">
            left_wheel: [front_left, rear_left]
            right_wheel: [front_right, {right}]
          </rosparam>
        </launch>
        """
    )
    assert [each.message for each in found if each.rule == "CTL003"] == (
        ["joint 'rear_left' is in 'left_wheel' and in 'right_wheel' of controller '/base'"] if twice else []
    )
