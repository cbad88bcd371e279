"""URD001: a robot description that is no XML, or no URDF."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.documents.span import Location
from preflight_analysis.edits.xml import XmlWriter
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.robot.model import Malformed
from preflight_analysis.robot.of_launch import Described, Robot, robots_of, semantics_of
from preflight_analysis.robot.sources import files_of
from preflight_analysis.rules.further_reading import URDF, XACRO
from preflight_analysis.rules.problems import fix, include_chain, shown
from preflight_analysis.rules.rule import Context, Rule
from preflight_analysis.rules.syntax import Tags

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
            yield rule.finding(
                f"root element of '{robot.param.name}' is <{description.kind}>, not <robot>",
                robot.param.place,
                related=include_chain(robot.param.origin),
            )
    for semantic in semantics_of(context.tree):
        if semantic.semantic.malformed is not None:
            yield _malformed(rule, context, semantic, semantic.semantic.malformed)


def _malformed(rule: Rule, context: Context, robot: Described, malformed: Malformed) -> Finding:
    place: Location = robot.param.place
    where = f"line {malformed.line}"
    if not robot.text.lstrip().startswith("<"):
        return rule.finding(
            f"parameter '{robot.param.name}' is not XML: it does not begin with '<'",
            place,
            related=include_chain(robot.param.origin),
        )
    file = next(iter(files_of(robot, context.disk, context.environment)), None)
    if file is not None and file.document.text == robot.text:
        lines = file.document.lines
        place = file.document.location(lines.line_span(min(malformed.line, len(lines)) - 1))
        where = shown(file.document.path, context)
    return rule.finding(f"parameter '{robot.param.name}' is not well-formed XML: {malformed.message} ({where})", place)


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
    return rule.finding(
        f"parameter '{robot.param.name}' is raw xacro: no command processes it",
        place,
        severity="warning",
        related=include_chain(robot.param.origin),
        fixes=fixes,
    )


RULE = Rule(
    id="URD001",
    name="malformed-description",
    severity="error",
    what="Checks for a parameter `robot_description` that is not well-formed XML, or whose root element is not "
    "`<robot>`, `<sdf>` or `<COLLADA>`. The rule reads the value that the nodes get: the output of xacro, or the text "
    "of the file. "
    "The semantic description (SRDF) must be well-formed, too. "
    "A description that xacro has yet to process is a warning, and the other rules do not read it. A value that is a "
    "name is not checked: some nodes get the name of the parameter with the description.",
    why="`robot_state_publisher` ends with an error and publishes no frame. Controller managers and planners wait for "
    "a description or end too.",
    example='<param name="robot_description" textfile="$(find arm)/urdf/arm.yaml"/>',
    instead='<param name="robot_description" textfile="$(find arm)/urdf/arm.urdf"/>',
    references=(URDF, XACRO),
    check=_check,
    in_branches=True,
)
