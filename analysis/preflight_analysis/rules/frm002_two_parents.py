"""FRM002: a frame that two nodes publish."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain

from preflight_analysis.findings.finding import Confidence, Finding, Related, Severity
from preflight_analysis.frames.model import Edge, Frames
from preflight_analysis.rules.frames import frames_of, place_of_edge
from preflight_analysis.rules.further_reading import FRAMES, TF2
from preflight_analysis.rules.rule import Context, Rule

_SYSTEM = "::systems::"
"""In the names of plugins of Gazebo that are no nodes of ROS: what they send comes to it by a bridge alone."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    frames = frames_of(context)
    spaces: list[Mapping[str, Sequence[Edge]]] = [frames.parents(space) for space in frames.spaces]
    for child, known in chain.from_iterable(each.items() for each in spaces):
        edges = [edge for edge in known if not edge.guessed and _is_in_ros(edge, frames)]
        if len(edges) < 2:
            continue
        # A joint is where it belongs; what contradicts it is told.
        first, *others = sorted(edges, key=lambda edge: edge.how != "urdf")
        for other in others:
            judged = _judged(first, other)
            if judged is None:
                continue
            severity, confidence = judged
            yield rule.finding(
                _message(child, first, other),
                place_of_edge(context, other),
                severity=severity,
                confidence=confidence,
                related=(Related(f"'{child}' below '{first.parent}'", place_of_edge(context, first)),),
            )
            break


def _is_in_ros(edge: Edge, frames: Frames) -> bool:
    return edge.how != "gazebo" or (frames.simulated and _SYSTEM not in edge.detail)


def _judged(first: Edge, other: Edge) -> tuple[Severity, Confidence] | None:
    """Severity and confidence; None where it does no harm."""
    if first.node is None or other.node is None or (first.node is other.node and first.how == other.how != "urdf"):
        return None
    sure = first.sure and other.sure
    if first.parent == other.parent:
        if first.node is other.node or (first.how == other.how == "urdf"):
            return None
        if not sure or first.node.location == other.node.location:
            return "info", "possible"  # one tag makes a node for each robot, which may have a master of its own
        if first.how == "urdf" and not first.static:
            return "info", "possible"  # it is published where somebody publishes the state of the joint
        # Two that do not move hardly differ.
        return ("info" if _is_still(first) and _is_still(other) else "warning"), "likely"
    return ("warning", "likely") if sure else ("info", "possible")


def _is_still(edge: Edge) -> bool:
    """Whether it never changes; tf's static transform publisher repeats it."""
    return edge.static or edge.how == "arguments"


def _message(child: str, first: Edge, other: Edge) -> str:
    if first.parent == other.parent:
        return f"frame '{child}' has two publishers: {first.by} and {other.by}"
    return f"frame '{child}' has two parents: '{first.parent}' from {first.by}, '{other.parent}' from {other.by}"


RULE = Rule(
    id="FRM002",
    name="two-parents",
    severity="warning",
    what="Checks for a frame with two different parents, or with two nodes that publish it below the same parent. "
    "Two static transforms between the same frames are information, and so is what is only possibly published, such as "
    "a joint that moves.",
    why="A frame has one parent. The later message replaces the earlier one, so the robot jumps between two places, or "
    "parts of the tree are disconnected.",
    example="# the URDF has base_footprint -> base_link\nekf:\n  ros__parameters:\n    base_link_frame: base_link",
    instead="ekf:\n  ros__parameters:\n    base_link_frame: base_footprint",
    references=(TF2, FRAMES),
    check=_check,
)
