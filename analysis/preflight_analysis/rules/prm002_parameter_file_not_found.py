"""PRM002: a parameter file that is not there."""

from preflight_analysis.evaluation.problems import ParameterFileNotFound
from preflight_analysis.rules.files import check_missing_files
from preflight_analysis.rules.rule import Rule

RULE = Rule(
    id="PRM002",
    name="parameter-file-not-found",
    severity="error",
    what="Reports a `<rosparam file=...>`, `<param textfile=...>`, `<param binfile=...>` or `<param from=...>` whose "
    "file does not exist, and names the nearest one of that folder or package. One in a top folder that this machine "
    "lacks (`/ws/src/...` of a container), or in the folder where the launch is started (`$(env PWD)`), is "
    "information.",
    why="`roslaunch` stops and starts nothing. `ros2 launch` stops at that of a component; it starts other nodes "
    "without the file, on their defaults: then it is a warning.",
    example='<rosparam command="load" file="$(find camera)/config/camrea.yaml"/>',
    instead='<rosparam command="load" file="$(find camera)/config/camera.yaml"/>',
    check=check_missing_files({ParameterFileNotFound: "parameter file"}),
    problems=(ParameterFileNotFound,),
    in_branches=True,
)
