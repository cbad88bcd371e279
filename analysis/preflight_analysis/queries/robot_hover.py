"""What a reader wants to know of a link, a joint or a group of a robot, as Markdown."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from preflight_analysis.findings.markdown import code, escaped
from preflight_analysis.model.controllers import place_of
from preflight_analysis.queries.frames import frame_lines
from preflight_analysis.queries.hover_text import Hover
from preflight_analysis.queries.places import place
from preflight_analysis.queries.robot_names import RobotName, frames_named, groups_with, name_at, users_of
from preflight_analysis.robot.model import Description
from preflight_analysis.robot.of_launch import semantics_of
from preflight_analysis.workspace.workspace import Analysis

_SHOWN = 8
_HOW = {"commands": "Commanded by", "reads": "Read by", "uses": "Used by"}


def robot_hover(analyses: Sequence[Analysis], file: str, offset: int) -> Hover | None:
    """The hover of the name at `offset` of a file of a robot description; None where none is named."""
    name = name_at(analyses, file, offset)
    if name is None or not name.names:
        return None
    blocks = [_block(name, each) for each in name.names[:_SHOWN]] if len(name.names) == 1 else [_several(name)]
    return Hover("\n\n".join(blocks), name.span)


def _several(name: RobotName) -> str:
    more = f", … and {len(name.names) - _SHOWN} more" if len(name.names) > _SHOWN else ""
    return f"{name.kind} {code(name.written.value)}\n\nIt may be {', '.join(map(code, name.names[:_SHOWN]))}{more}."


def _block(name: RobotName, value: str) -> str:
    description = name.source.robot.description if name.source.robot is not None else None
    lines = {"link": _link, "joint": _joint, "group": _group}[name.kind](name, value, description)
    return "\n".join(lines).rstrip()


def _link(name: RobotName, link: str, description: Description | None) -> Iterator[str]:
    yield f"link {code(link)}"
    yield ""
    if description is not None and link not in description.links:
        yield "The robot description of this launch has no link of this name."
        return
    frames = frames_named(name)
    for frame in frames:
        if len(frames) > 1 or frame.frame != link:
            yield f"Frame {code(frame.frame)}" + (f" on {code(f'{frame.space}/tf')}" if frame.space else "")
            yield ""
        yield from frame_lines(frame)
        yield ""
    if not frames and description is not None:
        yield "No joint of the robot description joins it to another link."
        yield ""
    yield from _groups(name)


def _joint(name: RobotName, value: str, description: Description | None) -> Iterator[str]:
    joints = [each for each in description.joints if each.name == value] if description is not None else []
    type_ = f", {escaped(joints[0].type)}" if joints and joints[0].type else ""
    yield f"joint {code(value)}{type_}"
    yield ""
    if description is not None and not joints:
        yield "The robot description of this launch has no joint of this name."
        yield ""
    for joint in joints[:1]:
        follows = f", follows {code(joint.mimic)}" if joint.mimic else ""
        yield f"{code(joint.parent)} → {code(joint.child)}{follows}"
        yield ""
    for system in description.systems if description is not None else ():
        for each in system.joints:
            if each.name == value:
                yield f"Interfaces in `<ros2_control>` {code(system.name)}: {_interfaces(each.commands, each.states)}"
                yield ""
    analysis = name.source.analysis
    users = list(users_of(analysis, value))
    for how, title in _HOW.items():
        mine = [user for user in users if user.how == how]
        if mine:
            yield title
        for user in mine[:_SHOWN]:
            where = place(analysis, place_of(analysis.context, user.param, value))
            yield f"- {code(user.name)} ({code(user.type)}) — {where}"
        if mine:
            yield ""
    yield from _groups(name)


def _interfaces(commands: Sequence[str], states: Sequence[str]) -> str:
    said = [
        f"{kind} {', '.join(map(code, names))}" for kind, names in (("commands", commands), ("states", states)) if names
    ]
    return "; ".join(said) if said else "none"


def _groups(name: RobotName) -> Iterator[str]:
    groups = groups_with(name.source, name.kind, name.names)
    if groups:
        yield f"In the groups of MoveIt {', '.join(map(code, groups[:_SHOWN]))}"
        yield ""


def _group(name: RobotName, value: str, _: Description | None) -> Iterator[str]:
    yield f"group {code(value)} of MoveIt"
    yield ""
    for each in semantics_of(name.source.analysis.tree):
        semantic = each.semantic
        for title, named in (("Links", semantic.links), ("Joints", semantic.joints), ("Groups", semantic.group_names)):
            found = [part.value for part in named if (part.owner, part.whose) == ("group", value) and part.within]
            if found:
                more = f", … and {len(found) - _SHOWN} more" if len(found) > _SHOWN else ""
                yield f"{title}: {', '.join(map(code, found[:_SHOWN]))}{more}"
                yield ""
