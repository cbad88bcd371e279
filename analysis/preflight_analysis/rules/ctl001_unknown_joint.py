"""CTL001: a controller asks for a joint that the robot does not have.

https://control.ros.org/jazzy/doc/ros2_controllers/doc/controllers_index.html
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from collections.abc import Set as AbstractSet

from preflight_analysis.evaluation.ros1.spawners import loaded_by
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.model.context import Context
from preflight_analysis.model.controllers import (
    Controller,
    controllers_of,
    joints_of_ros1,
    place_of,
    robot_of,
    set_for_joints,
    simulated_of_ros1,
)
from preflight_analysis.model.nearest import did_you_mean, is_slip, nearest
from preflight_analysis.model.problems import rename
from preflight_analysis.model.robots import robots
from preflight_analysis.robot.model import Description
from preflight_analysis.robot.of_launch import unread_of
from preflight_analysis.rules.further_reading import ROS2_CONTROLLERS
from preflight_analysis.rules.rule import Rule

IN_NO_OTHER_FILE = "joint '{}' is in no other file; did you mean '{}', as in {} files nearby?"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    yield from (_of_ros2 if context.tree.ros.ament else _of_ros1)(rule, context)


def _of_ros1(rule: Rule, context: Context) -> Iterator[Finding]:
    """A hardware interface may have joints that the description lacks, so that one without a near name is less sure."""
    found = list(robots(context))
    if len(found) != 1 or unread_of(context.tree):
        return
    joints = frozenset(joint.name for joint in found[0].description.joints)
    is_simulated = simulated_of_ros1(context) is not None
    for node in context.tree.nodes:
        for controller in loaded_by(node):
            yield from _of_controller_of_ros1(rule, context, controller, joints, node, is_simulated=is_simulated)


def _of_controller_of_ros1(
    rule: Rule,
    context: Context,
    controller: str,
    joints: frozenset[str],
    spawner: LaunchNode,
    *,
    is_simulated: bool,
) -> Iterator[Finding]:
    type_ = context.tree.params.get(f"{controller}/type")
    if type_ is None or not isinstance(type_.value, str):
        return
    named = list(joints_of_ros1(context.tree, controller))
    beside = frozenset(each.joint for each in named)
    own = frozenset(each.joint for each in named if not each.is_extra)
    below = ((name, context.tree.params[name]) for name in context.tree.params if name.startswith(f"{controller}/"))
    params = ((name[len(controller) + 1 :].replace("/", "."), param) for name, param in below)
    yield from _for_no_joint(rule, context, controller, type_.value, own, params)
    for each in named:
        if each.joint in joints or "$" in each.joint:
            continue
        place, near = place_of(context, each.param, each.joint), nearest(each.joint, joints - beside)
        is_typo = near is not None and is_slip(each.joint, near)
        of_robot = is_typo or not joints.isdisjoint(beside) or (is_simulated and not each.is_extra)
        yield rule.claim(
            f"joint '{each.joint}' does not exist: '{controller}' ({type_.value}) uses it{did_you_mean(near)}",
            place,
            subject=Subject("joint", each.joint),
            kind="absent" if near is None else "near",
            effect="misbehaves" if each.is_extra else None,
            doubts=doubts(FROM_SOURCE=True, UNSEEN=not is_typo, INTENDED=not of_robot),
            candidates=(near,),
            related=[Related(f"'{controller}' is spawned here", spawner.location)],
            fixes=rename(context, place, each.joint, near) if near is not None else (),
        )


def _of_ros2(rule: Rule, context: Context) -> Iterator[Finding]:
    for each in controllers_of(context):
        own = frozenset(claim.joint for claim in each.claims)
        yield from _for_no_joint(rule, context, each.name, each.type, own, ((p.name, p) for p in each.params))
        robot = robot_of(context, each) if each.spawner is not None else None
        if robot is not None and robot.joints:
            yield from _of_controller(rule, context, each, robot)


def _for_no_joint(
    rule: Rule,
    context: Context,
    controller: str,
    type_: str,
    joints: AbstractSet[str],
    params: Iterable[tuple[str, Param]],
) -> Iterator[Finding]:
    """What is set for a joint that the controller does not have, which it never asks for."""
    for joint, group, param in set_for_joints(type_, params) if joints else ():
        if joint in joints or "$" in joint:
            continue
        near = nearest(joint, joints)
        yield rule.claim(
            f"'{group}' for joint '{joint}' has no effect: '{controller}' ({type_}) does not have this joint"
            f"{did_you_mean(near)}",
            param.place,
            subject=Subject("joint", joint),
            kind="absent" if near is None else "near",
            effect="no-effect",
            candidates=(near,),
        )


def _of_controller(rule: Rule, context: Context, controller: Controller, robot: Description) -> Iterator[Finding]:
    parts = {part.name for system in robot.systems for part in (*system.joints, *system.sensors, *system.gpios)}
    joints = {joint.name for joint in robot.joints}
    reported: set[str] = set()
    # A controller of which the robot has no joint at all is for another variant of it.
    is_of_robot = any(claim.joint in joints | parts for claim in controller.claims)
    for claim in controller.claims:
        if claim.joint in joints | parts | reported or "/" in claim.joint:
            continue
        reported.add(claim.joint)
        place, near = place_of(context, claim.param, claim.joint), nearest(claim.joint, joints)
        spawner = controller.spawner
        of_other = not is_of_robot and not (near is not None and is_slip(claim.joint, near))
        yield rule.claim(
            f"joint '{claim.joint}' does not exist: '{controller.name}' ({controller.type}) uses it"
            f"{did_you_mean(near)}",
            place,
            subject=Subject("joint", claim.joint),
            kind="absent" if near is None else "near",
            doubts=(*controller.doubts, *doubts(INTENDED=of_other)),
            candidates=(near,),
            related=[Related(f"'{controller.name}' is spawned here", spawner.location)] if spawner is not None else (),
            fixes=rename(context, place, claim.joint, near) if near is not None else (),
        )


RULE = Rule(
    id="CTL001",
    name="unknown-joint",
    effect="breaks",
    kind="near",
    sometimes=("misbehaves", "no-effect", Reason.FROM_SOURCE, Reason.OTHER_VERSION, Reason.UNSEEN, Reason.INTENDED),
    what="Checks for a joint in the parameters of a controller that the launch loads and that the robot description "
    "does not have, and for `constraints` and `gains` of a joint that is none of the controller's. Without a "
    "description, a name of no other file is checked that is a typo of one in several files.",
    why="The controller cannot be configured or activated, because no hardware has interfaces of that joint. The robot "
    "does not move.",
    example="base_controller:\n  ros__parameters:\n    left_wheel_names: [left_whel_joint]",
    instead="base_controller:\n  ros__parameters:\n    left_wheel_names: [left_wheel_joint]",
    references=(ROS2_CONTROLLERS,),
    settings=("knowledge",),
    generations=(1, 2),
    check=_check,
    of_robot=True,
    every_root=True,
)
