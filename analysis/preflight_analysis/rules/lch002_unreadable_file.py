"""LCH002: the launch file cannot be read."""

from preflight_analysis.evaluation.problems import NotTextFile, UnreadableFile
from preflight_analysis.findings.claim import Subject
from preflight_analysis.rules.further_reading import ROSLAUNCH, XML_STANDARD
from preflight_analysis.rules.problems import check_problems
from preflight_analysis.rules.rule import Rule

RULE = Rule(
    id="LCH002",
    name="unreadable-file",
    effect="stops-launch",
    kind="invalid",
    what="Checks for a launch file that cannot be read: missing, without permission, a folder, binary, not UTF-8, "
    "or too large.",
    why="The content cannot be checked. In most of these cases `roslaunch` cannot read the file either.",
    example="An editor saved the file as UTF-16.",
    instead="Save it as UTF-8.",
    references=(
        XML_STANDARD,
        ROSLAUNCH,
    ),
    check=check_problems(
        lambda file: f"cannot read '{file.path}': {file.reason}",
        lambda file: Subject("file", file.path),
        UnreadableFile,
        NotTextFile,
    ),
    problems=(
        UnreadableFile,
        NotTextFile,
    ),
)
