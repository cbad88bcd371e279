"""LCH003: the document element is not <launch>."""

from preflight_analysis.evaluation.problems import NoLaunchElement
from preflight_analysis.findings.claim import Subject
from preflight_analysis.rules.further_reading import LAUNCH_XML_DESIGN, ROSLAUNCH
from preflight_analysis.rules.problems import check_problems
from preflight_analysis.rules.rule import Rule


def _message(root: NoLaunchElement) -> str:
    tag = root.tag
    if tag == "launch":
        return "<launch> inside of <launch>; roslaunch allows only one"
    return f"root element is <{tag}>, not <launch>" if tag else "the <launch> element is missing"


RULE = Rule(
    id="LCH003",
    name="no-launch-element",
    effect="stops-launch",
    kind="invalid",
    what="Checks for a launch file without a `<launch>` element around its content, or with several.",
    why="`roslaunch` stops with `No root <launch> tag`.",
    example='<node pkg="camera" type="driver" name="camera"/>',
    instead='<launch>\n  <node pkg="camera" type="driver" name="camera"/>\n</launch>',
    references=(
        ROSLAUNCH,
        LAUNCH_XML_DESIGN,
    ),
    check=check_problems(_message, lambda root: Subject("element", root.tag or ""), NoLaunchElement),
    problems=(NoLaunchElement,),
)
