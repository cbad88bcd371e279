"""CTL010: a controller without a parameter that it requires."""

from dataclasses import replace

import pytest
from preflight_analysis.rules.registry import run_rules
from support.check import analyse, findings_of, read_fixture
from support.control_threads import hardware, launch, manager, publisher, spawner, urdf, workspace

_JOINTS = ("joint1", "joint2")
_TYPE = "joint_trajectory_controller/JointTrajectoryController"
_MANAGER = f"controller_manager:\n  ros__parameters:\n    arm: {{type: {_TYPE}}}\n"
_FULL = (
    "  ros__parameters:\n    joints: [joint1]\n    command_interfaces: [position]\n    state_interfaces: [position]\n"
)


def _said(params: str, args: str = "arm", given: str | None = "/p/controllers.yaml") -> list[str]:
    robot = publisher(urdf(_JOINTS, hardware(_JOINTS)))
    fixture = workspace(launch(robot, manager(given), spawner(args)), {"/p/controllers.yaml": params})
    return [f"{each.severity} {each.message}" for each in findings_of(fixture) if each.rule == "CTL010"]


def test_interfaces() -> None:
    """https://github.com/ros-planning/moveit_resources, before 210e13ad"""
    params = f"{_MANAGER}arm:\n  ros__parameters:\n    joints: [joint1]\n    state_interfaces: [position]\n"
    assert _said(params) == [f"warning controller 'arm' has no parameter 'command_interfaces', which {_TYPE} requires"]


def test_a_section_of_another_name() -> None:
    assert _said(f"{_MANAGER}arm_controller:\n{_FULL}") == [
        f"warning controller 'arm' has no parameter 'command_interfaces' and 'state_interfaces', which {_TYPE} "
        "requires; section 'arm_controller' sets it, and applies to no node"
    ]


@pytest.mark.silent
@pytest.mark.parametrize("key", ["arm", "/arm", "/**", "/**/arm"])
def test_a_section_that_is_for_it(key: str) -> None:
    assert _said(f"{_MANAGER}{key}:\n{_FULL}") == []


@pytest.mark.silent
def test_what_is_not_configured_or_known() -> None:
    assert _said(_MANAGER, "arm --load-only") == []
    assert _said(_MANAGER, "arm -p /elsewhere.yaml") == []
    assert _said(f"{_MANAGER}arm:\n{_FULL}", "arm -p /p/controllers.yaml") == []


def test_a_package_of_the_workspace_that_is_called_so() -> None:
    """https://github.com/MonashNovaRover/nova has a diff_drive_controller of its own."""
    package = "joint_trajectory_controller"
    files = {
        "/p/controllers.yaml": f"{_MANAGER}arm:\n  ros__parameters:\n    own: true\n",
        f"/{package}/package.xml": f"<package><name>{package}</name></package>",
    }
    robot = publisher(urdf(_JOINTS, hardware(_JOINTS)))
    context = analyse(read_fixture(workspace(launch(robot, manager(), spawner("arm")), files)))
    for folder, said in (("/", False), ("/elsewhere", True)):
        here = replace(context, environment=replace(context.environment, workspace=folder))
        assert ("CTL010" in {each.rule for each in run_rules(here)}) == said
