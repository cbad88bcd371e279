"""LCH028: text between tags."""

from __future__ import annotations

import re
from collections.abc import Iterator

from preflight_analysis.documents.span import Location, Span
from preflight_analysis.edits.edit import Edit
from preflight_analysis.findings.finding import Finding, Fix, Severity
from preflight_analysis.launch.problems import StrayText
from preflight_analysis.launch.schema_ros1 import TAGS
from preflight_analysis.rules.further_reading import ROSLAUNCH, XML_STANDARD
from preflight_analysis.rules.problems import problem_finding, problems_of, shortened
from preflight_analysis.rules.rule import Context, Rule

_TAG = re.compile(rf"(?:{'|'.join(TAGS)})(?=\s+[\w-]+\s*=)")
_REMARK = re.compile(r"(?:#|//)")


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(context, StrayText):
        text = problem.kind.text
        location = problem.location
        document = context.documents.get(location.file)
        # What stands in a section of character data was put there to be left out.
        put = document is not None and document.text[: location.span.start].rstrip().endswith("<![CDATA[")
        lost = not put and _TAG.match(text) is not None
        hint = "; insert the missing '<'" if lost else ""
        message = f"stray text '{shortened(text)}' in <{problem.kind.tag}>: roslaunch ignores it{hint}"
        severity: Severity | None = "hint" if put or _REMARK.match(text) else None
        fixes = _fixes(context, location, text, lost)
        yield problem_finding(rule, problem, message, severity=severity, fixes=fixes)


def _fixes(context: Context, place: Location, text: str, lost: bool) -> Iterator[Fix]:
    if lost:
        start = place.span.start
        yield Fix("Insert '<'", (Edit(context.location(place.file, Span(start, start)), "<"),), True)
    elif _REMARK.match(text) and "--" not in text:
        # A comment in XML cannot have two dashes in it.
        yield Fix("Convert the text to a comment", (Edit(place, f"<!-- {text.lstrip('#/ ')} -->"),), True)


RULE = Rule(
    id="LCH028",
    name="stray-text",
    severity="warning",
    what="Checks for text between the tags of a launch file, outside of `<rosparam>`. A remark, or the content of a "
    "`CDATA` section, is a hint.",
    why="XML allows such text and `roslaunch` ignores it. It may be a tag that has lost its `<`, so that a "
    "node is never started. It may also be a comment without its marks.",
    example='<launch>\n  node pkg="rospy_tutorials" type="talker" name="talker"/>\n</launch>',
    instead='<launch>\n  <node pkg="rospy_tutorials" type="talker" name="talker"/>\n</launch>',
    references=(
        XML_STANDARD,
        ROSLAUNCH,
    ),
    check=_check,
    problems=(StrayText,),
)
