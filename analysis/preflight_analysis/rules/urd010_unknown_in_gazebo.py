"""URD010: what a robot description adds for Gazebo names a link or joint that the robot does not have.

Gazebo takes `<gazebo reference="...">` for the link or joint of that name (`InsertSDFExtensionLink`,
https://github.com/gazebosim/sdformat/blob/main/src/parser_urdf.cc), and plugins look for their joints in the model.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.model import Environment
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.descriptions import LOOSE, doubts_of, is_part, parts_for
from preflight_analysis.model.nearest import did_you_mean, is_slip, nearest, nearest_slip
from preflight_analysis.model.problems import rename, rename_in
from preflight_analysis.model.robots import robots, written
from preflight_analysis.robot.xacro import OF_JOINTS, Part, xacro_file
from preflight_analysis.rules.further_reading import URDF_GAZEBO
from preflight_analysis.rules.rule import Rule

_MANY = 3
"""So many further ones that are like none are not there for one reason."""
_BOTH = ("link", "joint")
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


def _of_description(rule: Rule, disk: Disk, environment: Environment, path: str) -> Iterator[Finding]:
    """What a file names, of the links and joints of all robots that it is of, as they are written."""
    file = xacro_file(disk.db, path)
    if file is None or file.document.problems or not file.named:
        return
    parts, whole = parts_for(disk.db, environment, path)
    whole = whole and not is_part(disk.db, environment, path)
    for named in file.named:
        is_frame = not named.of_joint and named.tag != "gazebo"
        kinds = ("joint",) if named.of_joint else ("link",) if is_frame else _BOTH
        there = [part for part in parts if part.tag in kinds]
        if not there or not any(map(str.strip, named.literals)):
            continue
        alike = [part for part in there if named.may_be(part)]
        near = _meant(named, there)
        prefixed = near is not None and near.name.endswith(f"/{named.name}")
        if any(not prefixed or any(map(str.strip, part.literals)) for part in alike):
            continue
        if near is None and (not whole or is_frame):
            continue  # a frame may be one of others
        how = f"<{named.tag}> of a plugin names it"
        if named.tag == "gazebo":
            how = "<gazebo> refers to it"
        elif named.tag in OF_JOINTS:
            how = f"<{named.tag}> is about a joint"
        here = near in file.parts and near.around.macro == named.around.macro if near is not None else False
        own_link = named.of_joint and any(part.tag == "link" and part.name == named.name for part in parts)
        yield rule.claim(
            f"{' or '.join(kinds)} '{named.name}' does not exist: {how}"
            f"{did_you_mean(near.name if near is not None else None)}",
            file.document.location(named.span),
            subject=Subject("link", named.name),
            kind="absent" if near is None else "near",
            effect=("misbehaves" if is_frame or named.of_joint else "no-effect") if here or own_link else "note",
            doubts=(*LOOSE, *doubts_of(named.around, other=not whole), *doubts(COMPUTED=bool(alike))),
            candidates=(near.name if near is not None else None,),
            fixes=rename_in(file.document, named.span, named.name, near.name) if near is not None else (),
        )


def _meant(named: Part, there: Iterable[Part]) -> Part | None:
    """The part whose name is a slip of this one, or has some more: a prefix, or one more word."""
    by_name = {part.name: part for part in sorted(there, key=lambda part: part.around.macro != named.around.macro)}
    near = nearest_slip(named.name, by_name)
    if near is None:
        more = [name for name in by_name if _has_more(name, named.name)]
        near = more[0] if len(more) == 1 else None
    return by_name[near] if near is not None else None


def _has_more(name: str, other: str) -> bool:
    return name.endswith(f"/{other}") or (
        "$" in other and name.count("_") == other.count("_") + 1 and set(other.split("_")) < set(name.split("_"))
    )


RULE = Rule(
    id="URD010",
    name="unknown-in-gazebo",
    effect="no-effect",
    kind="near",
    sometimes=("misbehaves", "note", Reason.NOT_GIVEN, Reason.UNSEEN),
    what="Checks for a link or joint that `<gazebo>` elements name and that the robot does not have. They name it in "
    "`reference`, or in elements of plugins whose name ends in `joint`.",
    why="Gazebo leaves the element out, so the sensor or the material is not there. A drive plugin does not find its "
    "joint, and the robot does not move.",
    example='<gazebo reference="lidar_lnk">\n  <sensor name="lidar" type="gpu_lidar"/>\n</gazebo>',
    instead='<gazebo reference="lidar_link">\n  <sensor name="lidar" type="gpu_lidar"/>\n</gazebo>',
    references=(URDF_GAZEBO,),
    check=_check,
    of_description=_of_description,
    in_branches=True,
)
