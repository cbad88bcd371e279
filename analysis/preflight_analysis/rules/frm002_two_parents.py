"""FRM002: a frame that two nodes publish."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain

from preflight_analysis.findings.claim import Subject, Text, say
from preflight_analysis.findings.doubt import Doubt, Reason, doubts
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.frames.model import Edge, Frames
from preflight_analysis.model.context import Context
from preflight_analysis.model.frames import frames_of, place_of_edge
from preflight_analysis.rules.further_reading import FRAMES, TF2
from preflight_analysis.rules.rule import Rule

_SYSTEM = "::systems::"
"""In the names of plugins of Gazebo that are no nodes of ROS: what they send comes to it by a bridge alone."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    frames = frames_of(context)
    spaces: list[Mapping[str, Sequence[Edge]]] = [frames.parents(space) for space in frames.spaces]
    for child, known in chain.from_iterable(each.items() for each in spaces):
        edges = [edge for edge in known if not edge.guessed and _is_in_ros(edge, frames)] if len(known) > 1 else ()
        if len(edges) < 2:
            continue
        # A joint is where it belongs; what contradicts it is told.
        first, *others = sorted(edges, key=lambda edge: edge.how != "urdf")
        for other in others:
            why = _doubts(first, other)
            if why is None:
                continue
            # Two that do not move hardly differ.
            alike = first.parent == other.parent
            yield rule.claim(
                _said(child, first, other),
                place_of_edge(context, other),
                subject=Subject("frame", child),
                kind="duplicate" if alike else "conflict",
                effect="note" if alike and _is_still(first) and _is_still(other) else None,
                doubts=why,
                related=(Related(f"'{child}' below '{first.parent}'", place_of_edge(context, first)),),
            )
            break


def _is_in_ros(edge: Edge, frames: Frames) -> bool:
    return edge.how != "gazebo" or (frames.simulated and _SYSTEM not in edge.detail)


def _doubts(first: Edge, other: Edge) -> tuple[Doubt, ...] | None:
    """None where it does no harm."""
    if first.node is None or other.node is None or (first.node is other.node and first.how == other.how != "urdf"):
        return None
    sure = first.sure and other.sure
    if first.parent == other.parent:
        if first.node is other.node or (first.how == other.how == "urdf"):
            return None
        # One tag makes a node for each robot, which may have a master of its own.
        shared = first.node.location == other.node.location
        # It is published where somebody publishes the state of the joint.
        return doubts(SHARED=shared, ASSUMED=not sure or (first.how == "urdf" and not first.static))
    return doubts(ASSUMED=not sure)


def _is_still(edge: Edge) -> bool:
    """Whether it never changes; tf's static transform publisher repeats it."""
    return edge.static or edge.how == "arguments"


def _said(child: str, first: Edge, other: Edge) -> Text:
    node = first.node.name if first.node is not None else ""
    said = "frame '{child}' has two parents: '{parent}' from {node}{by}, '{other}' from {by_other}"
    if first.parent == other.parent:
        said = "frame '{child}' has two publishers: {node}{by} and {by_other}"
    parents = {"parent": first.parent, "other": other.parent}
    return say(said, child=child, node=node, by=first.by.removeprefix(node), by_other=other.by, **parents)


RULE = Rule(
    id="FRM002",
    name="two-parents",
    effect="misbehaves",
    kind="conflict",
    always=(Reason.FROM_SOURCE,),
    sometimes=("note", Reason.ASSUMED, Reason.SHARED),
    what="Checks for a frame with two different parents, or with two nodes that publish it below the same parent.",
    why="A frame has one parent. The later message replaces the earlier one, so the robot jumps between two places, or "
    "parts of the tree are disconnected.",
    example="# the URDF has base_footprint -> base_link\nekf:\n  ros__parameters:\n    base_link_frame: base_link",
    instead="ekf:\n  ros__parameters:\n    base_link_frame: base_footprint",
    references=(TF2, FRAMES),
    check=_check,
)
