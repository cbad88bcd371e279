"""LCH014: an include of a file that cannot be read as a launch file."""

from preflight_analysis.evaluation.problems import UnreadableInclude
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.rules.further_reading import LARGE_PROJECTS, ROSLAUNCH_INCLUDE
from preflight_analysis.rules.missing_files import check_unreadable_files
from preflight_analysis.rules.rule import Rule

RULE = Rule(
    id="LCH014",
    name="include-unreadable",
    effect="stops-launch",
    kind="invalid",
    sometimes=("misbehaves", Reason.NOT_SET),
    what="Checks for an `<include>` of a file that exists but cannot be used: a folder, binary, too large, without "
    "permission, or no launch file.",
    why="The launcher stops and starts nothing.",
    example='<include file="$(find camera)/launch"/>',
    instead='<include file="$(find camera)/launch/camera.launch"/>',
    references=(
        ROSLAUNCH_INCLUDE,
        LARGE_PROJECTS,
    ),
    check=check_unreadable_files(UnreadableInclude, "included file"),
    problems=(UnreadableInclude,),
    in_branches=True,
)
