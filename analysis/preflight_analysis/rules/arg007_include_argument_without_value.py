"""ARG007: an include's <arg> without a value."""

from preflight_analysis.evaluation.problems import IncludeArgumentWithoutValue
from preflight_analysis.findings.claim import Subject
from preflight_analysis.rules.further_reading import ROSLAUNCH_ARG, ROSLAUNCH_INCLUDE
from preflight_analysis.rules.problems import check_problems
from preflight_analysis.rules.rule import Rule

RULE = Rule(
    id="ARG007",
    name="include-argument-without-value",
    effect="stops-launch",
    kind="invalid",
    what="Checks for an `<arg>` in an `<include>` that has neither `value` nor `default`.",
    why="`roslaunch` stops. Naming an argument does not pass on its value.",
    example='<include file="camera.launch">\n  <arg name="rate"/>\n</include>',
    instead='<include file="camera.launch">\n  <arg name="rate" value="$(arg rate)"/>\n</include>',
    references=(
        ROSLAUNCH_INCLUDE,
        ROSLAUNCH_ARG,
    ),
    check=check_problems(
        lambda passed: f"argument '{passed.name}' is passed without a value",
        lambda passed: Subject("argument", passed.name),
        IncludeArgumentWithoutValue,
    ),
    problems=(IncludeArgumentWithoutValue,),
    in_branches=True,
)
