"""URD001: a robot description that is no XML, or no URDF."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.documents.conflict_marks import conflict_mark
from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.span import Location
from preflight_analysis.edits.xml import XmlWriter
from preflight_analysis.environment.model import Environment
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.model.context import Context
from preflight_analysis.model.descriptions import LOOSE
from preflight_analysis.model.problems import fix, include_chain, shown
from preflight_analysis.model.syntax import Tags
from preflight_analysis.robot.model import Malformed
from preflight_analysis.robot.of_launch import Described, Robot, robots_of, semantics_of
from preflight_analysis.robot.parse import parse_description
from preflight_analysis.robot.sources import files_of
from preflight_analysis.robot.xacro import xacro_file
from preflight_analysis.rules.further_reading import URDF, XACRO
from preflight_analysis.rules.rule import Rule

"""What git writes where it could not merge."""
_KINDS = ("robot", "sdf", "{http://www.collada.org/2008/03/COLLADASchema}COLLADA", "COLLADA")
"""Tags of roots that robot_state_publisher takes; SDF and COLLADA by plugins (sdformat_urdf, collada_parser)."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for robot in robots_of(context.tree):
        description, text = robot.description, robot.text.strip()
        if not text:
            continue
        if description.malformed is not None:
            yield _malformed(rule, context, robot, description.malformed)
        elif description.kind == "xacro":
            yield _raw(rule, context, robot)
        elif description.kind and description.kind not in _KINDS:
            yield rule.claim(
                f"root element of '{robot.param.name}' is <{description.kind}>, not <robot>",
                robot.param.place,
                subject=Subject("parameter", robot.param.name),
                related=include_chain(robot.param.origin),
            )
    for semantic in semantics_of(context.tree):
        if semantic.semantic.malformed is not None:
            yield _malformed(rule, context, semantic, semantic.semantic.malformed)


def _of_description(rule: Rule, disk: Disk, environment: Environment, path: str) -> Iterator[Finding]:
    """A file for itself. That of xacro is read by expat, any other by parsers that mind less."""
    file = xacro_file(disk.db, path)
    if file is None or not file.document.problems:
        return
    document = file.document
    malformed = parse_description(document.text).malformed
    if not file.is_xacro and (malformed is None or not document.text.lstrip().startswith("<")):
        return  # Stage has worlds that are no XML
    mark = conflict_mark(document.text)
    if mark is not None:
        place, said = document.location(mark), say("file has conflict markers of git, and is not XML")
    else:
        problem = document.problems[0]
        place = document.location(problem.span)
        said = say("file is not well-formed XML: {quoted}", quoted=problem.message)
    # TinyXML, of Humble's urdfdom and Gazebo Classic, takes a declaration anywhere.
    late = not file.is_xacro and malformed is not None and "declaration allowed only at the start" in malformed.message
    about = Subject("file", path)
    yield rule.claim(said, place, subject=about, doubts=(*LOOSE, *doubts(OTHER_VERSION=late)))


def _malformed(rule: Rule, context: Context, robot: Described, malformed: Malformed) -> Finding:
    place: Location = robot.param.place
    where, about = f"line {malformed.line}", Subject("parameter", robot.param.name)
    if not robot.text.lstrip().startswith("<"):
        return rule.claim(
            f"parameter '{robot.param.name}' is not XML: it does not begin with '<'",
            place,
            subject=about,
            related=include_chain(robot.param.origin),
        )
    file = next(iter(files_of(robot, context.disk, context.environment)), None)
    if file is not None and file.document.text == robot.text:
        lines = file.document.lines
        place = file.document.location(lines.line_span(min(malformed.line, len(lines)) - 1))
        where = shown(file.document.path, context)
    message = f"parameter '{robot.param.name}' is not well-formed XML: {malformed.message} ({where})"
    return rule.claim(message, place, subject=about)


def _raw(rule: Rule, context: Context, robot: Robot) -> Finding:
    """Nodes get what xacro was to read: its macros make no links, and its expressions are names for them."""
    place = robot.param.place
    tag = Tags(context.launch_files).around(place)
    file = tag.action.attribute("textfile") if tag is not None else None
    fixes: tuple[Fix, ...] = ()
    writer = context.writer(place.file)
    if file is not None and "'" not in file.value.text and isinstance(writer, XmlWriter):
        edits = writer.replace_attribute(file, "command", f"xacro '{file.value.text}'")
        fixes = fix("Process it with xacro", edits, preferred=True)
    return rule.claim(
        f"parameter '{robot.param.name}' is raw xacro: no command processes it",
        place,
        subject=Subject("parameter", robot.param.name),
        effect="misbehaves",
        related=include_chain(robot.param.origin),
        fixes=fixes,
    )


RULE = Rule(
    id="URD001",
    name="malformed-description",
    effect="stops-node",
    kind="invalid",
    sometimes=("misbehaves", Reason.NOT_GIVEN),
    what="Checks for a parameter `robot_description` that is not well-formed XML, has another root element than "
    "`<robot>`, `<sdf>` or `<COLLADA>`, or is raw xacro. The semantic description (SRDF) must be well-formed, too, "
    "and so must each xacro, URDF, SRDF, SDF and world file of the workspace.",
    why="`robot_state_publisher` ends with an error and publishes no frame. Controller managers and planners wait for "
    "a description or end too.",
    example='<param name="robot_description" textfile="$(find arm)/urdf/arm.yaml"/>',
    instead='<param name="robot_description" textfile="$(find arm)/urdf/arm.urdf"/>',
    references=(URDF, XACRO),
    check=_check,
    of_description=_of_description,
    in_branches=True,
)
