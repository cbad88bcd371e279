"""CTL002: a controller claims an interface that the joint does not have.

https://control.ros.org/jazzy/doc/ros2_control/hardware_interface/doc/hardware_interface_types_userdoc.html
"""

from __future__ import annotations

from collections.abc import Iterator
from collections.abc import Set as AbstractSet

from preflight_analysis.evaluation.meanings import items_of
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.controllers import Controller, controllers_of, place_of, robot_of
from preflight_analysis.model.problems import quoted
from preflight_analysis.rules.further_reading import ROS2_CONTROL_URDF
from preflight_analysis.rules.rule import Rule

_AS_DESCRIBED = frozenset(
    ("mock_components", "fake_components", "gz_ros2_control", "ign_ros2_control", "gazebo_ros2_control")
)
"""Packages of hardware that has the interfaces of the description and no others."""
_FULL_NAMES = ("_interface", "_interfaces")
"""The ends of the names of parameters that may have interfaces with their joints."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for each in controllers_of(context):
        robot = robot_of(context, each) if each.spawner is not None else None
        systems = robot.systems if robot is not None else ()
        if not systems:
            continue
        commands = {joint.name: set(joint.commands) for system in systems for joint in system.joints}
        states = {joint.name: set(joint.states) for system in systems for joint in system.joints}
        own = {
            joint.name
            for system in systems
            if system.plugin.partition("/")[0] not in _AS_DESCRIBED
            for joint in system.joints
        }
        yield from _of_controller(rule, context, each, commands, states, own)
        yield from _by_full_name(rule, context, each, commands, states)


def _by_full_name(
    rule: Rule, context: Context, controller: Controller, commands: dict[str, set[str]], states: dict[str, set[str]]
) -> Iterator[Finding]:
    """Interfaces that a parameter has as `joint/interface`, whatever it is for."""
    for param in controller.params:
        if not param.name.rpartition(".")[2].endswith(_FULL_NAMES):
            continue
        for value in items_of(param.value):
            joint, _, interface = value.partition("/")
            known = commands.get(joint, set()) | states.get(joint, set())
            if joint in commands and interface and interface not in known:
                yield rule.claim(
                    f"joint '{joint}' has no interface '{interface}', which parameter '{param.name}' of "
                    f"'{controller.name}' ({controller.type}) names; it has {quoted(sorted(known))}",
                    place_of(context, param, value),
                    subject=Subject("interface", value),
                    doubts=doubts(LIBRARY=True),
                )


def _of_controller(
    rule: Rule,
    context: Context,
    controller: Controller,
    commands: dict[str, set[str]],
    states: dict[str, set[str]],
    own: AbstractSet[str],
) -> Iterator[Finding]:
    """`own` are the joints whose hardware may have interfaces that the description does not list."""
    for claim in controller.claims:
        known = (commands if claim.commands else states).get(claim.joint)
        # Where the description lists none, the hardware makes them, if anything does.
        is_bare = not known and claim.joint in own
        kind = "command" if claim.commands else "state"
        for interface in claim.interfaces if known is not None else ():
            if known is None or interface in known:
                continue
            has = f"it has {quoted(sorted(known))}" if known else f"it has no {kind} interface"
            yield rule.claim(
                f"joint '{claim.joint}' has no {kind} interface '{interface}', which '{controller.name}' "
                f"({controller.type}) claims; {has}",
                place_of(context, claim.param, claim.joint),
                subject=Subject("interface", f"{claim.joint}/{interface}"),
                doubts=(*controller.doubts, *doubts(INTENDED=is_bare)),
            )


RULE = Rule(
    id="CTL002",
    name="missing-interface",
    effect="breaks",
    kind="absent",
    sometimes=(Reason.LIBRARY, Reason.FROM_SOURCE, Reason.OTHER_VERSION, Reason.INTENDED),
    what="Checks for a command or state interface that a controller claims and that `<ros2_control>` in the robot "
    "description does not give to the joint. So it does for `joint/interface` in parameters whose names end in "
    "`_interface` or `_interfaces`.",
    why="The controller manager refuses to activate the controller. The robot does not move.",
    example='<joint name="left_wheel_joint">\n  <command_interface name="position"/>\n</joint>',
    instead='<joint name="left_wheel_joint">\n  <command_interface name="velocity"/>\n</joint>',
    references=(ROS2_CONTROL_URDF,),
    settings=("knowledge",),
    generations=(2,),
    check=_check,
    of_robot=True,
    every_root=True,
)
