"""FRM005: frames that a node uses together, in two trees that nothing joins."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations

from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.frames.model import Frames, Use
from preflight_analysis.frames.uses import OF_LOCALIZATION
from preflight_analysis.graph.model import Graph
from preflight_analysis.model.context import Context
from preflight_analysis.model.frames import frames_of, in_words, place_of_edge, place_of_use
from preflight_analysis.model.missing_frames import is_base_beside
from preflight_analysis.model.problems import include_chain
from preflight_analysis.rules.further_reading import FRAMES, TF2
from preflight_analysis.rules.rule import Rule

_MOST = 20
"""Frames that a node uses; whoever has more of them names them in lists of all frames."""
_SENSORS = ("sensor_msgs/",)
_OF_BASES = (
    "frames '{child}' and '{root}' are in trees that nothing joins: {node}{by} publishes the former below "
    "'{parent}', the robot description begins with '{root}'{aside}"
)


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    yield from _of_bases(rule, context)
    frames = frames_of(context)
    if not frames.complete or context.graph is None:
        return
    mentioned = {mention.frame for mention in frames.mentions}
    told: set[tuple[str, str]] = set()
    for uses in _together(frames, context.graph):
        for one, other in combinations(uses[:_MOST], 2):
            trees = frames.trees(one.space)
            if one.space != other.space or trees[one.frame] == trees[other.frame]:
                continue
            ends = (trees[one.frame], trees[other.frame])
            if mentioned & {one.frame, other.frame, *ends} or ends in told or ends[::-1] in told:
                continue
            told.add(ends)
            whole = any(_is_whole(frames, one.space, tree) for tree in ends)
            said = "frames '{one}' and '{other}' are in trees that nothing joins: {node}{does}; {does_other}"
            values = {"one": one.frame, "other": other.frame, "does_other": other.does, **in_words(one)}
            yield rule.claim(
                say(said, **values),
                place_of_use(context, other),
                subject=Subject("frame", other.frame),
                doubts=doubts(OUTSIDE=not whole),
                related=(
                    *(
                        Related(f"'{use.frame}' below '{path[-1].parent}'", place_of_edge(context, path[0]))
                        for use in (one, other)
                        if (path := frames.path(use.space, use.frame))
                    ),
                    *(include_chain(other.node.origin) if other.param is None else ()),
                ),
            )


def _of_bases(rule: Rule, context: Context) -> Iterator[Finding]:
    """Localization that publishes a base of the robot that the description does not have."""
    frames = frames_of(context)
    for edge in frames.edges:
        root = frames.robot_root(edge.space)
        if edge.how != "knowledge" or not edge.sure or root is None or not is_base_beside(edge.child, root):
            continue
        trees = frames.trees(edge.space)
        if edge.parent.rpartition("/")[2] not in OF_LOCALIZATION or trees[edge.child] == trees[root]:
            continue
        node = edge.node.name if edge.node is not None else ""
        values = {"node": node, "by": edge.by.removeprefix(node), "child": edge.child, "parent": edge.parent}
        yield rule.claim(
            say(_OF_BASES, root=root, aside=f"; {frames.gaps[0]}" if frames.gaps else "", **values),
            place_of_edge(context, edge),
            subject=Subject("frame", edge.child),
            doubts=doubts(PARTLY_READ=not frames.complete, NOT_ANALYSED=not frames.complete),
        )


def _together(frames: Frames, graph: Graph) -> Iterator[list[Use]]:
    """Frames that one transform needs, or one node: those that it looks up, and those of the sensors that it hears."""
    known = [use for use in frames.uses if use.sure and use.frame in frames.names(use.space)]
    by_call: dict[tuple[int, str], list[Use]] = {}
    by_node: dict[int, list[Use]] = {}
    for use in known:
        if use.looked_up and use.what.startswith("parameter "):
            by_node.setdefault(id(use.node), []).append(use)
        elif use.looked_up:
            by_call.setdefault((id(use.node), use.what), []).append(use)
    yield from by_call.values()
    feeds = _feeds(graph)
    sensors: dict[int, list[Use]] = {}
    for use in known:
        if use.of_sensor and use.robot is None:
            sensors.setdefault(id(use.node), []).append(use)
    for node, uses in by_node.items():
        yield uses + [use for feeder in feeds.get(node, ()) for use in sensors.get(feeder, ())]


def _feeds(graph: Graph) -> Mapping[int, list[int]]:
    """The nodes from which each node has messages of sensors."""
    found: dict[int, list[int]] = {}
    for channel in graph.topics.values():
        of_sensor = (end for end in channel.providers if (end.endpoint.type or "").startswith(_SENSORS))
        for provider in of_sensor:
            for consumer in channel.consumers:
                found.setdefault(id(consumer.node), []).append(id(provider.node))
    return found


def _is_whole(frames: Frames, space: str, tree: str) -> bool:
    """Whether a tree has the robot and its odometry: a launch with both has no part of it in another launch."""
    trees = frames.trees(space)
    edges = [edge for edge in frames.edges if edge.space == space and edge.sure and trees[edge.child] == tree]
    robot = any(edge.how == "urdf" for edge in edges)
    return robot and any(edge.how != "urdf" and not edge.static and edge.parent in OF_LOCALIZATION for edge in edges)


RULE = Rule(
    id="FRM005",
    name="disconnected-trees",
    effect="breaks",
    kind="unreachable",
    always=(Reason.LIBRARY,),
    sometimes=(Reason.OUTSIDE, Reason.NOT_ANALYSED, Reason.PARTLY_READ),
    what="Checks for frames that a node uses together and that are in two trees which no transform joins. So it does "
    "for a base that localization publishes and that the robot description does not have.",
    why="The node waits for the transform, or repeats `Could not find a connection between ...`.",
    example='<!-- robot_state_publisher has base_link -> mast; the driver of the lidar writes "laser" -->\n'
    '<node pkg="tf2_ros" exec="static_transform_publisher" args="0 0 0 0 0 0 lidar_mount laser"/>',
    instead='<node pkg="tf2_ros" exec="static_transform_publisher" args="0 0 0 0 0 0 mast laser"/>',
    references=(TF2, FRAMES),
    check=_check,
    of_robot=True,
    needs_graph=True,
    every_root=True,
)
