"""CTL001: a joint of a controller that the robot does not have."""

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
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


_URDF = (
    "<robot name='r'><link name='a'/><link name='b'/><link name='c'/>"
    "<joint name='left_wheel' type='continuous'><parent link='a'/><child link='b'/></joint>"
    "<joint name='rear_caster' type='continuous'><parent link='a'/><child link='c'/></joint></robot>"
).replace("<", "&lt;")


def _ros1(base: str, extra: str = "", urdf: str = _URDF) -> str:
    description = f'<param name="robot_description" value="{urdf}"/>' if urdf else ""
    return f"""
        <launch>
          {description}
          <rosparam>
            base: {base}
            states: {{type: joint_state_controller/JointStateController, extra_joints: [{extra}]}}
          </rosparam>
          <node pkg="controller_manager" type="spawner" name="s" args="base states"/>
        </launch>
        //- /controller_manager/package.xml
        <package><name>controller_manager</name></package>
    """


_BASE = "{{type: diff_drive_controller/DiffDriveController, left_wheel: left_wheel, right_wheel: {}}}"


def _found(text: str) -> list[tuple[str, str]]:
    return [(f.severity, f.message) for f in findings_of(text) if f.rule == "CTL001"]


def test_joints_of_ros_1() -> None:
    of_base = "'/base' (diff_drive_controller/DiffDriveController) uses it"
    assert _found(_ros1(_BASE.format("rear_castor"))) == [
        ("error", f"joint 'rear_castor' does not exist: {of_base}; did you mean 'rear_caster'?")
    ]
    assert _found(_ros1(_BASE.format("other_joint"))) == [("warning", f"joint 'other_joint' does not exist: {of_base}")]


def test_extra_joints_of_ros_1() -> None:
    of_states = "'/states' (joint_state_controller/JointStateController) uses it"
    assert _found(_ros1(_BASE.format("rear_caster"), "{name: rear_castor}")) == [
        ("warning", f"joint 'rear_castor' does not exist: {of_states}; did you mean 'rear_caster'?")
    ]


@pytest.mark.silent
@pytest.mark.parametrize("urdf", [_URDF, ""])
def test_joints_of_ros_1_that_are_there_or_not_known(urdf: str) -> None:
    assert _found(_ros1(_BASE.format("rear_caster"), "{name: rear_caster}", urdf)) == []


@pytest.mark.parametrize(("robot", "others", "said"), [("", 2, True), ("", 1, False), ("<robot name='r'/>", 2, False)])
def test_a_name_that_no_other_file_has(tmp_path: Path, robot: str, others: int, said: bool) -> None:
    description = f'<param name="robot_description" value="{robot.replace("<", "&lt;")}"/>' if robot else ""
    texts = {
        "package.xml": "<package><name>p</name></package>",
        "launch/a.launch": f"<launch>{description}</launch>",
        "config/arm.yaml": "arm: {joints: [r_shouler_joint, l_elbow_joint]}",
        "config/others.yaml": "joints: [r_shoulder_joint, r_elbow_joint]",
        "src/a.py": "JOINTS = ['r_shoulder_joint', 'r_elbow_joint']" if others > 1 else "",
    }
    for place, text in texts.items():
        path = tmp_path / "src/p" / place
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    environment = detect_environment(str(tmp_path), {"ROS_VERSION": "1"}, root=str(tmp_path / "nowhere"))
    workspace = Workspace(environment, Sources())
    static = workspace.static(str(tmp_path / "src/p/launch/a.launch"))
    found = [each.message for each, _ in workspace.branches(static).findings if each.rule == "CTL001"]
    message = "joint 'r_shouler_joint' is in no other file; did you mean 'r_shoulder_joint', as in 2 files nearby?"
    assert found == [message] * said


_ARM = """
    controller_manager:
      ros__parameters:
        arm: {type: joint_trajectory_controller/JointTrajectoryController}
    arm:
      ros__parameters:
        joints: [left_wheel, right_wheel]
        command_interfaces: [velocity]
        state_interfaces: [velocity]
        constraints:
          stopped_velocity_tolerance: 0.01
          left_wheel: {goal: 0.1}
"""


def test_what_is_set_for_a_joint_of_no_controller_has_no_effect() -> None:
    params = f"""{_ARM}
          right_wheell: {{goal: 0.1, trajectory: 0.2}}
                         ^^^^ warning[CTL001] 'constraints' for joint 'right_wheell' has no effect: 'arm'
        gains:
          rear_wheel: {{p: 0.1}}
                       ^ warning[CTL001] 'gains' for joint 'rear_wheel' has no effect: 'arm' (joint_trajectory_con
"""
    check(launch(spawner("arm"), params=params))


@pytest.mark.silent
def test_what_is_set_for_its_joints() -> None:
    check(launch(spawner("arm"), params=f"{_ARM}\n        gains: {{left_wheel: {{p: 0.1}}}}\n"))


def test_what_is_set_for_a_joint_of_no_controller_of_ros1() -> None:
    base = (
        "{{type: effort_controllers/JointTrajectoryController, joints: [rear_caster], {}: {{rear_castor: {{p: 1}}}}}}"
    )
    of_base = (
        "'/base' (effort_controllers/JointTrajectoryController) does not have this joint; did you mean 'rear_caster'?"
    )
    assert _found(_ros1(base.format("gains"))) == [
        ("warning", f"'gains' for joint 'rear_castor' has no effect: {of_base}"),
    ]
    assert _found(_ros1(base.format("gains").replace("castor", "caster"))) == []
