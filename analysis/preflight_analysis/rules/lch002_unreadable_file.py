"""LCH002: the launch file cannot be read."""

from preflight_analysis.evaluation.problems import NotTextFile, UnreadableFile
from preflight_analysis.rules.problems import check_problems
from preflight_analysis.rules.rule import Rule

RULE = Rule(
    id="LCH002",
    name="unreadable-file",
    severity="error",
    what="Reports a launch file that is missing, may not be read, is a folder, is binary or not UTF-8, or is larger "
    "than what is analysed.",
    why="Nothing can be said of its content, and in most of these cases `roslaunch` cannot read it either.",
    example="An editor saved the file as UTF-16.",
    instead="Save it as UTF-8.",
    check=check_problems(lambda file: f"cannot read '{file.path}': {file.reason}", UnreadableFile, NotTextFile),
    problems=(
        UnreadableFile,
        NotTextFile,
    ),
)
