"""ARG009: an argument has a value that is not among its choices."""

from collections.abc import Iterator

from preflight_analysis.evaluation.problems import ArgumentNotAChoice
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.model.catalogued import by_catalogue, doubts_of_file
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import did_you_mean, nearest
from preflight_analysis.model.problems import problems_of, rename
from preflight_analysis.rules.further_reading import LAUNCH_DESIGN, LAUNCH_SUBSTITUTIONS
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(context, ArgumentNotAChoice):
        wrong = problem.kind
        near = nearest(wrong.value, wrong.choices)
        allowed = ", ".join(f"'{choice}'" for choice in wrong.choices)
        message = (
            f"invalid value '{wrong.value}' of argument '{wrong.name}'; the choices are {allowed}{did_you_mean(near)}"
        )
        message += by_catalogue(context, wrong.declared.file)
        fixes = rename(context, problem.location, wrong.value, near) if near else ()
        declared = Related("declared here", wrong.declared)
        yield problem_claim(
            rule,
            problem,
            message,
            subject=Subject("argument", wrong.name),
            kind="near" if near else "invalid",
            doubts=doubts_of_file(context, wrong.declared.file),
            candidates=(near,),
            related=(declared,),
            fixes=fixes,
        )


RULE = Rule(
    id="ARG009",
    name="argument-not-a-choice",
    effect="stops-launch",
    kind="invalid",
    sometimes=(Reason.OTHER_DISTRIBUTION,),
    what="Checks for a value, from an include or a default, that is not among the declared choices of the argument.",
    why="`ros2 launch` stops when it executes the declaration. Earlier actions are already running then.",
    example='<arg name="model" default="s1">\n  <choice value="a1"/>\n  <choice value="s2"/>\n</arg>',
    instead='<arg name="model" default="s2">\n  <choice value="a1"/>\n  <choice value="s2"/>\n</arg>',
    generations=(2,),
    references=(
        LAUNCH_DESIGN,
        LAUNCH_SUBSTITUTIONS,
    ),
    check=_check,
    problems=(ArgumentNotAChoice,),
    in_branches=True,
)
