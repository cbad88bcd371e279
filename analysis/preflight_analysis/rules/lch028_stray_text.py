"""LCH028: text between tags."""

from __future__ import annotations

import re
from collections.abc import Iterator

from preflight_analysis.documents.span import Location
from preflight_analysis.edits.xml import XmlWriter
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.launch.problems import StrayText
from preflight_analysis.launch.schema_ros1 import TAGS
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import fix, problems_of, shortened
from preflight_analysis.rules.further_reading import ROSLAUNCH, XML_STANDARD
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule

_TAG = re.compile(rf"(?:{'|'.join(TAGS)})(?=\s+[\w-]+\s*=)")
_REMARK = ("#", "//")


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
        fixes = _fixes(context, location, text, lost)
        yield problem_claim(
            rule,
            problem,
            message,
            subject=Subject("text", text),
            effect="style" if put or text.startswith(_REMARK) else None,
            fixes=fixes,
        )


def _fixes(context: Context, place: Location, text: str, lost: bool) -> Iterator[Fix]:
    writer = context.writer(place.file)
    if not isinstance(writer, XmlWriter):
        return
    if lost:
        yield from fix("Insert '<'", writer.insert_open_bracket(place.span.start), preferred=True)
    elif text.startswith(_REMARK):
        edits = writer.comment_out(place.span, text.lstrip("#/ "))
        yield from fix("Convert the text to a comment", edits, preferred=True)


RULE = Rule(
    id="LCH028",
    name="stray-text",
    effect="no-effect",
    kind="invalid",
    sometimes=("style",),
    what="Checks for text between the tags of a launch file, outside of `<rosparam>`.",
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
