"""Whether ROS itself is there: where it is not, its packages, programs and modules are missing by nature."""

from preflight_analysis.rules.rule import Context

_CORE = frozenset({"rclpy", "rclcpp", "launch_ros"})
"""Packages of which each installation of ROS 2 has at least one."""


def has_ros(context: Context) -> bool:
    """Whether the ROS that the launch file is for is installed, and not only a workspace there."""
    if not context.tree.ros.ament:
        return context.environment.python is not None
    return not _CORE.isdisjoint(context.environment.packages)
