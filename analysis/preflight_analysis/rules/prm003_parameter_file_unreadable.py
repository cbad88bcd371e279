"""PRM003: a parameter file that cannot be read."""

from preflight_analysis.evaluation.problems import UnreadableParameterFile
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.rules.further_reading import PARAMETERS, ROSLAUNCH_ROSPARAM
from preflight_analysis.rules.missing_files import check_unreadable_files
from preflight_analysis.rules.rule import Rule

RULE = Rule(
    id="PRM003",
    name="parameter-file-unreadable",
    effect="stops-launch",
    kind="invalid",
    sometimes=("misbehaves", Reason.NOT_SET),
    what="Checks for a parameter file that exists but cannot be read: a folder, without permission, too large, or "
    "not text.",
    why="`roslaunch` stops and starts nothing. `ros2 launch` stops if the file is for a component, and starts other "
    "nodes without the file.",
    example='<rosparam command="load" file="$(find camera)/config"/>',
    instead='<rosparam command="load" file="$(find camera)/config/camera.yaml"/>',
    references=(
        ROSLAUNCH_ROSPARAM,
        PARAMETERS,
    ),
    check=check_unreadable_files(UnreadableParameterFile, "parameter file"),
    problems=(UnreadableParameterFile,),
    in_branches=True,
)
