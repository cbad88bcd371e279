"""LCH015: files that include each other."""

from collections.abc import Iterator

from preflight_analysis.evaluation.problems import IncludeCycle
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import problems_of, shown
from preflight_analysis.rules.further_reading import LARGE_PROJECTS, ROSLAUNCH_INCLUDE
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(context, IncludeCycle):
        way = " -> ".join(shown(path, context) for path in problem.kind.chain)
        message = f"include cycle: '{shown(problem.kind.path, context)}' includes itself: {way}"
        yield problem_claim(rule, problem, message, subject=Subject("file", problem.kind.path))


RULE = Rule(
    id="LCH015",
    name="include-cycle",
    effect="stops-launch",
    kind="conflict",
    what="Checks for an `<include>` of a file that is already being included.",
    why="`roslaunch` recurses until Python's recursion limit stops it, and starts nothing.",
    example='<!-- in robot.launch -->\n<include file="$(find robot)/launch/robot.launch"/>',
    instead='<!-- in robot.launch -->\n<include file="$(find robot)/launch/base.launch"/>',
    references=(
        ROSLAUNCH_INCLUDE,
        LARGE_PROJECTS,
    ),
    check=_check,
    problems=(IncludeCycle,),
)
