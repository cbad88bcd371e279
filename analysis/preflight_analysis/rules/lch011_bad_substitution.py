"""LCH011: a substitution that cannot be made."""

from collections.abc import Iterator

from preflight_analysis.evaluation.tree import Problem
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.nearest import did_you_mean, nearest
from preflight_analysis.rules.problems import problem_finding, problems_of
from preflight_analysis.rules.rule import Context, Rule

_RENAMED = {
    **{"arg": "var", "find": "find-pkg-share", "optenv": "env", "env-default": "env"},
    **{"FindPackage": "find-pkg-share", "FindPackageShare": "find-pkg-share", "FindPackagePrefix": "find-pkg-prefix"},
    **{"LaunchConfiguration": "var", "EnvironmentVariable": "env", "PythonExpression": "eval"},
    **{"PathJoinSubstitution": "path-join", "ThisLaunchFileDir": "dirname", "ExecutableInPackage": "exec-in-pkg"},
}
"""What substitutions of ROS 1, and those of Python launch files, are called in XML and YAML of ROS 2."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(rule, context):
        message = _message(problem)
        command, known = str(problem.data.get("command", "")), problem.data.get("commands", ())
        near = nearest(command, known) if command else None
        near = _RENAMED.get(command, near) if context.tree.generation == 2 and known else near
        if near is not None:
            message += did_you_mean(near)
        yield problem_finding(rule, problem, message)


def _message(problem: Problem) -> str:
    if problem.kind == "eval-error":
        return f"$(eval {problem.data['expression']}) fails: {problem.data['message']}"
    return str(problem.data["message"])


RULE = Rule(
    id="LCH011",
    name="bad-substitution",
    severity="error",
    what="Reports a `$(...)` that is not complete, of an unknown kind, or an `$(eval ...)` that fails.",
    why="`roslaunch` stops. An `$(eval ...)` must be the whole attribute.",
    example='<param name="rate" value="$(args rate)"/>',
    instead='<param name="rate" value="$(arg rate)"/>',
    check=_check,
    problems=("bad-substitution", "eval-error"),
)
