"""MVT002: the joints of a controller of MoveIt are not those of the robot, or of the controller itself.

`JointTrajectoryController::validate_trajectory_msg` of ros2_controllers refuses a trajectory whose joints are not those
of the controller, and so does ros_controllers, unless `allow_partial_joints_goal` is set and some are left out.
"""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.model.context import Context
from preflight_analysis.model.moveit import Known, Loaded, known_to_moveit
from preflight_analysis.model.nearest import did_you_mean, nearest
from preflight_analysis.model.problems import quoted, rename
from preflight_analysis.model.yaml_places import place_in_yaml
from preflight_analysis.robot.of_launch import given_robot, semantics_of
from preflight_analysis.rules.further_reading import MOVEIT_CONTROLLERS
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for each in known_to_moveit(context):
        unknown = _unknown(context, each)
        yield from _not_in_robot(rule, context, each, unknown)
        if each.loaded is not None and each.loaded.follows_trajectories:
            yield from _not_in_controller(rule, context, each, each.loaded, unknown)


def _unknown(context: Context, known: Known) -> tuple[str, ...]:
    """The joints that the robot does not have. None where it has none of them: it is another variant of the robot."""
    robot = given_robot(context.tree, known.node)
    if robot is None or not robot.description.joints:
        return ()
    semantics = [each.semantic for each in semantics_of(context.tree)]
    joints = {
        *(joint.name for joint in robot.description.joints),
        *(name for semantic in semantics for name in semantic.virtual_joints),
    }
    found = tuple(joint for joint in known.controller.joints if joint not in joints)
    return found if len(found) < len(known.controller.joints) or _slips(found, joints) else ()


def _slips(found: tuple[str, ...], joints: set[str]) -> bool:
    return any(nearest(joint, joints) is not None for joint in found)


def _not_in_robot(rule: Rule, context: Context, known: Known, unknown: tuple[str, ...]) -> Iterator[Finding]:
    robot = given_robot(context.tree, known.node) if unknown else None
    others = {joint.name for joint in robot.description.joints} - set(known.controller.joints) if robot else set()
    for joint in unknown:
        near, place = nearest(joint, others), place_in_yaml(context, known.controller.joints_param, joint)
        yield rule.claim(
            f"joint '{joint}' does not exist: MoveIt controller '{known.controller.name}' has it{did_you_mean(near)}",
            place,
            subject=Subject("joint", joint),
            kind="absent" if near is None else "near",
            candidates=(near,),
            related=(Related(f"{known.node.name} starts here", known.node.location),),
            fixes=rename(context, place, joint, near) if near is not None else (),
        )


def _sent(context: Context, known: Known) -> tuple[str, ...]:
    """The joints that MoveIt sends to a controller: none that is fixed, passive or follows another one
    (`TrajectoryExecutionManager::distributeTrajectory`). None where the robot is not known."""
    robot = given_robot(context.tree, known.node)
    if robot is None:
        return ()
    moved = {each.name for each in robot.description.joints if each.type != "fixed" and each.mimic is None}
    semantics = (each.semantic for each in semantics_of(context.tree))
    passive = {each.value for semantic in semantics for each in semantic.joints if each.owner == "passive_joint"}
    return tuple(joint for joint in known.controller.joints if joint in moved and joint not in passive)


def _not_in_controller(
    rule: Rule, context: Context, known: Known, loaded: Loaded, unknown: tuple[str, ...]
) -> Iterator[Finding]:
    mine, its = known.controller.joints, loaded.joints
    if not its or unknown:
        return
    sent = _sent(context, known)
    more = [joint for joint in sent if joint not in its]
    fewer = [joint for joint in its if joint not in mine] if not loaded.partial else []
    if not more and not fewer:
        return
    has = f"has joint {quoted(more)}, which" if more else f"lacks joint {quoted(fewer)}, which"
    does = "does not have" if more else "has"
    yield rule.claim(
        f"MoveIt controller '{known.controller.name}' {has} the controller {does}: it refuses the trajectories",
        place_in_yaml(context, known.controller.joints_param, more[0] if more else ""),
        subject=Subject("controller", known.controller.name),
        related=(
            *((Related("joints of the controller", loaded.joints_param.place),) if loaded.joints_param else ()),
            Related(f"'{known.controller.name}' is loaded here", loaded.spawner.location),
        ),
    )


RULE = Rule(
    id="MVT002",
    name="moveit-controller-joints",
    effect="breaks",
    kind="conflict",
    always=(Reason.LIBRARY,),
    what="Checks for a joint of a controller of MoveIt that the robot description does not have. It also checks "
    "whether the joint trajectory controller of that name has the same joints.",
    why="The controller refuses trajectories for other joints than its own. MoveIt finds no controller for the joints "
    "that no controller lists, and does not execute the trajectory.",
    example="moveit_simple_controller_manager:\n  arm_controller:\n    joints: [sholder, elbow]",
    instead="moveit_simple_controller_manager:\n  arm_controller:\n    joints: [shoulder, elbow]",
    references=(MOVEIT_CONTROLLERS,),
    settings=("knowledge",),
    check=_check,
    of_robot=True,
    every_root=True,
)
