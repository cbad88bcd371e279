"""LCH014: an include of a file that cannot be read as a launch file."""

from preflight_analysis.evaluation.problems import UnreadableInclude
from preflight_analysis.rules.files import check_unreadable_files
from preflight_analysis.rules.rule import Rule

RULE = Rule(
    id="LCH014",
    name="include-unreadable",
    severity="error",
    what="Reports an `<include>` of a file that exists but is a folder, binary, too large, not permitted to be read, "
    "or no launch file.",
    why="`roslaunch` stops and starts nothing.",
    example='<include file="$(find camera)/launch"/>',
    instead='<include file="$(find camera)/launch/camera.launch"/>',
    check=check_unreadable_files(UnreadableInclude, "included file"),
    problems=(UnreadableInclude,),
    in_branches=True,
)
