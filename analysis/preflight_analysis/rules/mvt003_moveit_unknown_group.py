"""MVT003: a group or a joint in the parameters of MoveIt that is a slip of one that the robot has.

MoveIt asks for the parameters of the groups and joints that it knows: others stay without effect
(kinematics_plugin_loader.cpp, planning_context_manager.cpp and robot_model_loader.cpp of moveit/moveit2 8fcb5d23).
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from typing import Literal

from preflight_analysis.evaluation.moveit import is_move_group, params_around
from preflight_analysis.evaluation.tree import Param
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import did_you_mean, is_slip, nearest
from preflight_analysis.model.problems import rename
from preflight_analysis.model.yaml_places import place_in_yaml
from preflight_analysis.robot.of_launch import SemanticRobot, given_robot, semantics_of
from preflight_analysis.rules.further_reading import MOVEIT_KINEMATICS
from preflight_analysis.rules.rule import Rule

_KINEMATICS = ("robot_description_kinematics", None, "kinematics_solver")
"""Parts of the name of a parameter, None for that of the group or joint."""
_PLANNERS = (None, "planner_configs")
"""The last ones, whatever is before."""
_LIMITS = ("robot_description_planning", "joint_limits", None, "")
"""The last part is any."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    semantics = semantics_of(context.tree)
    for node in filter(is_move_group, context.tree.nodes):
        params = params_around(context.tree, node)
        semantic = [each for each in semantics if any(one is node for one in each.nodes)]
        if len(semantic) == 1:
            groups = semantic[0].semantic.groups
            at = (semantic[0],)
            yield from _slips(rule, context, "group", _named(_KINEMATICS, params), groups, at)
            yield from _slips(rule, context, "group", _named(_PLANNERS, params), groups, at)
        robot = given_robot(context.tree, node)
        if robot is not None:
            joints = [joint.name for joint in robot.description.joints]
            yield from _slips(rule, context, "joint", _named(_LIMITS, params), joints, ())


def _named(wanted: tuple[str | None, ...], params: Mapping[str, Param]) -> dict[str, Param]:
    """The groups or joints that parameters are for, each with the first of them."""
    found: dict[str, Param] = {}
    for name, param in params.items():
        parts = name.replace("/", ".").split(".")
        if wanted is _PLANNERS:
            parts = parts[-len(wanted) :]
        of = parts[wanted.index(None)] if len(parts) == len(wanted) else ""
        if of and all(part == each for part, each in zip(parts, wanted, strict=True) if each):
            found.setdefault(of, param)
    return found


def _slips(
    rule: Rule,
    context: Context,
    kind: Literal["group", "joint"],
    named: Mapping[str, Param],
    there: Collection[str],
    semantics: Iterable[SemanticRobot],
) -> Iterator[Finding]:
    """A slip: what is meant has no parameters of its own."""
    lacking = [each for each in there if each not in named]
    for name, param in named.items():
        near = nearest(name, lacking) if name not in there else None
        if near is None or not is_slip(name, near):
            continue
        place = place_in_yaml(context, param)
        yield rule.claim(
            f"{kind} '{name}' does not exist: MoveIt does not read '{param.name}'{did_you_mean(near)}",
            place,
            subject=Subject("name" if kind == "group" else kind, name),
            candidates=(near,),
            related=[Related("the groups of the robot", each.param.place) for each in semantics],
            fixes=rename(context, place, name, near),
        )


RULE = Rule(
    id="MVT003",
    name="moveit-unknown-group",
    effect="no-effect",
    kind="near",
    always=(Reason.LIBRARY,),
    what="Checks for a misspelled planning group in `kinematics.yaml` and in the configuration of a planning "
    "pipeline. It also checks for a misspelled joint in `joint_limits.yaml`. Nothing is set for the one that was "
    "meant.",
    why="MoveIt reads the parameters of the groups and joints of the robot only. The group has no kinematics "
    "solver, or the joint no limits.",
    example='manipulater:  # the SRDF has <group name="manipulator">\n'
    "  kinematics_solver: kdl_kinematics_plugin/KDLKinematicsPlugin",
    instead="manipulator:\n  kinematics_solver: kdl_kinematics_plugin/KDLKinematicsPlugin",
    references=(MOVEIT_KINEMATICS,),
    check=_check,
    of_robot=True,
)
