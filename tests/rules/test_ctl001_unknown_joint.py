"""CTL001: a joint of a controller that the robot does not have."""

import pytest
from support.check import check, findings_of
from support.controlled_robot import launch, spawner

_PARAMS = """
    controller_manager:
      ros__parameters:
        base: {type: diff_drive_controller/DiffDriveController}
    base:
      ros__parameters:
        left_wheel_names: [left_wheel]
        right_wheel_names: [right_weel]
"""


def test_a_slip() -> None:
    expected = "                            ^^^^^^^^^^ error[CTL001] joint 'right_weel' does not exist: 'base'"
    (found,) = check(launch(spawner("base"), params=f"{_PARAMS}{expected}"))
    assert [fix.title for fix in found.fixes] == ["Replace 'right_weel' with 'right_wheel'"]


@pytest.mark.silent
def test_joints_that_are_there() -> None:
    check(launch(spawner("base"), params=_PARAMS.replace("weel", "wheel")))


@pytest.mark.silent
def test_a_controller_that_nobody_loads() -> None:
    check(launch(params=_PARAMS))


def test_a_controller_of_another_variant_of_the_robot() -> None:
    params = _PARAMS.replace("[left_wheel]", "[gripper_jaw]").replace("[right_weel]", "[gripper_finger]")
    found = findings_of(launch(spawner("base"), params=params))
    assert [(each.rule, each.severity) for each in found] == [("CTL001", "info")] * 2
