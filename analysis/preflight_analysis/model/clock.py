"""Whether there is a clock for nodes on simulated time."""

from __future__ import annotations

import os
from typing import NamedTuple

from preflight_analysis.evaluation.ros2.bridges import is_bridge
from preflight_analysis.evaluation.ros2.spawners import SPAWN
from preflight_analysis.evaluation.ros2.unknown_text import is_unknown
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.graph.model import Graph
from preflight_analysis.model.context import Context
from preflight_analysis.model.gazebo_bridges import is_unread
from preflight_analysis.model.gazebo_side import is_cut, worlds_of

_SIMULATORS = (
    "gazebo",
    "gzserver",
    "stage",
    "morse",
    "webots",
    "carla",
    "coppelia",
    "vrep",
    "airsim",
    "isaac",
    "mujoco",
)


_CLASSIC = frozenset({"gazebo", "gzserver"})
_INIT = "libgazebo_ros_init.so"
"""The plugin of Gazebo Classic that publishes `/clock` in ROS 2
(https://github.com/ros-simulation/gazebo_ros_pkgs/blob/ros2/gazebo_ros/src/gazebo_ros_init.cpp)."""


class Stopped(NamedTuple):
    """A simulator that the launch starts and whose time comes to no node: what is `lacking` for that, in words, and the
    node at which it is to be mended."""

    simulator: LaunchNode
    lacking: str
    at: LaunchNode


def publishes_clock(graph: Graph, node: LaunchNode) -> bool:
    """Whether a node publishes `/clock`, by what is known of it, or is a simulator or plays a bag with its time:
    neither does so before it runs for a while."""
    clock = graph.topics.get("/clock")
    if clock is not None and any(provider.node is node for provider in clock.providers):
        return True
    if _is_classic(node):
        return _INIT in node.args or is_unknown(node.args)
    name = f"{node.package}/{node.executable}".lower()
    is_simulator = any(word in name for word in _SIMULATORS) and (node.package, node.executable) not in SPAWN
    return is_simulator or "--clock" in node.args.split()


def has_clock(graph: Graph) -> bool:
    """Whether anything publishes `/clock`: a node of the launch, or what the settings say of other programs."""
    clock = graph.topics.get("/clock")
    known = graph.is_external("/clock") or (clock is not None and bool(clock.providers))
    return known or any(publishes_clock(graph, node) for node in graph.tree.nodes)


def stopped_clock(context: Context) -> Stopped | None:
    """The simulator that the launch starts, where all of its bridges are known and none has its time, or where it has
    no plugin that publishes that."""
    graph = context.graph
    if graph is None or has_clock(graph) or is_cut(context.tree):
        return None
    classic = next(filter(_is_classic, context.tree.nodes), None)
    if classic is not None:
        return Stopped(classic, f"Gazebo starts without '{_INIT}', which publishes '/clock'", classic)
    simulator = next((node for node, _, _ in worlds_of(context)), None)
    if simulator is None:
        return None
    bridging = [node for node in context.tree.nodes if is_bridge(node)]
    if any(node.unknowns or is_unknown(node.args) or is_unread(context, node) for node in bridging):
        return None
    return Stopped(simulator, "no bridge has Gazebo's '/clock'", bridging[0] if bridging else simulator)


def _is_classic(node: LaunchNode) -> bool:
    return node.kind == "process" and os.path.basename(node.executable) in _CLASSIC
