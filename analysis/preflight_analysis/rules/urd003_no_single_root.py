"""URD003: links that are not one tree."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import quoted
from preflight_analysis.model.robots import robots, written
from preflight_analysis.rules.further_reading import URDF
from preflight_analysis.rules.rule import Rule

_SHOWN = 3


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for robot in robots(context):
        description = robot.description
        roots, parents = description.roots, {joint.parent for joint in description.joints}
        if not description.links or len(roots) == 1 or not parents | {*roots} <= {*description.links}:
            continue  # joints with links that are not there have a finding of their own
        if not roots:
            about = description.links[0]
            message = f"link '{about}' is in a cycle of joints: the robot description has no root"
        else:
            # What is without any joint is most likely the one that somebody forgot.
            about = next((root for root in roots if root not in parents), roots[1])
            others = [root for root in roots if root != about]
            some = quoted(others[:_SHOWN]) + (", ..." if len(others) > _SHOWN else "")
            roots_ = "is also a root" if len(others) == 1 else "are also roots"
            message = f"link '{about}' is not the child of any joint; {some} {roots_}"
        place, related = written(context, robot, "link", "name", about)
        yield rule.claim(message, place, subject=Subject("link", about), related=related)


RULE = Rule(
    id="URD003",
    name="no-single-root",
    effect="stops-node",
    kind="invalid",
    what="Checks that exactly one link of the robot description is not the child of a joint.",
    why="`robot_state_publisher` refuses a description with two roots, or with a cycle, and ends.",
    example='<link name="base_link"/>\n<link name="lidar_link"/>',
    instead='<link name="base_link"/>\n<link name="lidar_link"/>\n<joint name="lidar_joint" type="fixed">\n'
    '  <parent link="base_link"/>\n  <child link="lidar_link"/>\n</joint>',
    references=(URDF,),
    check=_check,
    of_robot=True,
    in_branches=True,
)
