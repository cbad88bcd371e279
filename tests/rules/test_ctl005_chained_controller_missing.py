"""CTL005: an interface of a controller that is not there."""

import pytest
from support.check import check
from support.controlled_robot import launch, spawner

_PARAMS = """
    controller_manager:
      ros__parameters:
        base: {type: diff_drive_controller/DiffDriveController}
        left_pid: {type: pid_controller/PidController}
    base:
      ros__parameters:
        right_wheel_names: [right_wheel]
        left_wheel_names: [left_pd/left_wheel]
"""


def test_a_slip() -> None:
    expected = (
        "                           ^^^^^^^^^^^^^^^^^^ warning[CTL005] chained controller 'left_pd' does not exist: "
        "'base' claims 'left_pd/left_wheel'; did you mean 'left_pid'?"
    )
    check(launch(spawner("left_pid base"), params=f"{_PARAMS}{expected}"))


@pytest.mark.silent
def test_one_that_is_there() -> None:
    check(launch(spawner("left_pid base"), params=_PARAMS.replace("left_pd/", "left_pid/")))
