"""LCH001: the file is not well-formed XML or YAML, or no Python."""

from preflight_analysis.evaluation.problems import MalformedPython, MalformedXml, MalformedYaml
from preflight_analysis.rules.problems import check_problems
from preflight_analysis.rules.rule import Rule

RULE = Rule(
    id="LCH001",
    name="malformed-xml",
    severity="error",
    what="Reports a launch file that is not well-formed XML (or YAML or Python, ROS 2), at the place that "
    "has to be changed.",
    why="`roslaunch` stops with `Invalid roslaunch XML syntax` and starts nothing, neither from this file nor from "
    "those that include it. What can still be read of the file is checked nevertheless.",
    example='<launch>\n  <node pkg="camera" type="driver" name="camera">\n</launch>',
    instead='<launch>\n  <node pkg="camera" type="driver" name="camera"/>\n</launch>',
    check=check_problems(lambda malformed: malformed.message, MalformedXml, MalformedYaml, MalformedPython),
    problems=(
        MalformedXml,
        MalformedYaml,
        MalformedPython,
    ),
    in_branches=True,
)
