"""ARG004: an include passes an argument that the file does not declare."""

from collections.abc import Iterator

from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.arguments import remove_at
from preflight_analysis.rules.nearest import did_you_mean, nearest
from preflight_analysis.rules.problems import problem_finding, problems_of, rename, shown
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(rule, context):
        name, file = str(problem.data["name"]), shown(str(problem.data["file"]), context)
        near = nearest(name, problem.data["declared"])
        fixes = (
            *(rename(context, problem.location, name, near) if near else ()),
            *remove_at(context, problem.location, f"Do not pass argument '{name}'"),
        )
        yield problem_finding(rule, problem, f"'{file}' declares no argument '{name}'{did_you_mean(near)}", fixes=fixes)


RULE = Rule(
    id="ARG004",
    name="unknown-include-argument",
    severity="error",
    what="Reports an `<arg>` in an `<include>` that the included file does not declare, and names the nearest one that "
    "it does.",
    why="`roslaunch` stops with `unused args`.",
    example='<include file="camera.launch">\n  <arg name="frame" value="front"/>\n</include>',
    instead='<include file="camera.launch">\n  <arg name="frame_id" value="front"/>\n</include>',
    check=_check,
    problems=("include-arg-undeclared",),
)
