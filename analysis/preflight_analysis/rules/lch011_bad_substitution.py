"""LCH011: a substitution that cannot be made."""

from collections.abc import Iterator, Mapping

from preflight_analysis.evaluation.problems import EvalFailed, Problem, UnsetParameter
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.launch.problems import BadSubstitution
from preflight_analysis.launch.python_api import COMMANDS
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import did_you_mean, nearest
from preflight_analysis.model.parts_of_launches import is_part
from preflight_analysis.model.problems import problems_of, rename
from preflight_analysis.rules.further_reading import ANONYMOUS_NAMES, LAUNCH_SUBSTITUTIONS
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule

_RENAMED: Mapping[int, Mapping[str, str]] = {
    1: {},
    2: {
        **COMMANDS,
        **{"arg": "var", "find": "find-pkg-share", "optenv": "env", "env-default": "env"},
        "FindPackage": "find-pkg-share",
    },
}
"""By generation: what substitutions of ROS 1, and those of Python launch files, are called in XML and YAML of ROS 2."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(context, BadSubstitution, EvalFailed):
        match problem.kind:
            case EvalFailed(expression, message):
                said = say("$(eval {expression}) fails: {quoted}", expression=expression, quoted=message)
                yield problem_claim(rule, problem, said, subject=Subject("expression", expression))
            case BadSubstitution() as bad:
                meant = _meant(context, bad)
                fixes = rename(context, problem.location, bad.command, meant) if meant is not None else ()
                yield problem_claim(
                    rule,
                    problem,
                    bad.message + did_you_mean(meant),
                    subject=Subject("substitution", bad.command or ""),
                    kind="near" if meant is not None else "invalid",
                    candidates=(meant,),
                    fixes=fixes,
                )
    for unset in problems_of(context, UnsetParameter):
        yield _unset(rule, context, unset)


def _unset(rule: Rule, context: Context, problem: Problem[UnsetParameter]) -> Finding:
    name, not_followed = problem.kind.name, problem.kind.not_followed
    about = Subject("parameter", name)
    if not_followed is not None:
        return problem_claim(
            rule,
            problem,
            f"parameter '{name}' is not set, unless the unresolved include sets it",
            subject=about,
            kind="absent",
            doubts=doubts(UNSEEN=True, NOT_HERE=True),
            related=(Related("unresolved, may set it", not_followed),),
        )
    message = f"parameter '{name}' is not set: no <set_parameter> before this line"
    part = is_part(context)
    if part:
        message += "; the including launch file has to set it"
    return problem_claim(rule, problem, message, subject=about, kind="absent", doubts=doubts(SET_ASIDE=part))


def _meant(context: Context, bad: BadSubstitution) -> str | None:
    """The command that there is and that is probably meant."""
    near = nearest(bad.command, bad.commands) if bad.command else None
    return _RENAMED[context.tree.generation].get(bad.command, near) if bad.commands else near


RULE = Rule(
    id="LCH011",
    name="bad-substitution",
    effect="stops-launch",
    kind="invalid",
    sometimes=(Reason.UNSEEN, Reason.NOT_HERE),
    what="Checks for a `$(...)` that is incomplete or of an unknown kind, and for an `$(eval ...)` that fails. In "
    "ROS 2 it checks for `$(param name)` where no earlier action sets that parameter.",
    why="The launcher stops. An `$(eval ...)` must be the whole attribute.",
    example='<param name="rate" value="$(args rate)"/>',
    instead='<param name="rate" value="$(arg rate)"/>',
    references=(
        ANONYMOUS_NAMES,
        LAUNCH_SUBSTITUTIONS,
    ),
    check=_check,
    problems=(
        BadSubstitution,
        EvalFailed,
        UnsetParameter,
    ),
    in_branches=True,
)
