"""LCH011: a substitution that cannot be made."""

from preflight_analysis.evaluation.tree import Problem
from preflight_analysis.rules.problems import check_problems
from preflight_analysis.rules.rule import Rule


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
    check=check_problems(_message),
    problems=("bad-substitution", "eval-error"),
)
