"""What rules about robot descriptions share."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation import names
from preflight_analysis.findings.finding import Related
from preflight_analysis.model.context import Context
from preflight_analysis.robot.of_launch import Described, Robot, robots_of
from preflight_analysis.robot.sources import Attribute, argument_place, place_of

LENIENT_ROS2_CONTROL = ("foxy", "galactic", "humble", "iron")
"""Distributions whose ros2_control does not compare `<ros2_control>` with the joints of the robot."""


def robots(context: Context) -> Iterator[Robot]:
    """The robots of the launch whose URDF is known as a whole."""
    return (robot for robot in robots_of(context.tree) if robot.description.is_whole)


def robots_in_part(context: Context) -> Iterator[Robot]:
    """The same with those that lack packages: for what is there, not for what is not."""
    return (robot for robot in robots_of(context.tree) if robot.description.kind == "robot")


def written(
    context: Context, robot: Described, tag: str, attribute: str, value: str, within: str = ""
) -> tuple[Location, tuple[Related, ...]]:
    """Where an attribute of the description is written, else the argument of a macro that it comes from, and the
    parameter that holds the description; that parameter alone where the place is not known."""
    parameter = robot.param.place
    place = place_of(robot, context.disk, context.environment, Attribute(tag, attribute, value, within))
    if place is None:
        place = argument_place(robot, context.disk, context.environment, value)
    if place is None:
        return parameter, ()
    return place, (Related(f"{names.leaf(robot.param.name)} of this launch", parameter),)
