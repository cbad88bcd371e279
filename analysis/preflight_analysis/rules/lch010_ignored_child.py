"""LCH010: an element that roslaunch drops where it stands."""

from preflight_analysis.findings.claim import Subject
from preflight_analysis.launch.problems import IgnoredChild
from preflight_analysis.rules.further_reading import ROSLAUNCH_INCLUDE
from preflight_analysis.rules.problems import check_problems
from preflight_analysis.rules.rule import Rule

RULE = Rule(
    id="LCH010",
    name="ignored-child",
    effect="no-effect",
    kind="invalid",
    what="Checks for an element other than `<arg>` and `<env>` in an `<include>`.",
    why="`roslaunch` ignores it and prints one line on standard error. The remap or parameter has no effect.",
    example='<include file="camera.launch">\n  <remap from="image" to="front/image"/>\n</include>',
    instead='<group>\n  <remap from="image" to="front/image"/>\n  <include file="camera.launch"/>\n</group>',
    references=(ROSLAUNCH_INCLUDE,),
    check=check_problems(
        lambda child: f"<{child.tag}> has no effect in <{child.parent}>: roslaunch ignores it",
        lambda child: Subject("element"),
        IgnoredChild,
    ),
    problems=(IgnoredChild,),
)
