"""CTL008: a `<ros2_control>` element that ros2_control refuses or does not read (ROS 2).

`parse_control_resources_from_urdf` of
https://github.com/ros-controls/ros2_control/blob/jazzy/hardware_interface/src/component_parser.cpp; the joints are
compared with those of the robot since Jazzy.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from preflight_analysis.evaluation.ros2.spawners import MANAGER
from preflight_analysis.findings.claim import Effect, Subject
from preflight_analysis.findings.doubt import Doubt, Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.robots import LENIENT_ROS2_CONTROL, robots, written
from preflight_analysis.robot.model import ControlJoint, ControlSystem, Description
from preflight_analysis.robot.of_launch import Robot
from preflight_analysis.rules.further_reading import ROS2_CONTROL_URDF
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    # A launch that shows or simulates the robot may leave out the plugin of its hardware: Gazebo goes on without.
    is_run = any((node.package, node.executable) == MANAGER for node in context.tree.nodes)
    for robot in robots(context):
        for system, message, why, effect in _of_robot(robot.description, is_run=is_run):
            place, related = written(context, robot, "ros2_control", "name", system.name)
            about = Subject("component", system.name)
            yield rule.claim(message, place, subject=about, effect=effect, doubts=why, related=related)
        for system in robot.description.systems:
            yield from _of_joints(rule, context, robot, system)


class _Wrong(NamedTuple):
    """What is wrong with a system, and what speaks against it."""

    system: ControlSystem
    message: str
    why: tuple[Doubt, ...] = ()
    effect: Effect | None = None


def _of_robot(description: Description, *, is_run: bool) -> Iterator[_Wrong]:
    for system in description.misplaced:
        message = f"{_tag(system)} is inside <{system.around}>: ros2_control reads only elements below <robot>"
        yield _Wrong(system, message, effect="breaks")
    for system in description.systems:
        if not system.plugin:
            message = f"{_tag(system)} has no <hardware> with a <plugin>"
            yield _Wrong(system, message, doubts(INTENDED=not is_run))
        for message in _of_system(system):
            yield _Wrong(system, message)


def _tag(system: ControlSystem) -> str:
    return f'<ros2_control name="{system.name}">'


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
    since = "ros2_control of Jazzy and newer refuses" if distro is None else "ros2_control refuses"
    for joint in system.joints:
        wrong = _wrong(robot.description, system, joint)
        if wrong is not None:
            place, related = written(context, robot, "joint", "name", joint.name, "ros2_control")
            if not related:
                place, related = written(context, robot, "ros2_control", "name", system.name)
            about, why = Subject("joint", joint.name), doubts(OTHER_VERSION=distro is None)
            yield rule.claim(f"{wrong}, which {since}", place, subject=about, doubts=why, related=related)


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
    effect="stops-node",
    kind="invalid",
    sometimes=("breaks", Reason.INTENDED, Reason.OTHER_VERSION),
    what="Checks for a `<ros2_control>` element that ros2_control refuses, or that is not directly below `<robot>`. "
    "It lacks a `<plugin>`, or has an unknown element or joint. Fixed joints and those with `<mimic>` are refused "
    "since Jazzy.",
    why="The controller manager ends with an exception, or has no hardware. No controller runs.",
    example='<gazebo>\n  <ros2_control name="arm" type="system">...</ros2_control>\n</gazebo>',
    instead='<ros2_control name="arm" type="system">...</ros2_control>',
    references=(ROS2_CONTROL_URDF,),
    generations=(2,),
    check=_check,
    in_branches=True,
)
