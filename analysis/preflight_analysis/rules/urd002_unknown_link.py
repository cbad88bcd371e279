"""URD002: a joint between links of which one does not exist."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import did_you_mean, nearest
from preflight_analysis.model.problems import rename
from preflight_analysis.model.robots import robots, written
from preflight_analysis.rules.further_reading import URDF_JOINT
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for robot in robots(context):
        links = frozenset(robot.description.links)
        for joint in robot.description.joints:
            for end, link in (("parent", joint.parent), ("child", joint.child)):
                if link in links:
                    continue
                if not link:
                    place, related = written(context, robot, "joint", "name", joint.name)
                    message, about = f"joint '{joint.name}' has no {end} link", Subject("joint", joint.name)
                    yield rule.claim(message, place, subject=about, kind="absent", related=related)
                    continue
                near = nearest(link, links)
                place, related = written(context, robot, end, "link", link)
                if not related:
                    place, related = written(context, robot, "joint", "name", joint.name)
                yield rule.claim(
                    f"link '{link}' does not exist: it is the {end} of joint '{joint.name}'{did_you_mean(near)}",
                    place,
                    subject=Subject("link", link),
                    kind="absent" if near is None else "near",
                    candidates=(near,),
                    related=related,
                    fixes=rename(context, place, link, near) if near is not None else (),
                )


RULE = Rule(
    id="URD002",
    name="unknown-link",
    effect="stops-node",
    kind="near",
    what="Checks for a joint of the robot description whose parent or child is not a link of it.",
    why="`robot_state_publisher` refuses the description and ends, so the robot has no frames.",
    example='<joint name="lidar_joint" type="fixed">\n  <parent link="base_lnk"/>\n  <child link="lidar_link"/>\n'
    "</joint>",
    instead='<joint name="lidar_joint" type="fixed">\n  <parent link="base_link"/>\n  <child link="lidar_link"/>\n'
    "</joint>",
    references=(URDF_JOINT,),
    check=_check,
    of_robot=True,
    in_branches=True,
)
