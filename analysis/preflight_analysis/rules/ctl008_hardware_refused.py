"""CTL008: a `<ros2_control>` element that ros2_control refuses or does not read (ROS 2).

`parse_control_resources_from_urdf` of
https://github.com/ros-controls/ros2_control/blob/jazzy/hardware_interface/src/component_parser.cpp; the joints are
compared with those of the robot since Jazzy.
"""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.evaluation.ros2.spawners import MANAGER
from preflight_analysis.findings.finding import Finding, Severity
from preflight_analysis.robot.model import ControlJoint, ControlSystem, Description
from preflight_analysis.robot.of_launch import Robot
from preflight_analysis.rules.further_reading import ROS2_CONTROL_URDF
from preflight_analysis.rules.robots import LENIENT_ROS2_CONTROL, robots, written
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    # A launch that shows or simulates the robot may leave out the plugin of its hardware: Gazebo goes on without.
    is_run = any((node.package, node.executable) == MANAGER for node in context.tree.nodes)
    for robot in robots(context):
        for system in robot.description.misplaced:
            message = f"{_tag(system)} is inside <{system.around}>: ros2_control reads only elements below <robot>"
            yield _at_system(rule, context, robot, system, message)
        for system in robot.description.systems:
            if not system.plugin:
                message = f"{_tag(system)} has no <hardware> with a <plugin>"
                yield _at_system(rule, context, robot, system, message, None if is_run else "info")
            for message in _of_system(system):
                yield _at_system(rule, context, robot, system, message)
            yield from _of_joints(rule, context, robot, system)


def _tag(system: ControlSystem) -> str:
    return f'<ros2_control name="{system.name}">'


def _at_system(
    rule: Rule, context: Context, robot: Robot, system: ControlSystem, message: str, severity: Severity | None = None
) -> Finding:
    place, related = written(context, robot, "ros2_control", "name", system.name)
    return rule.finding(message, place, severity=severity, related=related)


def _of_system(system: ControlSystem) -> Iterator[str]:
    """What each version refuses."""
    for tag in system.unknown:
        yield f"{_tag(system)} has the element <{tag}>, which ros2_control refuses"
    joints = {joint.name for joint in system.joints}
    for transmission in system.transmissions:
        for joint in transmission.joints:
            if joint.name not in joints:
                yield f"{_tag(system)} has no joint '{joint.name}', which its <transmission> names"


def _of_joints(rule: Rule, context: Context, robot: Robot, system: ControlSystem) -> Iterator[Finding]:
    distro = context.environment.distro
    if distro in LENIENT_ROS2_CONTROL:
        return
    severity: Severity | None = "info" if distro is None else None
    since = "ros2_control of Jazzy and newer refuses" if distro is None else "ros2_control refuses"
    for joint in system.joints:
        wrong = _wrong(robot.description, system, joint)
        if wrong is not None:
            place, related = written(context, robot, "joint", "name", joint.name, "ros2_control")
            if not related:
                place, related = written(context, robot, "ros2_control", "name", system.name)
            yield rule.finding(f"{wrong}, which {since}", place, severity=severity, related=related)


def _wrong(description: Description, system: ControlSystem, joint: ControlJoint) -> str | None:
    own = next((each for each in description.joints if each.name == joint.name), None)
    if own is None:
        return None  # a finding of URD007
    if own.mimic is None:
        if joint.mimic == "true":
            return f"joint '{joint.name}' of {_tag(system)} has mimic=\"true\", but no <mimic> in the robot"
    elif joint.mimic != "false":
        if joint.commands:
            return f"joint '{joint.name}' mimics '{own.mimic}' and has a command interface in {_tag(system)}"
        if all(each.name != own.mimic for each in system.joints):
            return f"joint '{joint.name}' mimics '{own.mimic}' of another element than {_tag(system)}"
    return f"joint '{joint.name}' of {_tag(system)} is fixed" if own.type == "fixed" else None


RULE = Rule(
    id="CTL008",
    name="hardware-refused",
    severity="error",
    what="Checks for a `<ros2_control>` element of the robot description that ros2_control refuses: without a "
    "`<plugin>` in `<hardware>`, with an unknown element, or with a `<transmission>` for a joint that it does not "
    "have. Without the plugin it is information where the launch runs no `ros2_control_node`. One that is not directly "
    "below `<robot>` is not read at all. ros2_control of Jazzy and newer also refuses a fixed joint, and a joint with "
    "`<mimic>` that has a command interface or follows a joint of another element. The "
    'attribute `mimic="false"` allows the interface. If the distribution is unknown, this is information. It is not '
    "reported for older distributions.",
    why="The controller manager ends with an exception, or has no hardware. No controller runs.",
    example='<gazebo>\n  <ros2_control name="arm" type="system">...</ros2_control>\n</gazebo>',
    instead='<ros2_control name="arm" type="system">...</ros2_control>',
    references=(ROS2_CONTROL_URDF,),
    generations=(2,),
    check=_check,
    in_branches=True,
)
