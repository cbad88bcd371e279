"""ARG006: a value is passed for an argument that the file fixes."""

from preflight_analysis.evaluation.problems import FixedArgument
from preflight_analysis.findings.claim import Subject
from preflight_analysis.rules.further_reading import ROSLAUNCH_ARG
from preflight_analysis.rules.problems import check_problems
from preflight_analysis.rules.rule import Rule

RULE = Rule(
    id="ARG006",
    name="argument-fixed",
    effect="stops-launch",
    kind="conflict",
    what="Checks for an argument that is passed to a file which fixes it with `value=`.",
    why="`roslaunch` stops. Only arguments that are declared with `default=`, or without a value, can be set from "
    "outside.",
    example='<!-- in camera.launch: <arg name="rate" value="30"/> -->\n<include file="camera.launch">\n'
    '  <arg name="rate" value="10"/>\n</include>',
    instead='<!-- in camera.launch: <arg name="rate" default="30"/> -->\n<include file="camera.launch">\n'
    '  <arg name="rate" value="10"/>\n</include>',
    references=(ROSLAUNCH_ARG,),
    check=check_problems(
        lambda fixed: f"argument '{fixed.name}' cannot be passed: the included file fixes it with value=",
        lambda fixed: Subject("argument", fixed.name),
        FixedArgument,
    ),
    problems=(FixedArgument,),
    in_branches=True,
)
