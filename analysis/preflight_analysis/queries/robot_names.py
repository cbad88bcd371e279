"""The links, joints and groups that the files of a robot description name: which one stands at an offset, where it is
declared, and where else it is named."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Literal

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Element
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.evaluation.ros1.spawners import loaded_by
from preflight_analysis.evaluation.tree import Param
from preflight_analysis.frames.model import Edge
from preflight_analysis.model import controllers
from preflight_analysis.model.frames import frames_of
from preflight_analysis.model.moveit import known_to_moveit
from preflight_analysis.queries.frames import FrameSymbol, named_at
from preflight_analysis.robot.of_launch import Described, Robot, SemanticRobot, robots_of, semantics_of
from preflight_analysis.robot.semantic import NAMING_GROUPS, NAMING_JOINTS, NAMING_LINKS
from preflight_analysis.robot.sources import AROUND, Attribute, SourceFile, Written, files_of, named_file, place_of
from preflight_analysis.workspace.workspace import Analysis

Kind = Literal["link", "joint", "group"]

_NAMING: dict[Kind, frozenset[tuple[str, str]]] = {
    "link": frozenset({("link", "name"), ("parent", "link"), ("child", "link"), *NAMING_LINKS}),
    "joint": frozenset({("joint", "name"), ("mimic", "joint"), *NAMING_JOINTS}),
    "group": frozenset({("group", "name"), *NAMING_GROUPS}),
}
"""The attributes that name each, with their tags."""
_REFERENCE = ("gazebo", "reference")
"""What names a link or a joint."""
_FILES = ("mesh", "include")
_LEAST = 2
"""Characters of a computed name that have to be literal: of any other it may be each name of the robot."""


@dataclass(frozen=True, slots=True)
class Source:
    """A file of a description in one root. `robot` is the one that it speaks of, None where that is not known."""

    analysis: Analysis
    described: Described
    robot: Robot | None
    file: SourceFile

    @property
    def files(self) -> tuple[SourceFile, ...]:
        """All files of the description."""
        context = self.analysis.context
        return files_of(self.described, context.disk, context.environment)


@dataclass(frozen=True, slots=True)
class RobotName:
    """A name at `span` of a file. `names` are what it may be of the robot: several in a macro that is
    called several times, none where that is not known, as of `${name}`."""

    kind: Kind
    names: tuple[str, ...]
    written: Written
    source: Source

    @property
    def span(self) -> Span:
        """Where it stands."""
        return self.written.span


@dataclass(frozen=True, slots=True)
class User:
    """A controller that has a joint in its parameters. `how` says what it does with it: `commands`, `reads`, `uses`."""

    name: str
    type: str
    how: str
    param: Param


def sources_of(analyses: Sequence[Analysis], file: str) -> Iterator[Source]:
    """The file in each description that it is of, in each root; none of one that is of no description."""
    for analysis in analyses:
        context, robots = analysis.context, robots_of(analysis.tree)
        given: list[tuple[Described, Robot | None]] = [(robot, robot) for robot in robots]
        given += ((each, _robot_of(each, robots)) for each in semantics_of(analysis.tree))
        for described, robot in given:
            for found in files_of(described, context.disk, context.environment):
                if found.document.path == file:
                    yield Source(analysis, described, robot, found)


def _robot_of(semantic: SemanticRobot, robots: Sequence[Robot]) -> Robot | None:
    near = [robot for robot in robots if any(node is each for node in robot.nodes for each in semantic.nodes)] or robots
    return near[0] if len(near) == 1 else None


def name_at(analyses: Sequence[Analysis], file: str, offset: int) -> RobotName | None:
    """The link, joint or group that is named at `offset`, in the first root in which it is known."""
    first: RobotName | None = None
    for source in sources_of(analyses, file):
        written = next((each for each in source.file.written if each.span.contains(offset)), None)
        kind = _kind(written, source.robot) if written is not None else None
        if written is None or kind is None:
            continue
        found = RobotName(kind, _names(kind, written, source), written, source)
        if found.names:
            return found
        first = first or found
    return first


def _kind(written: Written, robot: Robot | None) -> Kind | None:
    at = (written.tag, written.attribute)
    if written.within == "gazebo":
        return None  # Gazebo's own
    if at == _REFERENCE:
        joints = robot.description.joints if robot is not None else ()
        is_joint = any(written.may_be(joint.name) for joint in joints)
        return "joint" if is_joint and (written.is_literal or written.literal >= _LEAST) else "link"
    return next((kind for kind, naming in _NAMING.items() if at in naming), None)


def _names(kind: Kind, written: Written, source: Source) -> tuple[str, ...]:
    if written.is_literal:
        return (written.value.strip(),)
    description = source.robot.description if source.robot is not None else None
    if description is None or kind == "group" or written.literal < _LEAST:
        return ()
    known = description.links if kind == "link" else (joint.name for joint in description.joints)
    found = dict.fromkeys(name for name in known if written.may_be(name))
    if _declares(kind, written):  # what another element has literally is not this one's
        literal = {each.value for file in source.files for each in file.written if _declares(kind, each)}
        found = {name: None for name in found if name not in literal}
    return tuple(found)


def declared_at(name: RobotName) -> tuple[Location, ...]:
    """The element that has the name: within a macro the one of the same text."""
    document = name.source.file.document
    here = [each for each in name.source.file.written if _declares(name.kind, each)]
    same = [document.location(each.span) for each in here if each.value == name.written.value]
    if same:
        return tuple(same)
    described = name.source.robot if name.kind != "group" else name.source.described
    context = name.source.analysis.context
    if described is None:
        return ()
    sought = (Attribute(name.kind, "name", each) for each in name.names)
    found = (place_of(described, context.disk, context.environment, each) for each in sought)
    return tuple(dict.fromkeys(place for place in found if place is not None))


def _declares(kind: Kind, written: Written) -> bool:
    return (written.within, written.tag, written.attribute) == ("", kind, "name")


def names_of(name: RobotName) -> Iterator[tuple[Location, bool]]:
    """All places that name it, and whether it is declared there: in the files of the description and of the semantic
    one, in the parameters of controllers and of MoveIt, and where a link is a frame."""
    analysis = name.source.analysis
    described: list[Described] = [*robots_of(analysis.tree), *semantics_of(analysis.tree)]
    files = {
        file.document.path: file
        for each in described
        for file in files_of(each, analysis.context.disk, analysis.context.environment)
    }
    for path, file in files.items():
        for each in file.written:
            is_same = path == name.source.file.document.path and each.value == name.written.value
            if (is_same or each.value in name.names) and _kind(each, name.source.robot) == name.kind:
                yield file.document.location(each.span), _declares(name.kind, each)
    if name.kind == "joint":
        for joint in name.names:
            for user in users_of(analysis, joint):
                yield controllers.place_of(analysis.context, user.param, joint), False
    if name.kind == "link":
        for frame in frames_named(name):
            yield from ((place, False) for place in named_at(frame))


def users_of(analysis: Analysis, joint: str) -> Iterator[User]:
    """The controllers that have a joint in their parameters, those of MoveIt last."""
    context = analysis.context
    for each in controllers.controllers_of(context):
        for claim in each.claims:
            if claim.joint == joint:
                yield User(each.name, each.type, "commands" if claim.commands else "reads", claim.param)
    if not analysis.tree.ros.ament:
        for controller in dict.fromkeys(each for node in analysis.tree.nodes for each in loaded_by(node)):
            type_ = analysis.tree.params.get(f"{controller}/type")
            for named in controllers.joints_of_ros1(analysis.tree, controller):
                if named.joint == joint and type_ is not None:
                    yield User(controller, str(type_.value), "uses", named.param)
    for known in known_to_moveit(context):
        if joint in known.controller.joints:
            yield User(known.controller.name, known.controller.type, "uses", known.controller.joints_param)


def frames_named(name: RobotName) -> tuple[FrameSymbol, ...]:
    """The frames that a link is, one for each node that publishes its robot."""
    found: dict[tuple[str, str], FrameSymbol] = {}
    robot, analysis = name.source.robot, name.source.analysis
    for link in name.names if robot is not None else ():
        for edge in frames_of(analysis.context).edges:
            if edge.robot is robot and edge.how == "urdf" and (frame := _frame(edge, link)) is not None:
                found[frame, edge.space] = FrameSymbol(analysis, frame, edge.space, name.span)
    return tuple(found.values())


def _frame(edge: Edge, link: str) -> str | None:
    """The frame of a link that one of a joint's two is; None where neither is."""
    joints = edge.robot.description.joints if edge.robot is not None else ()
    joint = next((each for each in joints if edge.detail == f"joint {each.name}"), None)
    if joint is None or link not in (joint.parent, joint.child):
        return None
    return edge.child if joint.child == link else edge.parent


def macros_at(analyses: Sequence[Analysis], file: str, offset: int) -> tuple[Span, tuple[Location, ...]] | None:
    """The call of a xacro macro at `offset`, and where that is defined; None where none is called."""
    for source in sources_of(analyses, file):
        element = _tag_at(source.file, offset)
        if element is None or not element.tag.startswith("xacro:"):
            continue
        wanted = (element.tag.removeprefix("xacro:"), element.tag)
        found = [
            each.document.location(written.span)
            for each in source.files
            for written in each.written
            if (written.tag, written.attribute) == ("xacro:macro", "name") and written.value in wanted
        ]
        if found:
            return element.tag_span, tuple(found)
    return None


def _tag_at(file: SourceFile, offset: int) -> Element | None:
    """The element whose tag is written at `offset`, in its start tag."""
    element = file.document.root
    while element is not None and not element.tag_span.contains(offset):
        element = next((each for each in element.elements if each.span.contains(offset)), None)
    return element


def files_named(analyses: Sequence[Analysis], file: str) -> Iterator[tuple[Span, str]]:
    """The files that includes and meshes in a file name, as far as it is known which."""
    for source in sources_of(analyses, file):
        context = source.analysis.context
        constants = {name: value for each in source.files for name, value in each.constants.items()}
        for each in source.file.written:
            if each.attribute == "filename" and each.tag.rpartition(":")[2] in _FILES:
                path = named_file(context.disk, context.environment, file, each.value, constants)
                if path is not None and context.disk.exists(path):
                    yield each.span, path
        return


def groups_with(source: Source, kind: Kind, names: Iterable[str]) -> tuple[str, ...]:
    """The groups of MoveIt that name a link or a joint."""
    wanted = frozenset(names)
    found: dict[str, None] = {}
    for each in semantics_of(source.analysis.tree):
        named = each.semantic.links if kind == "link" else each.semantic.joints
        found.update({part.whose: None for part in named if part.owner == "group" and part.value in wanted})
    return tuple(found)


def names_for(analysis: Analysis, file: str, tag: str, attribute: str, around: Sequence[str]) -> tuple[str, ...]:
    """The names of the robot that an attribute in a file of its description may have, within these tags; none for one
    that gives a name."""
    within = next((each for each in around if each in AROUND), "")
    kinds = [kind for kind, naming in _NAMING.items() if (tag, attribute) in naming]
    if (tag, attribute) == _REFERENCE:
        kinds = ["link", "joint"]
    if within == "gazebo" or not kinds or (within, tag, attribute) == ("", kinds[0], "name"):
        return ()
    source = next(sources_of([analysis], file), None)
    found: dict[str, None] = {}
    for kind in kinds if source is not None else ():
        description = source.robot.description if source is not None and source.robot is not None else None
        if kind == "group":
            found.update({each: None for s in semantics_of(analysis.tree) for each in s.semantic.groups})
        elif description is not None:
            found.update(dict.fromkeys(description.links if kind == "link" else (j.name for j in description.joints)))
    return tuple(filter(None, found))
