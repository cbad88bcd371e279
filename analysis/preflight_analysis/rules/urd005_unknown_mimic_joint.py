"""URD005: a joint that follows one that does not exist."""

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
        joints = frozenset(joint.name for joint in robot.description.joints)
        for joint in robot.description.joints:
            if joint.mimic is None or joint.mimic in joints:
                continue
            near = nearest(joint.mimic, joints)
            place, related = written(context, robot, "mimic", "joint", joint.mimic)
            if not related:
                place, related = written(context, robot, "joint", "name", joint.name)
            yield rule.claim(
                f"joint '{joint.mimic}' does not exist: joint '{joint.name}' mimics it{did_you_mean(near)}",
                place,
                subject=Subject("joint", joint.mimic),
                kind="absent" if near is None else "near",
                candidates=(near,),
                related=related,
                fixes=rename(context, place, joint.mimic, near) if near is not None else (),
            )


RULE = Rule(
    id="URD005",
    name="unknown-mimic-joint",
    effect="misbehaves",
    kind="near",
    what="Checks for a joint with `<mimic>` of a joint that the robot description does not have.",
    why="`robot_state_publisher` never publishes the frame of the joint, and ros2_control refuses the description.",
    example='<mimic joint="finger_jont"/>',
    instead='<mimic joint="finger_joint"/>',
    references=(URDF_JOINT,),
    check=_check,
    of_robot=True,
    in_branches=True,
)
