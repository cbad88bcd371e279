"""Nodes and programs that newer releases of ROS have removed or replaced."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.generation import ROS1
from preflight_analysis.model.context import Context
from preflight_analysis.model.distributions import BEFORE_NOETIC


@dataclass(frozen=True, slots=True)
class Retired:
    """A node that should be another one. `executable` None: all of the package. `removed`: gone since that release."""

    package: str
    executable: str | None
    message: str
    source: str
    instead_package: str | None = None
    instead_executable: str | None = None
    removed: bool = False
    still_in: tuple[str, ...] = ()


_NODES = (
    Retired(
        "robot_state_publisher",
        "state_publisher",
        "executable 'state_publisher' is removed since ROS Noetic; use 'robot_state_publisher'",
        "https://docs.ros.org/en/latest/changelogs/robot_state_publisher/changelog.html (1.15.0)",
        instead_executable="robot_state_publisher",
        removed=True,
        still_in=BEFORE_NOETIC,
    ),
    Retired(
        "gazebo",
        None,
        "package 'gazebo' is removed since ROS Hydro; use 'gazebo_ros'",
        "https://github.com/ros-simulation/gazebo_ros_pkgs/pull/34",
        instead_package="gazebo_ros",
        removed=True,
    ),
    Retired(
        "tf",
        "static_transform_publisher",
        "'static_transform_publisher' of tf is deprecated since ROS Hydro; use that of tf2_ros, which publishes once "
        "and has no period",
        "http://wiki.ros.org/tf2/Migration",
    ),
    Retired(
        "xacro",
        "xacro.py",
        "'xacro.py' is removed since ROS Noetic; use 'xacro'",
        "https://github.com/ros/xacro/pull/239",
        instead_executable="xacro",
        removed=True,
        still_in=BEFORE_NOETIC,
    ),
    Retired(
        "robot_pose_ekf",
        None,
        "package 'robot_pose_ekf' is removed since ROS Melodic; use 'robot_localization'",
        "https://github.com/ros-planning/navigation/issues/701",
    ),
)
_BY_PACKAGE: Mapping[str, tuple[Retired, ...]] = {
    package: tuple(each for each in _NODES if each.package == package) for package in {each.package for each in _NODES}
}

RETIRED_IN = frozenset(_BY_PACKAGE)
"""The packages that these nodes are or were in."""


def retired(context: Context, node: LaunchNode) -> Iterator[Retired]:
    """What is known of a node of ROS 1 that should be another one. One that was removed is not there either."""
    return retired_program(context, node.package, node.executable, is_there=node.resolved.path is not None)


def retired_program(context: Context, package: str, executable: str, *, is_there: bool) -> Iterator[Retired]:
    """The same of a program by its package and name."""
    for each in _BY_PACKAGE.get(package, ()) if context.tree.generation == ROS1.number else ():
        there = context.environment.distro in each.still_in or is_there
        if each.executable in (None, executable) and not (each.removed and there):
            yield each


def was_removed(context: Context, node: LaunchNode) -> bool:
    """Whether it is missing for that."""
    return any(each.removed for each in retired(context, node))
