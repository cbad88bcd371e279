"""LCH018: what roslaunch would evaluate and the analysis does not."""

from collections.abc import Iterator

from preflight_analysis.evaluation.problems import (
    CommandNotRun,
    EvalNotAllowed,
    LaunchFileNotRun,
    NestedTooDeeply,
    UnexpandedEntity,
    ValueTooLong,
)
from preflight_analysis.findings.claim import Effect, Subject
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import problems_of
from preflight_analysis.rules.further_reading import ANONYMOUS_NAMES, RUNS, SECURITY
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule

_KINDS = (CommandNotRun, LaunchFileNotRun, EvalNotAllowed, UnexpandedEntity, NestedTooDeeply, ValueTooLong)


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(context, *_KINDS):
        effect: Effect = "note"
        match problem.kind:
            case CommandNotRun(reason):
                # Every robot description is made by a command: said, but quietly.
                effect, about = "style", Subject("command")
                message = f"command not run, its value is unresolved: {reason}"
            case LaunchFileNotRun(name, reason):
                effect, about = "style", Subject("file")
                message = f"{name} is not run, read statically; results may be incomplete: {reason}"
            case EvalNotAllowed(expression, reason):
                about = Subject("expression")
                message = f"$(eval {expression}) is not evaluated: {reason}"
            case UnexpandedEntity(name):
                about = Subject("text", name)
                message = f"entity '&{name};' is not expanded; values that use it are unresolved"
            case NestedTooDeeply(limit):
                about = Subject("element")
                message = f"more than {limit} of groups and includes; the rest is not evaluated"
            case ValueTooLong(limit):
                about = Subject("text")
                message = f"value of more than {limit}; it is unresolved"
        yield problem_claim(rule, problem, message, subject=about, effect=effect)


RULE = Rule(
    id="LCH018",
    name="not-evaluated",
    effect="note",
    kind="invalid",
    sometimes=("style",),
    what="Checks for parts of a launch file that are valid but not evaluated here: commands, expressions of Python, "
    "Python launch files, entities, and endless includes. Commands run in the sandbox if the workspace is "
    "trusted.",
    why="Values that depend on it are unresolved, and nodes that need them are not run. Findings that need the "
    "values are missing. It is not an error of the file.",
    example='<param name="letters" value="$(eval [letter for letter in name])"/>',
    instead='<param name="letters" value="$(eval list(name))"/>',
    references=(
        ANONYMOUS_NAMES,
        SECURITY,
        RUNS,
    ),
    check=_check,
    problems=_KINDS,
)
