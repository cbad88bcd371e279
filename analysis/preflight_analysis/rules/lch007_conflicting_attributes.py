"""LCH007: attributes that exclude each other."""

from preflight_analysis.rules.problems import check_problems, quoted
from preflight_analysis.rules.rule import Rule

RULE = Rule(
    id="LCH007",
    name="conflicting-attributes",
    severity="error",
    what="Reports attributes of one element of which only one may be given.",
    why="`roslaunch` does not choose between them: it stops.",
    example='<param name="rate" value="30" textfile="rate.txt"/>',
    instead='<param name="rate" value="30"/>',
    check=check_problems(
        lambda problem: f"<{problem.data['tag']}> cannot have {quoted(problem.data['names'])} together"
    ),
    problems=("attributes-exclude",),
)
