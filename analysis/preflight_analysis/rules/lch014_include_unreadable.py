"""LCH014: an include of a file that cannot be read as a launch file."""

from collections.abc import Iterator

from preflight_analysis.evaluation.problems import UnreadableInclude
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.problems import problem_finding, problems_of, shown
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(context, UnreadableInclude):
        path = shown(problem.kind.path, context)
        yield problem_finding(rule, problem, f"included file '{path}' cannot be read: {problem.kind.reason}")


RULE = Rule(
    id="LCH014",
    name="include-unreadable",
    severity="error",
    what="Reports an `<include>` of a file that exists but is a folder, binary, too large, not permitted to be read, "
    "or no launch file.",
    why="`roslaunch` stops and starts nothing.",
    example='<include file="$(find camera)/launch"/>',
    instead='<include file="$(find camera)/launch/camera.launch"/>',
    check=_check,
    problems=(UnreadableInclude,),
)
