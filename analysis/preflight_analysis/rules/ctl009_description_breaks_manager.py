"""CTL009: a robot description that gazebo_ros2_control cannot hand to its controller manager (ROS 2).

The plugin passes the text as `--param robot_description:=TEXT` (gazebo_ros2_control_plugin.cpp of
https://github.com/ros-controls/gazebo_ros2_control, humble and iron), and rcl reads it as YAML: `Couldn't parse
parameter override rule`. See https://github.com/ros-controls/gazebo_ros2_control/issues/295.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from preflight_analysis.documents.span import Location, Span
from preflight_analysis.environment.distribution import known_distributions
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.distributions import otherwise_in
from preflight_analysis.model.problems import include_chain
from preflight_analysis.model.robots import robots
from preflight_analysis.robot.of_launch import Robot
from preflight_analysis.robot.sources import files_of
from preflight_analysis.rules.further_reading import ROS2_CONTROL_GAZEBO
from preflight_analysis.rules.rule import Rule

_AFFECTED = ("humble", "iron", None)
_NOT_AFFECTED = tuple(name for name in known_distributions(2) if name not in _AFFECTED)
_PLUGIN = "gazebo_ros2_control"
_NOT_PLAIN = re.compile(r":(?=\s)|(?<=\s)#")
"""What ends a plain scalar of YAML, as which the text of a description is read."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    if context.environment.distro not in _AFFECTED:
        return
    for robot in robots(context):
        if not any(_PLUGIN in plugin.filename for plugin in robot.description.plugins):
            continue
        found = _NOT_PLAIN.search(robot.text.strip())
        if found is None:
            continue
        line = _line(robot.text.strip(), found.start())
        place = _written(context, robot, line)
        sign = f"'{found[0]} '" if found[0] == ":" else f"' {found[0]}'"
        yield rule.claim(
            f"gazebo_ros2_control cannot pass on a description with {sign} in it: '{line}'",
            place or robot.param.place,
            subject=Subject("text", line),
            doubts=otherwise_in(context.environment, _NOT_AFFECTED),
            related=() if place is None else include_chain(robot.param.origin),
        )


def _line(text: str, at: int) -> str:
    """The line of a text around an offset, without blanks around it."""
    start, end = text.rfind("\n", 0, at) + 1, text.find("\n", at)
    return text[start : end if end >= 0 else len(text)].strip()


def _written(context: Context, robot: Robot, line: str) -> Location | None:
    """Where the files of the description have a line, if that is one place."""
    found: list[Location] = []
    for file in files_of(robot, context.disk, context.environment):
        text = file.document.text
        if text.count(line) == 1:
            start = text.index(line)
            found.append(file.document.location(Span(start, start + len(line))))
    return found[0] if len(found) == 1 else None


RULE = Rule(
    id="CTL009",
    name="description-breaks-manager",
    effect="breaks",
    kind="invalid",
    always=(Reason.LIBRARY,),
    sometimes=(Reason.MEANT_FOR_OTHER,),
    what="Checks for a robot description with the plugin `gazebo_ros2_control` that has `: ` or ` #` in it. Humble "
    "and Iron read it as YAML.",
    why="The plugin reports `Couldn't parse parameter override rule` and starts no controller manager. Spawners wait "
    "for `/controller_manager`.",
    example="<!-- TODO: measure the mass -->",
    instead="<!-- TODO measure the mass -->",
    references=(ROS2_CONTROL_GAZEBO,),
    generations=(2,),
    check=_check,
)
