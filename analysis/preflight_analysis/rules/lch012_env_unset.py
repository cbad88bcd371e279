"""LCH012: $(env) of a variable that is not set."""

from collections.abc import Iterator

from preflight_analysis.evaluation.problems import AssumedVariable, UnsetVariable
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.installed import lack_of_variable, near_variable, unset_variable
from preflight_analysis.model.nearest import did_you_mean
from preflight_analysis.model.problems import problems_of, rename
from preflight_analysis.rules.further_reading import ANONYMOUS_NAMES, LAUNCH_SUBSTITUTIONS
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(context, UnsetVariable):
        name, lack = problem.kind.name, lack_of_variable(context, problem.kind.name)
        near = near_variable(context, name) if lack is None else None
        yield problem_claim(
            rule,
            problem,
            f"environment variable '{name}' is not set{did_you_mean(near)}",
            subject=Subject("variable", name),
            kind="near" if near is not None else "absent",
            effect=None if problem.fatal else "misbehaves",  # Python writes `None` into a text, and goes on
            candidates=(near,),
            fixes=rename(context, problem.location, name, near) if near is not None else (),
            lack=lack,
        )
    for assumed in problems_of(context, AssumedVariable):
        name = assumed.kind.name
        message = f"environment variable '{name}' is not set; '{assumed.kind.value}' is assumed"
        lack = unset_variable(context, name)
        yield problem_claim(
            rule, assumed, message, subject=Subject("variable", name), kind="absent", effect="misbehaves", lack=lack
        )


RULE = Rule(
    id="LCH012",
    name="environment-variable-unset",
    effect="stops-launch",
    kind="near",
    always=(Reason.UNSEEN,),
    sometimes=("misbehaves", Reason.NOT_HERE),
    what="Checks for `$(env NAME)`, or `os.environ['NAME']` in a Python launch file, of a variable that is not set. "
    "Variables without a near name are listed with what is missing on this machine.",
    why="The launcher stops if the variable is not set.",
    example='<param name="map" value="$(env HOEM)/maps/office.yaml"/>',
    instead='<param name="map" value="$(env HOME)/maps/office.yaml"/>',
    references=(
        ANONYMOUS_NAMES,
        LAUNCH_SUBSTITUTIONS,
    ),
    check=_check,
    problems=(UnsetVariable, AssumedVariable),
    in_branches=True,
)
