"""LCH013: an include of a file that is not there."""

from collections.abc import Iterator
from pathlib import Path

from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.rules.files import nearest_file
from preflight_analysis.rules.problems import problem_finding, problems_of, rename, shown
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(rule, context):
        path = str(problem.data["path"])
        near = nearest_file(path, context.environment)
        message = f"included file '{shown(path, context)}' does not exist"
        fixes: tuple[Fix, ...] = ()
        if near is not None:
            message += f"; did you mean '{shown(near, context)}'?"
            if Path(near).parent == Path(path).parent:
                fixes = rename(context, problem.location, Path(path).name, Path(near).name)
        yield problem_finding(rule, problem, message, fixes=fixes)


RULE = Rule(
    id="LCH013",
    name="include-not-found",
    severity="error",
    what="Reports an `<include>` of a file that does not exist, and names the nearest file of that folder or package.",
    why="`roslaunch` stops and starts nothing, however deep the include stands. A relative path is looked up from the "
    "folder in which `roslaunch` is started, not from that of the file.",
    example='<include file="$(find camera)/launch/camrea.launch"/>',
    instead='<include file="$(find camera)/launch/camera.launch"/>',
    check=_check,
    problems=("include-not-found",),
)
