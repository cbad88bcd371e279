"""All frames of a launch."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import chain
from typing import Literal

from preflight_analysis.documents.disk import Disk
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.meanings import Known, KnownMeanings, known_of_nodes, params_of_nodes
from preflight_analysis.evaluation.partial_text import named
from preflight_analysis.evaluation.ros2.spawners import SPAWN
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree, Param
from preflight_analysis.frames.edges import (
    edges_of_node,
    edges_of_plugins,
    edges_of_robot,
    has_unnamed,
    is_state_publisher,
    prefix_of,
    space_of,
)
from preflight_analysis.frames.model import Edge, Frames, Use
from preflight_analysis.frames.uses import fixed_frame, mentions_of_node, uses_of_node, uses_of_sensors
from preflight_analysis.graph.model import Graph
from preflight_analysis.incremental.kept import Kept
from preflight_analysis.robot.of_launch import Robot, robots_of
from preflight_analysis.tracing.interface import Interface

_TF = ("tf", "tf_static")
_SIMULATORS = ("gazebo_ros", "ros_gz_sim", "ros_ign_gazebo", "webots_ros2_driver", "stage_ros", "mujoco_ros")
_SHOWN = 3


def build_frames(tree: LaunchTree, graph: Graph | None, meanings: KnownMeanings, disk: Disk, kept: Kept) -> Frames:
    """The frames of a launch as far as they are known. `graph` has what is known of the nodes, None before the runs."""
    tree = graph.tree if graph is not None else tree
    nodes, generation = tree.nodes_and_simulated, tree.generation
    interfaces: Sequence[Interface | None] = graph.interfaces if graph is not None else (None,) * len(nodes)
    known = known_of_nodes(tree, meanings, kept)
    params = params_of_nodes(tree, known, kept)
    edges = kept.each_row(edges_of_node, (nodes, interfaces, known, params), generation, _has_prefix(tree, kept))
    uses = kept.each_row(uses_of_node, (nodes, interfaces, known, params), generation, meanings)
    unnamed = kept.each_row(has_unnamed, (nodes, interfaces, known, params))
    silent = kept.each_row(_gap, (nodes, interfaces, known, unnamed, edges))
    mentions = kept.each_row(mentions_of_node, (nodes, known, params), generation)
    simulates = _simulates(nodes)
    simulated = _of_sensors(tree) if simulates else ()
    shown = (use for node in nodes if (use := fixed_frame(node, disk, generation)) is not None)
    return Frames(
        (*_of_robots(tree, meanings.distro), *chain.from_iterable(edges)),
        (*chain.from_iterable(uses), *simulated, *shown),
        tuple(chain.from_iterable(mentions)),
        tuple(_gaps(tree, nodes, silent)),
        simulates,
    )


def _has_prefix(tree: LaunchTree, kept: Kept) -> bool:
    """Whether ROS 1's `tf_prefix` is set, which each node heeds or not."""
    return not tree.ros.own_parameters and any(kept.each(_is_prefix, tree.all_params))


def _is_prefix(param: Param) -> bool:
    return names.leaf(param.name) == "tf_prefix"


def _of_robots(tree: LaunchTree, distro: str | None) -> Iterator[Edge]:
    published: set[int] = set()
    for node in tree.nodes:
        robot = _robot_of(tree, node) if is_state_publisher(node) else None
        if robot is not None:
            published.add(id(robot))
            space = space_of(node, tree.generation)
            yield from edges_of_robot(robot, node, prefix_of(node, tree), space, distro)
            yield from edges_of_plugins(robot, node, space)
    for robot in robots_of(tree):
        if id(robot) not in published and not published:
            yield from edges_of_robot(robot, None, "", "", distro)


def _of_sensors(tree: LaunchTree) -> Iterator[Use]:
    for node in tree.nodes:
        robot = _robot_of(tree, node) if is_state_publisher(node) else None
        if robot is not None:
            yield from uses_of_sensors(robot, node, space_of(node, tree.generation))


def _simulates(nodes: Sequence[LaunchNode]) -> bool:
    """Whether the launch starts a simulator, or puts a robot into one."""
    return any(node.package in _SIMULATORS or (node.package, node.executable) in SPAWN for node in nodes)


def _robot_of(tree: LaunchTree, publisher: LaunchNode) -> Robot | None:
    """The robot whose description a robot_state_publisher has: in ROS 1 it searches upwards for it."""
    robots = [robot for robot in robots_of(tree) if any(node is publisher for node in robot.nodes)]
    return max(robots, key=lambda robot: len(names.parent(robot.param.name)), default=None)


_Gap = Literal["unread", "unseen", "unclear"]


def _gaps(tree: LaunchTree, nodes: Sequence[LaunchNode], silent: Sequence[_Gap | None]) -> Iterator[str]:
    """Why there may be more frames than are known."""
    if not tree.complete:
        yield "parts of the launch are unresolved"
    found: dict[_Gap, list[str]] = {"unread": [], "unseen": [], "unclear": []}
    for node, gap in zip(nodes, silent, strict=True):
        robot = _robot_of(tree, node) if gap == "unread" else None
        if robot is not None and robot.description.lacks:
            yield f"the robot description of {_named(node)} is incomplete: {named(robot.description.lacks)}"
        elif gap is not None and (robot is None or not robot.description.is_whole):
            found[gap].append(_named(node))
    unread, unseen, unclear = found.values()
    if unread:
        yield f"the robot description of {_some(unread)} is not known"
    if unclear:
        yield f"the frames that {_some(unclear)} broadcasts are not known"
    if unseen:
        yield f"{len(unseen)} of {len(nodes)} nodes are not analysed: {_some(unseen)}"
    if _simulates(nodes):
        yield "a simulator may broadcast more"


def _gap(
    node: LaunchNode, interface: Interface | None, about: Known | None, has_others: bool, found: tuple[Edge, ...]
) -> _Gap | None:
    """Why a node may broadcast more; `unread` of one that publishes a robot, whatever is known of that."""
    if is_state_publisher(node):
        return "unread"
    if has_others:
        return "unclear"
    if found or (about is not None and about.is_used):
        return None
    if interface is None or not interface.known:
        return "unseen"
    if any(end.role == "publisher" and names.leaf(end.name) in _TF for end in interface.endpoints):
        return "unclear"
    observed = interface.source in ("trace", "similar", "source")
    return "unseen" if observed and not interface.likely_complete else None


def _named(node: LaunchNode) -> str:
    return node.name or node.executable or node.kind


def _some(found: Sequence[str]) -> str:
    return ", ".join(found[:_SHOWN]) + (f" and {len(found) - _SHOWN} more" if len(found) > _SHOWN else "")
