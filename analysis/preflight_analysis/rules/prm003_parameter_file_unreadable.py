"""PRM003: a parameter file that cannot be read."""

from collections.abc import Iterator

from preflight_analysis.evaluation.problems import UnreadableParameterFile
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.problems import problem_finding, problems_of, shown
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(context, UnreadableParameterFile):
        path = shown(problem.kind.path, context)
        yield problem_finding(rule, problem, f"parameter file '{path}' cannot be read: {problem.kind.reason}")


RULE = Rule(
    id="PRM003",
    name="parameter-file-unreadable",
    severity="error",
    what="Reports a parameter file that exists but is a folder, is not permitted to be read, too large, or not text "
    "where text is needed.",
    why="`roslaunch` stops and starts nothing.",
    example='<rosparam command="load" file="$(find camera)/config"/>',
    instead='<rosparam command="load" file="$(find camera)/config/camera.yaml"/>',
    check=_check,
    problems=(UnreadableParameterFile,),
)
