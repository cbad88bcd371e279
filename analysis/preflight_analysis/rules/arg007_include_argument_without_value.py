"""ARG007: an include's <arg> without a value."""

from preflight_analysis.evaluation.problems import IncludeArgumentWithoutValue
from preflight_analysis.rules.problems import check_problems
from preflight_analysis.rules.rule import Rule

RULE = Rule(
    id="ARG007",
    name="include-argument-without-value",
    severity="error",
    what="Reports an `<arg>` in an `<include>` that has neither `value` nor `default`.",
    why="`roslaunch` stops. An argument of the same name is not passed on by naming it.",
    example='<include file="camera.launch">\n  <arg name="rate"/>\n</include>',
    instead='<include file="camera.launch">\n  <arg name="rate" value="$(arg rate)"/>\n</include>',
    check=check_problems(
        lambda passed: f"argument '{passed.name}' is passed without a value", IncludeArgumentWithoutValue
    ),
    problems=(IncludeArgumentWithoutValue,),
    in_branches=True,
)
