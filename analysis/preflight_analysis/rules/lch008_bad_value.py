"""LCH008: an attribute's value is not one of those that it can have."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.nearest import did_you_mean, nearest
from preflight_analysis.rules.problems import problem_finding, problems_of, rename
from preflight_analysis.rules.rule import Context, Rule

_TRUTH = {
    **dict.fromkeys(("1", "yes", "y", "on", "t"), "true"),
    **dict.fromkeys(("0", "no", "n", "off", "f"), "false"),
}
_WHOLE = re.compile(r"[+-]?[0-9]+\.0*")


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(rule, context):
        data = problem.data
        near = _meant(str(data["value"]), str(data["expected"]), data["choices"])
        message = f"{data['attribute']}='{data['value']}' of <{data['tag']}> is not {data['expected']}"
        fixes = rename(context, problem.location, str(data["value"]), near) if near else ()
        yield problem_finding(rule, problem, message + did_you_mean(near), fixes=fixes)


def _meant(value: str, expected: str, choices: Sequence[str]) -> str | None:
    """The value that roslaunch takes and that is most likely meant."""
    near = nearest(value, choices)
    if near is None and "true" in choices:
        near = _TRUTH.get(value.strip().lower())
    if near is None and expected == "an integer" and _WHOLE.fullmatch(value.strip()):
        near = value.strip().partition(".")[0]
    return near


RULE = Rule(
    id="LCH008",
    name="bad-value",
    severity="error",
    what="Reports a value that its attribute cannot have: a word where a number is needed, a condition that is "
    "neither true nor false, an unknown choice.",
    why="`roslaunch` stops and starts nothing. The value is checked after its substitutions were made.",
    example='<node pkg="camera" type="driver" name="camera" output="scren"/>',
    instead='<node pkg="camera" type="driver" name="camera" output="screen"/>',
    check=_check,
    problems=("bad-value",),
)
