"""URD007: a joint that ros2_control or a transmission names and the robot does not have.

Since Jazzy the component parser of ros2_control throws for it: `Joint 'x' not found in URDF`
(https://github.com/ros-controls/ros2_control/blob/jazzy/hardware_interface/src/component_parser.cpp, `parse_joint`).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from preflight_analysis.findings.claim import Effect, Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import did_you_mean, nearest
from preflight_analysis.model.problems import rename
from preflight_analysis.model.robots import LENIENT_ROS2_CONTROL, robots, written
from preflight_analysis.rules.further_reading import ROS2_CONTROL_URDF
from preflight_analysis.rules.rule import Rule

_MOVING = frozenset({"position", "velocity", "effort", "acceleration"})
"""The interfaces of a joint that moves. One with others alone is a name for something else of the hardware."""
_MANY = 3
"""So many further joints that are like none are not there for one reason, such as a prefix."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    refused = context.tree.ros.ament and context.environment.distro not in (None, *LENIENT_ROS2_CONTROL)
    for robot in robots(context):
        description = robot.description
        joints = frozenset(joint.name for joint in description.joints)
        named = [
            *(("ros2_control", each.name, joint.name) for each in description.systems for joint in each.joints),
            *(("transmission", each.name, joint.name) for each in description.transmissions for joint in each.joints),
        ]
        with_interfaces = {
            (each.name, joint.name)
            for each in description.systems
            for joint in each.joints
            if not _MOVING.isdisjoint((*joint.commands, *joint.states))
        }
        missing = [
            (*each, nearest(each[2], joints)) for each in dict.fromkeys(named) if each[2] and each[2] not in joints
        ]
        alike = Counter(tag for tag, _, _, near in missing if near is None)
        for tag, owner, joint, near in missing:
            more = alike[tag] - 1 if near is None else 0
            if more >= _MANY:
                alike[tag] = 0  # the others are said with this one
            elif near is None and not alike[tag]:
                continue
            place, related = written(context, robot, "joint", "name", joint, tag)
            if not related:
                place, related = written(context, robot, tag, "name", owner)
            # One without may be an actuator; a description without joints is for the controller manager alone.
            has_interfaces = bool(joints) and (owner, joint) in with_interfaces
            yield rule.claim(
                f"joint '{joint}' and {more} more do not exist: <{tag} name=\"{owner}\"> and others use them"
                if more >= _MANY
                else f"joint '{joint}' does not exist: <{tag} name=\"{owner}\"> uses it{did_you_mean(near)}",
                place,
                subject=Subject("joint", joint),
                kind="absent" if near is None else "near",
                effect=_effect(context, tag, refused),
                doubts=doubts(INTENDED=tag != "transmission" and not refused and not has_interfaces),
                candidates=(near,),
                related=related,
                fixes=rename(context, place, joint, near) if near is not None else (),
            )


def _effect(context: Context, tag: str, refused: bool) -> Effect | None:
    """In ROS 2 only ros2_control reads transmissions, and only those within its own element."""
    if tag == "transmission":
        return "note" if context.tree.ros.ament else None
    return "breaks" if refused else None


RULE = Rule(
    id="URD007",
    name="unknown-controlled-joint",
    effect="misbehaves",
    kind="near",
    sometimes=("breaks", "note", Reason.INTENDED),
    what="Checks for a joint in `<ros2_control>` or `<transmission>` that the robot description does not have.",
    why="The joint is not moved: the simulator skips it, and controllers that claim it report positions of no joint. "
    "ros2_control of Jazzy and newer does not load the hardware at all.",
    example='<ros2_control name="arm" type="system">\n  <joint name="sholder_joint"/>\n</ros2_control>',
    instead='<ros2_control name="arm" type="system">\n  <joint name="shoulder_joint"/>\n</ros2_control>',
    references=(ROS2_CONTROL_URDF,),
    check=_check,
    of_robot=True,
    in_branches=True,
)
