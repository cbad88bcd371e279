"""Whether there is a clock for nodes on simulated time."""

from __future__ import annotations

from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.graph.model import Graph

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


def publishes_clock(graph: Graph, node: LaunchNode) -> bool:
    """Whether a node publishes `/clock`, by what is known of it, or is a simulator or plays a bag with its time:
    neither does so before it runs for a while."""
    clock = graph.topics.get("/clock")
    if clock is not None and any(provider.node is node for provider in clock.providers):
        return True
    name = f"{node.package}/{node.executable}".lower()
    return any(word in name for word in _SIMULATORS) or "--clock" in node.args.split()


def has_clock(graph: Graph) -> bool:
    """Whether anything publishes `/clock`: a node of the launch, or what the settings say of other programs."""
    clock = graph.topics.get("/clock")
    known = graph.is_external("/clock") or (clock is not None and bool(clock.providers))
    return known or any(publishes_clock(graph, node) for node in graph.tree.nodes)
