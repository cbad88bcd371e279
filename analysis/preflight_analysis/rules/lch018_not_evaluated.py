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
from preflight_analysis.findings.finding import Finding, Severity
from preflight_analysis.rules.further_reading import ANONYMOUS_NAMES, RUNS, SECURITY
from preflight_analysis.rules.problems import problem_finding, problems_of
from preflight_analysis.rules.rule import Context, Rule

_KINDS = (CommandNotRun, LaunchFileNotRun, EvalNotAllowed, UnexpandedEntity, NestedTooDeeply, ValueTooLong)


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(context, *_KINDS):
        severity: Severity | None = None
        match problem.kind:
            case CommandNotRun(reason):
                # Every robot description is made by a command: said, but quietly.
                severity = "hint"
                message = f"command not run, its value is unresolved: {reason}"
            case LaunchFileNotRun(name, reason):
                severity = "hint"
                message = f"{name} is not run, read statically; results may be incomplete: {reason}"
            case EvalNotAllowed(expression, reason):
                message = f"$(eval {expression}) is not evaluated: {reason}"
            case UnexpandedEntity(name):
                message = f"entity '&{name};' is not expanded; values that use it are unresolved"
            case NestedTooDeeply(limit):
                message = f"more than {limit} of groups and includes; the rest is not evaluated"
            case ValueTooLong(limit):
                message = f"value of more than {limit}; it is unresolved"
        yield problem_finding(rule, problem, message, severity=severity)


RULE = Rule(
    id="LCH018",
    name="not-evaluated",
    severity="info",
    what="Checks for parts of a launch file that are valid but not evaluated here. These are the `command` of a "
    "parameter that was not run, and an `$(eval ...)` that needs Python itself. Others are a Python launch file "
    "that was not run, an entity of a DOCTYPE, and endless includes and groups. A command that was not run is a "
    "hint. Commands run in the sandbox if the workspace is trusted.",
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
