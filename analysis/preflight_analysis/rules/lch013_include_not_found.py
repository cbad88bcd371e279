"""LCH013: an include, or a launch by a process, of a file that is not there."""

from preflight_analysis.evaluation.problems import IncludeNotFound, LaunchedFileNotFound
from preflight_analysis.rules.files import check_missing_files
from preflight_analysis.rules.rule import Rule

RULE = Rule(
    id="LCH013",
    name="include-not-found",
    severity="error",
    what="Reports an `<include>` of a file that does not exist, and names the nearest file of that folder or package. "
    "Where a process launches it (`ros2 launch PACKAGE FILE`) this is a warning, as the rest goes on without it.",
    why="`roslaunch` stops and starts nothing, however deep the include stands. A relative path is looked up from the "
    "folder in which `roslaunch` is started, not from that of the file.",
    example='<include file="$(find camera)/launch/camrea.launch"/>',
    instead='<include file="$(find camera)/launch/camera.launch"/>',
    check=check_missing_files({IncludeNotFound: "included file", LaunchedFileNotFound: "launched file"}),
    problems=(IncludeNotFound, LaunchedFileNotFound),
)
