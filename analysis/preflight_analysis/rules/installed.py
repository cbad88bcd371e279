"""What is missing on this machine: ROS itself, a package."""

from preflight_analysis.findings.lack import Lack
from preflight_analysis.rules.rule import Context

_CORE = frozenset({"rclpy", "rclcpp", "launch_ros"})
"""Packages of which each installation of ROS 2 has at least one."""


def has_ros(context: Context) -> bool:
    """Whether the ROS that the launch file is for is installed, and not only a workspace there."""
    if not context.tree.ros.ament:
        return context.environment.python is not None
    return not _CORE.isdisjoint(context.environment.packages)


def lack_of_package(name: str) -> Lack:
    """A package that is neither installed nor in the workspace."""
    return Lack("package", name)
