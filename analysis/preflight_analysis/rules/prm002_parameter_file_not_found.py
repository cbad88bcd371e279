"""PRM002: a parameter file that is not there."""

from preflight_analysis.evaluation.problems import ParameterFileNotFound
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.rules.further_reading import PARAMETERS, ROSLAUNCH_ROSPARAM
from preflight_analysis.rules.missing_files import check_missing_files
from preflight_analysis.rules.rule import Rule

RULE = Rule(
    id="PRM002",
    name="parameter-file-not-found",
    effect="stops-launch",
    kind="absent",
    sometimes=(
        "misbehaves",
        Reason.NOT_HERE,
        Reason.MADE_BY_BUILD,
        Reason.MADE_ELSEWHERE,
        Reason.NOT_SET,
        Reason.ON_ROBOT,
        Reason.WHERE_STARTED,
        Reason.UNSEEN,
    ),
    what="Checks for a parameter file that does not exist: `<rosparam file=...>`, `<param textfile=...>`, `<param "
    "binfile=...>` or `<param from=...>`. The finding names the nearest file of the folder or package.",
    why="`roslaunch` stops and starts nothing. `ros2 launch` stops if the file is for a component. Other nodes "
    "start without the file, with their defaults.",
    example='<rosparam command="load" file="$(find camera)/config/camrea.yaml"/>',
    instead='<rosparam command="load" file="$(find camera)/config/camera.yaml"/>',
    references=(
        ROSLAUNCH_ROSPARAM,
        PARAMETERS,
    ),
    check=check_missing_files({ParameterFileNotFound: "parameter file"}),
    problems=(ParameterFileNotFound,),
    in_branches=True,
)
