"""URD014: a name in braces that xacro leaves as it is, as the `$` is missing."""

from __future__ import annotations

import re
from collections.abc import Iterator

from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.model import Environment
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.descriptions import defined_for, doubts_of
from preflight_analysis.model.problems import rename_in
from preflight_analysis.robot.xacro import COMPUTED, xacro_file
from preflight_analysis.rules.further_reading import XACRO
from preflight_analysis.rules.packages import check_nothing
from preflight_analysis.rules.rule import Rule

_IN_BRACES = re.compile(r"(?<![${])\{ *([A-Za-z_]\w*) *\}|[({]\$([A-Za-z_]\w*)[)}]|\$\(([A-Za-z_]\w*)\)")


def _of_description(rule: Rule, disk: Disk, environment: Environment, path: str) -> Iterator[Finding]:
    file = xacro_file(disk.db, path)
    if file is None or not file.is_xacro or file.document.problems:
        return
    for value, around in file.texts:
        if "{" not in value.text and "$" not in value.text:
            continue
        text = COMPUTED.sub(lambda match: match[0] if match[0].startswith("$(") else " " * len(match[0]), value.text)
        for match in _IN_BRACES.finditer(text):
            name = match[1] or match[2] or match[3]
            if name not in around.names and name not in defined_for(disk.db, environment, path).properties:
                continue
            span = value.slice_span(*match.span())
            meant = f"${{{name}}}"
            yield rule.claim(
                f"'{match[0]}' is literal text for xacro; did you mean '{meant}'?",
                file.document.location(span),
                subject=Subject("text", match[0]),
                doubts=doubts_of(around, other=False),
                candidates=(meant,),
                fixes=rename_in(file.document, span, match[0], meant),
            )


RULE = Rule(
    id="URD014",
    name="missing-dollar",
    effect="misbehaves",
    kind="near",
    always=(Reason.NOT_GIVEN,),
    what="Checks for the name of a xacro property or parameter in braces without the `$` before them, or with the `$` "
    "within.",
    why="xacro leaves it as it is, so the braces are in the name of a link, topic or plugin. Two calls of a macro then "
    "make the same name.",
    example='<xacro:property name="suffix" value="_left"/>\n<link name="finger{suffix}"/>',
    instead='<xacro:property name="suffix" value="_left"/>\n<link name="finger${suffix}"/>',
    references=(XACRO,),
    check=check_nothing,
    of_description=_of_description,
)
