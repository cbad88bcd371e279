"""URD004: two links or two joints of one name."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Literal

from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.model.context import Context
from preflight_analysis.model.robots import robots_in_part, written
from preflight_analysis.robot.of_launch import Robot
from preflight_analysis.robot.sources import Attribute, places_of
from preflight_analysis.rules.further_reading import URDF
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for robot in robots_in_part(context):
        description = robot.description
        yield from _repeated(rule, context, robot, "link", description.links)
        yield from _repeated(rule, context, robot, "joint", [joint.name for joint in description.joints])


def _repeated(
    rule: Rule, context: Context, robot: Robot, tag: Literal["link", "joint"], names: Sequence[str]
) -> Iterator[Finding]:
    if len(frozenset(names)) == len(names):
        return
    for name, count in Counter(names).items():
        if count == 1 or not name:
            continue
        places = places_of(robot, context.disk, context.environment, Attribute(tag, "name", name))
        message = f"duplicate {tag} '{name}': the robot description has {count} of this name"
        place, related = written(context, robot, tag, "name", name)
        if len(places) > 1:
            place, related = places[1], (Related(f"the first {tag}", places[0]),)
        yield rule.claim(message, place, subject=Subject(tag, name), related=related)


RULE = Rule(
    id="URD004",
    name="duplicate-element",
    effect="stops-node",
    kind="duplicate",
    what="Checks for two links, or two joints, of the robot description with the same name. A macro of xacro that is "
    "called twice without another prefix makes them.",
    why="`robot_state_publisher` refuses the description and ends: `link 'wheel_link' is not unique`.",
    example='<xacro:wheel prefix="left"/>\n<xacro:wheel prefix="left"/>',
    instead='<xacro:wheel prefix="left"/>\n<xacro:wheel prefix="right"/>',
    references=(URDF,),
    check=_check,
    of_robot=True,
    in_branches=True,
)
