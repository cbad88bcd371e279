"""URD009: the semantic description of a robot names what the robot description does not have.

srdfdom says so for each: an error for what it then leaves out, a warning for pairs of links
(`srdf::Model::initXml`, src/model.cpp of ros-planning/srdfdom 28970e17).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Literal

from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import did_you_mean, nearest
from preflight_analysis.model.problems import rename
from preflight_analysis.model.robots import written
from preflight_analysis.robot.of_launch import SemanticRobot, given_robot, semantics_of
from preflight_analysis.robot.semantic import Named
from preflight_analysis.rules.further_reading import MOVEIT_SRDF
from preflight_analysis.rules.rule import Rule

_HARMLESS = frozenset(
    {"disable_collisions", "enable_collisions", "disable_default_collisions", "link_sphere_approximation"}
)
"""What srdfdom leaves out without a loss: the link is not there anyway."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for semantic in semantics_of(context.tree):
        robots = {id(robot): robot for node in semantic.nodes if (robot := given_robot(context.tree, node)) is not None}
        if len(robots) != 1:
            continue
        (robot,) = robots.values()
        description = robot.description
        links = description.links
        joints = [*(joint.name for joint in description.joints), *semantic.semantic.virtual_joints]
        groups = semantic.semantic.groups
        yield from _unknown(rule, context, semantic, "link", semantic.semantic.links, links)
        yield from _unknown(rule, context, semantic, "joint", semantic.semantic.joints, joints)
        yield from _unknown(rule, context, semantic, "group", semantic.semantic.group_names, groups)


def _unknown(
    rule: Rule,
    context: Context,
    semantic: SemanticRobot,
    kind: Literal["link", "joint", "group"],
    named: Sequence[Named],
    there: Sequence[str],
) -> Iterator[Finding]:
    known, reported = frozenset(there), set[tuple[str, bool]]()
    for each in named:
        harmless = each.owner in _HARMLESS
        if each.value in known or (each.value, harmless) in reported or (each.value, False) in reported:
            continue
        reported.add((each.value, harmless))
        near = nearest(each.value, known)
        place, related = written(context, semantic, each.tag, each.attribute, each.value, each.within)
        yield rule.claim(
            f"{kind} '{each.value}' does not exist: <{each.owner}{_name(each)}> of the SRDF uses it"
            f"{did_you_mean(near)}",
            place,
            subject=Subject("name" if kind == "group" else kind, each.value),
            kind="absent" if near is None else "near",
            effect="note" if harmless else None,
            candidates=(near,),
            related=related,
            fixes=rename(context, place, each.value, near) if near is not None else (),
        )


def _name(named: Named) -> str:
    return f' name="{named.whose}"' if named.whose else ""


RULE = Rule(
    id="URD009",
    name="unknown-in-srdf",
    effect="no-effect",
    kind="near",
    sometimes=("note",),
    what="Checks for links, joints and groups that the SRDF of a launch uses and that do not exist. Links and joints "
    "are those of the robot description that the same node gets.",
    why="MoveIt reports an error and leaves the element out: the group lacks the joint, or the end effector is not "
    "there.",
    example='<group name="arm">\n  <chain base_link="base" tip_link="tol0"/>\n</group>',
    instead='<group name="arm">\n  <chain base_link="base" tip_link="tool0"/>\n</group>',
    references=(MOVEIT_SRDF,),
    check=_check,
    of_robot=True,
)
