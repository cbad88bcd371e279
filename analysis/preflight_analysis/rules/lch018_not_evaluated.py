"""LCH018: what roslaunch would evaluate and the analysis does not."""

from preflight_analysis.evaluation.tree import Problem
from preflight_analysis.rules.problems import check_problems
from preflight_analysis.rules.rule import Rule


def _message(problem: Problem) -> str:
    data = problem.data
    if problem.kind == "xml-entity":
        return f"entity '&{data['name']};' is not expanded; values that use it are unknown here"
    if problem.kind == "eval-not-allowed":
        return f"$(eval {data['expression']}) is not evaluated: {data['message']}"
    return f"{data['what']} is not evaluated yet; what depends on it is unknown here"


RULE = Rule(
    id="LCH018",
    name="not-evaluated",
    severity="info",
    what="Says that something that `roslaunch` accepts is not evaluated here: a part of the language that is not "
    "supported, an `$(eval ...)` that would need to run code, an entity that a DOCTYPE defines.",
    why="Values that depend on it are unknown, nodes that need them are not run, and findings that would need them "
    "are left out. It is no error of the file.",
    example='<param name="now" value="$(eval __import__(\'time\').time())"/>',
    instead='<param name="now" value="$(arg now)"/>',
    check=check_problems(_message),
    problems=("not-supported", "eval-not-allowed", "xml-entity"),
)
