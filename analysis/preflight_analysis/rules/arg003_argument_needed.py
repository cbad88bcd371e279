"""ARG003: the file cannot be launched without an argument on the command line."""

from preflight_analysis.evaluation.problems import ArgumentNeeded
from preflight_analysis.rules.problems import check_problems
from preflight_analysis.rules.rule import Rule

RULE = Rule(
    id="ARG003",
    name="argument-needed",
    severity="info",
    what="Says that a launch file has to be given an argument on the command line.",
    why="That is how some files are meant to be used, so it is no error of the file; but what depends on the value is "
    "unknown until it is given.",
    example='<arg name="robot"/>',
    instead='<arg name="robot" default="turtle"/>',
    check=check_problems(
        lambda needed: f"argument '{needed.name}' has no default; launch with {needed.name}:=...", ArgumentNeeded
    ),
    problems=(ArgumentNeeded,),
)
