"""CTL004: a spawner that asks another manager than there is."""

import pytest
from support.check import check
from support.controlled_robot import launch, simulated, spawner

_PARAMS = """
    /**:
      ros__parameters:
        base: {type: my_controllers/Base}
"""


def test_a_manager_in_a_namespace() -> None:
    tag = spawner("base -c /controller_manager")
    text = "base -c /controller_manager"
    expected = (
        f"{' ' * tag.index(text)}{'^' * len(text)} warning[CTL004] controller manager '/controller_manager' is not in "
        "this launch: /s waits for it; the launch has '/robot/controller_manager'"
    )
    check(launch(f"{tag}\n{expected}", params=_PARAMS, manager="/robot/controller_manager"))


@pytest.mark.silent
def test_the_manager_of_the_launch() -> None:
    check(launch(spawner("base"), params=_PARAMS))
    named = spawner("base -c /robot/controller_manager")
    check(launch(named, params=_PARAMS, manager="/robot/controller_manager"))


@pytest.mark.silent
def test_a_namespace_that_the_spawner_is_given() -> None:
    for args in ("base -n robot", "base --namespace=/robot -c controller_manager", "--controller base -n /robot"):
        check(launch(spawner(args), params=_PARAMS, manager="/robot/controller_manager"))


@pytest.mark.silent
def test_a_program_that_may_have_the_manager() -> None:
    """https://github.com/DoosanRobotics/doosan-robot2: mujoco_ros2_control has a manager in it."""
    simulator = (
        '<node pkg="p" exec="simulator" namespace="/sim"><param name="robot_description" value="&lt;robot/>"/></node>'
    )
    check(launch(simulator, spawner("base -c /sim/controller_manager"), params=_PARAMS))


@pytest.mark.silent
def test_a_controller_that_the_other_manager_does_not_have() -> None:
    check(launch(spawner("other -c /sim/controller_manager"), params=_PARAMS))


def _elsewhere(args: str, program: str = "spawner", there: str = "/robot/controller_manager") -> str:
    tag = spawner(args, program=program)
    return (
        f"{tag}\n{' ' * tag.index(args)}{'^' * len(args)} warning[CTL004] controller manager '/controller_manager' is "
        f"not in this launch: /s waits for it; the launch has '{there}'"
    )


def test_a_spawner_of_hardware() -> None:
    check(
        launch(_elsewhere("wheels --activate", "hardware_spawner"), params=_PARAMS, manager="/robot/controller_manager")
    )


@pytest.mark.silent
def test_hardware_of_the_manager() -> None:
    check(launch(spawner("wheels --activate", program="hardware_spawner"), params=_PARAMS))
    # Hardware that no manager of the launch has is that of another one.
    other = spawner("arm --activate", program="hardware_spawner")
    check(launch(other, params=_PARAMS, manager="/robot/controller_manager"))


@pytest.mark.parametrize(("namespace", "name", "there"), [
    ("robot", "", "/robot/controller_manager"),
    ("/robot", "manager", "/robot/manager"),
    ("", "manager", "/manager"),
])  # fmt: skip
def test_the_manager_of_a_simulated_robot(namespace: str, name: str, there: str) -> None:
    check(simulated(_elsewhere("base", there=there), params=_PARAMS, namespace=namespace, name=name))
    check(simulated(spawner(f"base -c {there}"), params=_PARAMS, namespace=namespace, name=name))


def test_the_hardware_of_a_simulated_robot() -> None:
    check(simulated(_elsewhere("wheels --activate", "hardware_spawner"), params=_PARAMS, namespace="robot"))
