"""ARG005: an argument is declared twice."""

from collections.abc import Iterator

from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.rules.problems import problem_finding, problems_of
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(rule, context):
        message = f"argument '{problem.data['name']}' is declared already"
        yield problem_finding(rule, problem, message, related=(Related("declared here", problem.data["first"]),))


RULE = Rule(
    id="ARG005",
    name="argument-redeclared",
    severity="error",
    what="Reports a second `<arg>` of the same name in one file.",
    why="`roslaunch` stops. Two declarations under conditions of which only one is true are fine.",
    example='<arg name="rate" default="10"/>\n<arg name="rate" default="20"/>',
    instead='<arg name="rate" default="20"/>',
    check=_check,
    problems=("arg-redeclared",),
)
