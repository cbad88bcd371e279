"""CTL002: an interface that a joint does not have."""

import re

import pytest
from support.check import check, findings_of
from support.controlled_robot import launch, spawner

_BASE = """
    controller_manager:
      ros__parameters:
        base: {type: velocity_controllers/JointGroupVelocityController}
    base:
      ros__parameters:
        joints: [left_wheel]
"""
_ARM = """
    controller_manager:
      ros__parameters:
        arm: {type: joint_trajectory_controller/JointTrajectoryController}
    arm:
      ros__parameters:
        command_interfaces: [velocity]
        state_interfaces: [velocity, position]
        joints: [left_wheel]
"""


def test_a_command_interface() -> None:
    expected = (
        "                 ^^^^^^^^^^ error[CTL002] joint 'left_wheel' has no command interface 'velocity', "
        "which 'base' (velocity_controllers/JointGroupVelocityController) claims; it has 'position'"
    )
    check(launch(spawner("base"), params=f"{_BASE}{expected}", interface="position"))


@pytest.mark.parametrize(
    ("plugin", "severity"), [("canopen_ros2_control/RobotSystem", "info"), ("mock_components/GenericSystem", "error")]
)
def test_a_joint_whose_interfaces_the_hardware_makes(plugin: str, severity: str) -> None:
    """https://github.com/ros-industrial/ros2_canopen: `RobotSystem` has them, the description only the joints."""
    text = launch(spawner("base"), params=_BASE, interface="position")
    text = re.sub(r"&lt;command_interface name='\w+'/>", "", text).replace("mock_components/GenericSystem", plugin)
    (found,) = findings_of(text)
    assert (found.rule, found.severity) == ("CTL002", severity)


def test_a_state_interface_of_those_that_a_parameter_lists() -> None:
    expected = "                 ^^^^^^^^^^ error[CTL002] joint 'left_wheel' has no state interface 'position'"
    check(launch(spawner("arm"), params=f"{_ARM}{expected}"))


@pytest.mark.silent
def test_interfaces_that_are_there() -> None:
    check(launch(spawner("base"), params=_BASE))
    check(launch(spawner("arm"), params=_ARM.replace(", position", "")))


_NAMED = """
    controller_manager:
      ros__parameters:
        grip: {{type: own/Gripper}}
    grip:
      ros__parameters:
        max_effort_interface: left_wheel/{}
        tool_interface: tool/on
"""


def test_an_interface_with_its_joint_in_any_parameter() -> None:
    (found,) = findings_of(launch(spawner("grip"), params=_NAMED.format("effort")))
    assert (found.severity, found.message) == (
        "warning",
        "joint 'left_wheel' has no interface 'effort', which parameter 'max_effort_interface' of 'grip' (own/Gripper) "
        "names; it has 'velocity'",
    )


@pytest.mark.silent
def test_an_interface_with_its_joint_that_is_there() -> None:
    assert findings_of(launch(spawner("grip"), params=_NAMED.format("velocity"))) == []
