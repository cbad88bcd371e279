"""CTL007: a hardware component that the robot does not have."""

import pytest
from support.check import check, findings_of
from support.controlled_robot import launch

_PARAMS = """
    /**:
      ros__parameters:
        update_rate: 100
"""


def _spawner(args: str) -> str:
    return f'<node pkg="controller_manager" exec="hardware_spawner" name="h" args="{args}"/>'


def test_a_slip() -> None:
    found = findings_of(launch(_spawner("whels --activate"), params=_PARAMS))
    assert [(each.rule, each.message) for each in found] == [
        ("CTL007", "hardware component 'whels' does not exist; did you mean 'wheels'?")
    ]


def test_another_name() -> None:
    (found,) = findings_of(launch(_spawner("gripper -c /controller_manager"), params=_PARAMS))
    assert found.message == "hardware component 'gripper' does not exist; the robot has 'wheels'"


@pytest.mark.silent
def test_the_component_of_the_robot() -> None:
    check(launch(_spawner("wheels --activate"), params=_PARAMS))


@pytest.mark.silent
def test_another_manager() -> None:
    check(launch(_spawner("gripper -c /other/controller_manager"), params=_PARAMS))
