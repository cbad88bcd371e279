"""LCH008: an attribute's value is not one of those that it can have."""

from collections.abc import Iterator

from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.nearest import did_you_mean, nearest
from preflight_analysis.rules.problems import problem_finding, problems_of, rename
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(rule, context):
        data = problem.data
        near = nearest(str(data["value"]), data["choices"])
        message = f"{data['attribute']}='{data['value']}' of <{data['tag']}> is not {data['expected']}"
        fixes = rename(context, problem.location, str(data["value"]), near) if near else ()
        yield problem_finding(rule, problem, message + did_you_mean(near), fixes=fixes)


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
