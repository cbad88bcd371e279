"""ARG003: the file cannot be launched without an argument on the command line."""

from preflight_analysis.evaluation.problems import ArgumentNeeded
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.rules.further_reading import LAUNCH_SUBSTITUTIONS, ROSLAUNCH_ARG
from preflight_analysis.rules.problems import check_problems
from preflight_analysis.rules.rule import Rule

RULE = Rule(
    id="ARG003",
    name="argument-needed",
    effect="stops-launch",
    kind="absent",
    always=(Reason.NOT_SET,),
    what="Checks for a launch file that requires an argument on the command line.",
    why="Some files are meant to be used in this way, so this is not an error. What depends on the value is unresolved "
    "until the argument is given.",
    example='<arg name="robot"/>',
    instead='<arg name="robot" default="turtle"/>',
    references=(
        ROSLAUNCH_ARG,
        LAUNCH_SUBSTITUTIONS,
    ),
    settings=("roots",),
    check=check_problems(
        lambda needed: f"argument '{needed.name}' has no default; launch with {needed.name}:=...",
        lambda needed: Subject("argument", needed.name),
        ArgumentNeeded,
    ),
    problems=(ArgumentNeeded,),
)
