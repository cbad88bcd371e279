"""LCH010: an element that roslaunch drops where it stands."""

from preflight_analysis.launch.problems import IgnoredChild
from preflight_analysis.rules.problems import check_problems
from preflight_analysis.rules.rule import Rule

RULE = Rule(
    id="LCH010",
    name="ignored-child",
    severity="warning",
    what="Reports an element in an `<include>` other than `<arg>` and `<env>`.",
    why="`roslaunch` drops it with one line on standard error: the remap or parameter has no effect.",
    example='<include file="camera.launch">\n  <remap from="image" to="front/image"/>\n</include>',
    instead='<group>\n  <remap from="image" to="front/image"/>\n  <include file="camera.launch"/>\n</group>',
    check=check_problems(
        lambda child: f"<{child.tag}> has no effect in <{child.parent}>: roslaunch drops it", IgnoredChild
    ),
    problems=(IgnoredChild,),
)
