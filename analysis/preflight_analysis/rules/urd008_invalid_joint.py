"""URD008: a joint that the parser of URDF refuses.

https://github.com/ros/urdfdom/blob/master/urdf_parser/src/joint.cpp (`parseJoint`)
"""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.edits.edit import Edit
from preflight_analysis.edits.xml import XmlWriter
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import did_you_mean, nearest
from preflight_analysis.model.problems import fix
from preflight_analysis.model.robots import robots, written
from preflight_analysis.rules.further_reading import URDF_JOINT
from preflight_analysis.rules.rule import Rule

_TYPES = ("revolute", "continuous", "prismatic", "fixed", "floating", "planar")
_LIMITED = ("revolute", "prismatic")


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for robot in robots(context):
        for joint in robot.description.joints:
            if joint.catalogued:
                continue  # what its type and limits depend on is not known
            near = None
            if joint.type not in _TYPES:
                near = nearest(joint.type, _TYPES)
                has = f"has the unknown type '{joint.type}'" if joint.type else "has no type"
                message = f"joint '{joint.name}' {has}{did_you_mean(near)}"
            elif joint.type in _LIMITED and not joint.limited:
                message = f"joint '{joint.name}' has no <limit>, which the type '{joint.type}' requires"
            else:
                continue
            place, related = written(context, robot, "joint", "name", joint.name)
            writer = context.writer(place.file) if near is not None else None
            edits: tuple[Edit, ...] = ()
            if near is not None and isinstance(writer, XmlWriter):
                edits = writer.replace_beside(place.span, "type", joint.type, near)
            fixes = fix(f"Replace '{joint.type}' with '{near}'", edits, preferred=True)
            about = Subject("joint", joint.name)
            yield rule.claim(message, place, subject=about, candidates=(near,), related=related, fixes=fixes)


RULE = Rule(
    id="URD008",
    name="invalid-joint",
    effect="stops-node",
    kind="invalid",
    what="Checks for a joint of the robot description without a type that URDF has, and for a revolute or prismatic "
    "joint without `<limit>`.",
    why="`robot_state_publisher` refuses the description and ends.",
    example='<joint name="wheel_joint" type="revolute">\n  <parent link="base_link"/>\n  <child link="wheel"/>\n'
    "</joint>",
    instead='<joint name="wheel_joint" type="continuous">\n  <parent link="base_link"/>\n  <child link="wheel"/>\n'
    "</joint>",
    references=(URDF_JOINT,),
    check=_check,
    of_robot=True,
    in_branches=True,
)
