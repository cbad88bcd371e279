"""PRM003: a parameter file that cannot be read."""

from preflight_analysis.evaluation.problems import UnreadableParameterFile
from preflight_analysis.rules.files import check_unreadable_files
from preflight_analysis.rules.rule import Rule

RULE = Rule(
    id="PRM003",
    name="parameter-file-unreadable",
    severity="error",
    what="Reports a parameter file that exists but is a folder, is not permitted to be read, too large, or not text "
    "where text is needed.",
    why="`roslaunch` stops and starts nothing. `ros2 launch` starts a node without the file, and stops at that of a "
    "component: the first is a warning, and information where the path is an argument that is empty.",
    example='<rosparam command="load" file="$(find camera)/config"/>',
    instead='<rosparam command="load" file="$(find camera)/config/camera.yaml"/>',
    check=check_unreadable_files(UnreadableParameterFile, "parameter file"),
    problems=(UnreadableParameterFile,),
    in_branches=True,
)
