"""LCH006: an element lacks an attribute that it needs."""

from preflight_analysis.evaluation.tree import Problem
from preflight_analysis.rules.problems import check_problems
from preflight_analysis.rules.rule import Rule


def _message(problem: Problem) -> str:
    needed = [f"'{name}'" for name in problem.data["names"]]
    return f"<{problem.data['tag']}> needs {'one of ' if len(needed) > 1 else ''}{', '.join(needed)}"


RULE = Rule(
    id="LCH006",
    name="missing-attribute",
    severity="error",
    what="Reports an element without an attribute that it cannot do without.",
    why="`roslaunch` stops and starts nothing.",
    example='<node pkg="camera" name="camera"/>',
    instead='<node pkg="camera" type="driver" name="camera"/>',
    check=check_problems(_message),
    problems=("missing-attribute",),
)
