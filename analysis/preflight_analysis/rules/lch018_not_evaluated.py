"""LCH018: what roslaunch would evaluate and the analysis does not."""

from collections.abc import Iterator

from preflight_analysis.evaluation.tree import Problem
from preflight_analysis.findings.finding import Finding, Severity
from preflight_analysis.rules.problems import problem_finding, problems_of
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(rule, context):
        # Every robot description is made by a command: said, but quietly.
        severity: Severity | None = "hint" if problem.kind.endswith("-not-run") else None
        yield problem_finding(rule, problem, _message(problem), severity=severity)


def _message(problem: Problem) -> str:
    data = problem.data
    if problem.kind == "xml-entity":
        return f"entity '&{data['name']};' is not expanded; values that use it are unknown here"
    if problem.kind == "eval-not-allowed":
        return f"$(eval {data['expression']}) is not evaluated: {data['message']}"
    if problem.kind == "nested-too-deeply":
        return f"there are more than {data['limit']} of groups and includes; what is beyond is left out"
    if problem.kind == "value-too-long":
        return f"the values that are put together here have more than {data['limit']} characters; they are unknown here"
    if problem.kind == "launch-file-not-run":
        return f"{data['name']} was not run, and only what is written out is known of it: {data['reason']}"
    return f"the command was not run, and its value is unknown here: {data['reason']}"


RULE = Rule(
    id="LCH018",
    name="not-evaluated",
    severity="info",
    what="Says that something that `roslaunch` accepts is not evaluated here: the `command` of a parameter that was "
    "not run (a hint only; commands are run in the sandbox, if the workspace is trusted), an `$(eval ...)` that needs "
    "Python itself and was not run, a Python launch file that was not run, an entity that a DOCTYPE defines, includes "
    "and groups without end.",
    why="Values that depend on it are unknown, nodes that need them are not run, and findings that would need them "
    "are left out. It is no error of the file.",
    example='<param name="letters" value="$(eval [letter for letter in name])"/>',
    instead='<param name="letters" value="$(eval list(name))"/>',
    check=_check,
    problems=(
        "command-not-run",
        "launch-file-not-run",
        "eval-not-allowed",
        "xml-entity",
        "nested-too-deeply",
        "value-too-long",
    ),
)
