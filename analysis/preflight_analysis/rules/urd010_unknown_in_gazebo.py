"""URD010: what a robot description adds for Gazebo names a link or joint that the robot does not have.

Gazebo takes `<gazebo reference="...">` for the link or joint of that name (`InsertSDFExtensionLink`,
https://github.com/gazebosim/sdformat/blob/main/src/parser_urdf.cc), and plugins look for their joints in the model.
"""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import did_you_mean, is_slip, nearest
from preflight_analysis.model.problems import rename
from preflight_analysis.model.robots import robots, written
from preflight_analysis.rules.further_reading import URDF_GAZEBO
from preflight_analysis.rules.rule import Rule

_MANY = 3
"""So many further ones that are like none are not there for one reason."""
_WITHOUT_JOINTS = "planar_move"
"""In the name of a plugin that moves the robot as a whole, whatever its joints (gazebo_ros_planar_move.cpp)."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for robot in robots(context):
        description = robot.description
        joints = frozenset(joint.name for joint in description.joints)
        known = joints.union(description.links)
        missing = [each for each in dict.fromkeys(description.references) if each.name not in known]
        alike = [each for each in missing if not each.adds and nearest(each.name, known) is None]
        for reference in missing:
            more = len(alike) - 1 if reference in alike else 0
            if more >= _MANY and reference is not alike[0]:
                continue  # said with the first one: they have one cause
            near = nearest(reference.name, known)
            place, related = written(context, robot, "gazebo", "reference", reference.name)
            yield rule.claim(
                f"links or joints '{reference.name}' and {more} more do not exist: <gazebo> refers to them"
                if more >= _MANY
                else f"link or joint '{reference.name}' does not exist: <gazebo> refers to it{did_you_mean(near)}",
                place,
                subject=Subject("link", reference.name),
                kind="absent" if near is None else "near",
                effect=None if reference.adds or (near and is_slip(reference.name, near)) else "note",
                candidates=(near,),
                related=related,
                fixes=rename(context, place, reference.name, near) if near is not None else (),
            )
        for plugin in description.plugins:
            for tag, joint in dict.fromkeys(plugin.joints):
                if joint in joints or not joints:
                    continue
                near = nearest(joint, joints)
                place, related = written(context, robot, "plugin", "filename", plugin.filename, "gazebo")
                yield rule.claim(
                    f"joint '{joint}' does not exist: <{tag}> of the plugin '{plugin.filename}' names it"
                    f"{did_you_mean(near)}",
                    place,
                    subject=Subject("joint", joint),
                    kind="absent" if near is None else "near",
                    effect="note" if _WITHOUT_JOINTS in plugin.filename else "misbehaves",
                    candidates=(near,),
                    related=related,
                )


RULE = Rule(
    id="URD010",
    name="unknown-in-gazebo",
    effect="no-effect",
    kind="near",
    sometimes=("misbehaves", "note"),
    what="Checks for a link or joint that `<gazebo>` elements name and that the robot does not have. They name it in "
    "`reference`, or in elements of plugins whose name ends in `joint`.",
    why="Gazebo leaves the element out, so the sensor or the material is not there. A drive plugin does not find its "
    "joint, and the robot does not move.",
    example='<gazebo reference="lidar_lnk">\n  <sensor name="lidar" type="gpu_lidar"/>\n</gazebo>',
    instead='<gazebo reference="lidar_link">\n  <sensor name="lidar" type="gpu_lidar"/>\n</gazebo>',
    references=(URDF_GAZEBO,),
    check=_check,
    in_branches=True,
)
