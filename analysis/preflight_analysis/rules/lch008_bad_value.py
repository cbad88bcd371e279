"""LCH008: an attribute's value is not one of those that it can have."""

from __future__ import annotations

import re
from collections.abc import Iterator

from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.launch.problems import BadValue
from preflight_analysis.model.arguments import empty_arguments
from preflight_analysis.model.asked_variables import lack_of_asked
from preflight_analysis.model.context import Context
from preflight_analysis.model.distributions import BEFORE_NOETIC, otherwise_in
from preflight_analysis.model.nearest import did_you_mean, nearest
from preflight_analysis.model.problems import problems_of, quoted, rename, shortened
from preflight_analysis.rules.further_reading import LAUNCH_XML_DESIGN, ROSLAUNCH
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule

_TRUTH = {
    **dict.fromkeys(("1", "yes", "y", "on", "t"), "true"),
    **dict.fromkeys(("0", "no", "n", "off", "f"), "false"),
}
_DIVISION = re.compile(r"\$\(\s*eval\b[^$]*[^/]/[^/]")
"""Of integers it is one in Python 2 alone."""
_WHOLE = re.compile(r"[+-]?[0-9]+\.0*")


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(context, BadValue):
        bad = problem.kind
        near = _meant(bad)
        value = shortened(" ".join(bad.value.split()))
        message = f"invalid value '{value}' of attribute '{bad.attribute}' of <{bad.tag}>: expected {bad.expected}"
        if bad.expected == "not empty":
            message = f"attribute '{bad.attribute}' of <{bad.tag}> is empty"
        fixes = rename(context, problem.location, bad.value, near) if near else ()
        empty = empty_arguments(context, problem.location) if not bad.value else ()
        message += f"; set argument {quoted(empty)}" if empty else did_you_mean(near)
        lack = lack_of_asked(context, problem.location.file) if not bad.value else None
        message += f"; environment variable '{lack.name}' is not set" if lack is not None else ""
        python = otherwise_in(context.environment, BEFORE_NOETIC) if _may_be_divided(context, bad) else ()
        yield problem_claim(
            rule,
            problem,
            message,
            subject=Subject("attribute", bad.attribute),
            kind="near" if near and not empty else "invalid",
            doubts=(*doubts(NOT_SET=empty and f"argument {quoted(empty)}"), *python),
            candidates=() if empty else (near,),
            fixes=fixes,
            lack=lack,
        )


def _may_be_divided(context: Context, bad: BadValue) -> bool:
    """Whether a division in Python may have made a number that should be an integer."""
    if bad.expected != "an integer" or not _WHOLE.fullmatch(bad.value.strip()):
        return False
    return any(_DIVISION.search(file.document.text) is not None for file in context.launch_files.values())


def _meant(bad: BadValue) -> str | None:
    """The value that roslaunch takes and that is most likely meant."""
    near = nearest(bad.value, bad.choices)
    if near is None and "true" in bad.choices:
        near = _TRUTH.get(bad.value.strip().lower())
    if near is None and bad.expected == "an integer" and _WHOLE.fullmatch(bad.value.strip()):
        near = bad.value.strip().partition(".")[0]
    return near


RULE = Rule(
    id="LCH008",
    name="bad-value",
    effect="stops-launch",
    kind="invalid",
    sometimes=(Reason.NOT_SET, Reason.NOT_HERE, Reason.MEANT_FOR_OTHER),
    what="Checks for an invalid value of an attribute: a word instead of a number, a condition that is not a truth "
    "value, or an unknown choice.",
    why="The launcher stops and starts nothing. The value is checked after its substitutions are resolved.",
    example='<node pkg="camera" type="driver" name="camera" output="scren"/>',
    instead='<node pkg="camera" type="driver" name="camera" output="screen"/>',
    references=(
        ROSLAUNCH,
        LAUNCH_XML_DESIGN,
    ),
    check=_check,
    problems=(BadValue,),
    in_branches=True,
)
