"""PRM004: parameters that are not valid YAML."""

from collections.abc import Iterator

from preflight_analysis.evaluation.problems import BadYaml
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.files import says_not_set
from preflight_analysis.model.problems import problems_of
from preflight_analysis.rules.further_reading import ROSLAUNCH_ROSPARAM, YAML_STANDARD
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(context, BadYaml):
        message = problem.kind.message
        text, unset = say("invalid parameters: {quoted}", quoted=message), doubts(NOT_SET=says_not_set(message))
        yield problem_claim(rule, problem, text, subject=Subject("text"), doubts=unset)


RULE = Rule(
    id="PRM004",
    name="bad-yaml",
    effect="stops-launch",
    kind="invalid",
    sometimes=(Reason.NOT_SET, Reason.NOT_GIVEN),
    what="Checks for parameters, in a `<rosparam>` or in the file that it loads, that are not valid YAML or have an "
    "invalid structure.",
    why="`roslaunch` stops and starts nothing.",
    example="<rosparam>\nrate: 10\n\tframe: map\n</rosparam>",
    instead="<rosparam>\nrate: 10\nframe: map\n</rosparam>",
    references=(
        ROSLAUNCH_ROSPARAM,
        YAML_STANDARD,
    ),
    check=_check,
    problems=(BadYaml,),
    in_branches=True,
)
