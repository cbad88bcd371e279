"""PRM002: a parameter file that is not there."""

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
        message = f"parameter file '{shown(path, context)}' does not exist"
        fixes: tuple[Fix, ...] = ()
        if near is not None:
            message += f"; did you mean '{shown(near, context)}'?"
            if Path(near).parent == Path(path).parent:
                fixes = rename(context, problem.location, Path(path).name, Path(near).name)
        yield problem_finding(rule, problem, message, fixes=fixes)


RULE = Rule(
    id="PRM002",
    name="parameter-file-not-found",
    severity="error",
    what="Reports a `<rosparam file=...>`, `<param textfile=...>` or `<param binfile=...>` whose file does not exist, "
    "and names the nearest one of that folder or package.",
    why="`roslaunch` stops and starts nothing.",
    example='<rosparam command="load" file="$(find camera)/config/camrea.yaml"/>',
    instead='<rosparam command="load" file="$(find camera)/config/camera.yaml"/>',
    check=_check,
    problems=("param-file-not-found",),
)
