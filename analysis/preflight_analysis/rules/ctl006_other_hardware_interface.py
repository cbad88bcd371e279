"""CTL006: a controller of ros_control that asks for an interface which the joint does not have in Gazebo (ROS 1).

`DefaultRobotHWSim::initSim` registers each joint of a transmission with the first interface that it names
(gazebo_ros_control/src/default_robot_hw_sim.cpp of ros-simulation/gazebo_ros_pkgs), and a controller that finds none of
its own type there is not loaded: `Could not find resource 'x' in 'hardware_interface::EffortJointInterface'`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from preflight_analysis.evaluation.ros1.spawners import loaded_by
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.model.context import Context
from preflight_analysis.model.controllers import joints_of_ros1, simulated_of_ros1
from preflight_analysis.model.robots import written
from preflight_analysis.robot.model import Description
from preflight_analysis.robot.of_launch import Robot
from preflight_analysis.rules.further_reading import ROS_CONTROL_GAZEBO
from preflight_analysis.rules.rule import Rule

_ASKED = {
    "effort_controllers": "EffortJointInterface",
    "position_controllers": "PositionJointInterface",
    "velocity_controllers": "VelocityJointInterface",
    "diff_drive_controller": "VelocityJointInterface",
}
"""The interface that the controllers of a package ask for (ros-controls/ros_controllers 678b92a)."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    robot = simulated_of_ros1(context)
    interfaces = _interfaces(robot.description) if robot is not None else {}
    if robot is None or not interfaces:
        return
    for node in context.tree.nodes:
        for controller in loaded_by(node):
            yield from _of_controller(rule, context, robot, interfaces, controller, node)


def _of_controller(
    rule: Rule, context: Context, robot: Robot, interfaces: Mapping[str, str], controller: str, spawner: LaunchNode
) -> Iterator[Finding]:
    type_ = context.tree.params.get(f"{controller}/type")
    asked = _ASKED.get(type_.value.partition("/")[0]) if type_ is not None and isinstance(type_.value, str) else None
    if type_ is None or asked is None:
        return
    joints = {joint.name for joint in robot.description.joints}
    wrong = [
        (joint, interfaces.get(joint))
        for joint in (each.joint for each in joints_of_ros1(context.tree, controller) if not each.is_extra)
        if joint in joints and interfaces.get(joint) != asked
    ]
    if not wrong:
        return
    joint, has = wrong[0]
    what = f"interface '{has}'" if has else "no transmission"
    place, _ = written(context, robot, "joint", "name", joint, "transmission")
    yield rule.claim(
        f"joint '{joint}' has {what}: '{controller}' ({type_.value}) asks for '{asked}'",
        type_.place,
        subject=Subject("joint", joint),
        kind="conflict" if has else "absent",
        related=(
            Related("the transmission of the joint" if has else "robot_description of this launch", place),
            Related(f"'{controller}' is loaded here", spawner.location),
        ),
    )


def _interfaces(description: Description) -> dict[str, str]:
    """The interface that each joint gets."""
    found: dict[str, str] = {}
    for each in description.transmissions:
        if len(each.joints) == 1 and any(each.joints[0].commands):
            found.setdefault(each.joints[0].name, each.joints[0].commands[0].rpartition("/")[2])
    return found


RULE = Rule(
    id="CTL006",
    name="other-hardware-interface",
    effect="breaks",
    kind="conflict",
    always=(Reason.LIBRARY,),
    what="Checks for a controller of ROS 1 whose joint has another hardware interface in Gazebo than the controller "
    "asks for, or none. The plugin `gazebo_ros_control` takes it from the `<transmission>` of the joint.",
    why="The controller manager does not load the controller: `Could not find resource 'x' in "
    "'hardware_interface::EffortJointInterface'`.",
    example='<joint name="elbow">\n'
    "  <hardwareInterface>hardware_interface/PositionJointInterface</hardwareInterface>\n"
    "</joint>\n"
    "# elbow_controller: {type: effort_controllers/JointPositionController, joint: elbow}",
    instead='<joint name="elbow">\n'
    "  <hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface>\n"
    "</joint>",
    references=(ROS_CONTROL_GAZEBO,),
    generations=(1,),
    check=_check,
    of_robot=True,
    every_root=True,
)
