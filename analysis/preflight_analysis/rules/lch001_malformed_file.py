"""LCH001: the file is not well-formed XML or YAML, or no Python."""

from preflight_analysis.evaluation.problems import MalformedPython, MalformedXml, MalformedYaml
from preflight_analysis.findings.claim import Subject
from preflight_analysis.rules.further_reading import FORMATS, ROSLAUNCH, XML_STANDARD
from preflight_analysis.rules.problems import check_problems
from preflight_analysis.rules.rule import Rule

RULE = Rule(
    id="LCH001",
    name="malformed-file",
    effect="stops-launch",
    kind="invalid",
    what="Checks for a launch file that is not well-formed XML, YAML or Python. The finding is at the place that "
    "has to be changed.",
    why="`roslaunch` stops with `Invalid roslaunch XML syntax` and starts nothing. Files that include this one do "
    "not start either. The readable part of the file is still checked.",
    example='<launch>\n  <node pkg="camera" type="driver" name="camera">\n</launch>',
    instead='<launch>\n  <node pkg="camera" type="driver" name="camera"/>\n</launch>',
    references=(
        XML_STANDARD,
        ROSLAUNCH,
        FORMATS,
    ),
    check=check_problems(
        lambda malformed: malformed.message,
        lambda malformed: Subject("file"),
        MalformedXml,
        MalformedYaml,
        MalformedPython,
        quotes=True,
    ),
    problems=(
        MalformedXml,
        MalformedYaml,
        MalformedPython,
    ),
    in_branches=True,
)
