"""ARG002: an include does not pass an argument that the file requires."""

from collections.abc import Iterator

from preflight_analysis.evaluation.problems import MissingArgument
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.arguments import pass_on, passes_all, rename_passed
from preflight_analysis.model.catalogued import by_catalogue, doubts_of_file
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import nearest
from preflight_analysis.model.problems import problems_of, shown
from preflight_analysis.rules.further_reading import LARGE_PROJECTS, ROSLAUNCH_ARG, ROSLAUNCH_INCLUDE
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(context, MissingArgument):
        name, file = problem.kind.name, shown(problem.kind.file, context)
        near = nearest(name, problem.kind.passed)
        hint = f"; the include passes '{near}'" if near else ""
        known = by_catalogue(context, problem.kind.file)
        message = f"required argument '{name}' of '{file}' is not passed{hint}{known}"
        can_be_given = passes_all(context, problem.origin)
        if can_be_given:
            message += f"; launch with {name}:=..."
        fixes = (
            *(rename_passed(context, problem.location, near, name) if near else ()),
            *pass_on(context, problem.location, name),
        )
        yield problem_claim(
            rule,
            problem,
            message,
            subject=Subject("argument", name),
            kind="near" if near else "absent",
            doubts=(
                *doubts_of_file(context, problem.kind.file),
                *doubts(NOT_SET=can_be_given and f"argument '{name}'"),
            ),
            candidates=(near,),
            fixes=fixes,
        )


RULE = Rule(
    id="ARG002",
    name="missing-argument",
    effect="stops-launch",
    kind="absent",
    sometimes=(Reason.NOT_SET, Reason.OTHER_DISTRIBUTION),
    what="Checks for an `<include>` that does not pass an argument which the included file declares without default.",
    why="`roslaunch` stops with `requires the 'name' arg to be set`.",
    example='<include file="$(find camera)/launch/camera.launch"/>',
    instead='<include file="$(find camera)/launch/camera.launch">\n  <arg name="serial" value="7cd1"/>\n</include>',
    references=(
        ROSLAUNCH_ARG,
        ROSLAUNCH_INCLUDE,
        LARGE_PROJECTS,
    ),
    check=_check,
    problems=(MissingArgument,),
    in_branches=True,
)
