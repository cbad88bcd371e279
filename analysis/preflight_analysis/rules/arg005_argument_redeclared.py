"""ARG005: an argument is declared or passed twice."""

from collections.abc import Iterator

from preflight_analysis.evaluation.problems import RedeclaredArgument
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.model.arguments import remove_at
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import problems_of
from preflight_analysis.rules.further_reading import ROSLAUNCH_ARG
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(context, RedeclaredArgument):
        name, done = problem.kind.name, "passed" if problem.kind.passed else "declared"
        related = (Related(f"{done} here", problem.kind.first),)
        fixes = remove_at(context, problem.location, f'Remove the second <arg name="{name}">')
        yield problem_claim(
            rule,
            problem,
            f"duplicate argument '{name}': it is {done} twice",
            subject=Subject("argument", name),
            related=related,
            fixes=fixes,
        )


RULE = Rule(
    id="ARG005",
    name="argument-redeclared",
    effect="stops-launch",
    kind="duplicate",
    what="Checks for a second `<arg>` of the same name in one file or in one `<include>`.",
    why="`roslaunch` stops. Two declarations under conditions of which only one is true are valid.",
    example='<arg name="rate" default="10"/>\n<arg name="rate" default="20"/>',
    instead='<arg name="rate" default="20"/>',
    references=(ROSLAUNCH_ARG,),
    check=_check,
    problems=(RedeclaredArgument,),
    in_branches=True,
)
