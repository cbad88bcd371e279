"""LCH009: a name that ROS does not allow."""

from collections.abc import Iterator

from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.problems import problem_finding, problems_of
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(rule, context):
        data = problem.data
        message = f"{data['what']} name '{data['name']}' is not allowed: {data['reason']}"
        yield problem_finding(rule, problem, message, severity=None if problem.fatal else "warning")


RULE = Rule(
    id="LCH009",
    name="invalid-name",
    severity="error",
    what="Reports the name of a node, argument, remap or parameter that ROS does not allow.",
    why="`roslaunch` stops; for a node's name with other characters it only warns, and other tools stumble. Names "
    "start with a letter (or `/`, `~` where a graph resource is meant) and go on with "
    "letters, digits, `_` and `/`; a node's name has no `/` at all, its namespace is given with `ns`.",
    example='<node pkg="camera" type="driver" name="front/camera"/>',
    instead='<node pkg="camera" type="driver" name="camera" ns="front"/>',
    check=_check,
    problems=("invalid-name",),
)
