"""LCH016: two nodes of one name."""

from collections.abc import Iterator

from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.rules.problems import problem_finding, problems_of
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(rule, context):
        message = f"there is another node with the name '{problem.data['name']}'"
        yield problem_finding(rule, problem, message, related=(Related("the first one", problem.data["first"]),))


RULE = Rule(
    id="LCH016",
    name="duplicate-node",
    severity="error",
    what="Reports a second node with the same full name, in this file or in one that is included.",
    why="`roslaunch` stops: names are unique in the graph, a second node would shut the first one down.",
    example='<node pkg="laser" type="driver" name="laser"/>\n<node pkg="laser" type="driver" name="laser"/>',
    instead='<node pkg="laser" type="driver" name="laser_front"/>\n<node pkg="laser" type="driver" name="laser_rear"/>',
    check=_check,
    problems=("duplicate-node",),
)
