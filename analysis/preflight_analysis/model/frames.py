"""The frames of a launch, as rules and queries ask for them."""

from __future__ import annotations

from collections.abc import Mapping

from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.tree import Param
from preflight_analysis.evaluation.value_places import value_place
from preflight_analysis.frames.build import build_frames
from preflight_analysis.frames.model import Edge, Frames, Mention, Use
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context
from preflight_analysis.robot.sources import Attribute, place_of, text_place


def frames_of(context: Context) -> Frames:
    """All frames that are known; the same object each time."""
    return _frames(context)


@derived
def _frames(context: Context) -> Frames:
    return build_frames(context.tree, context.graph, context.known, context.disk, context.kept)


def in_words(use: Use) -> Mapping[str, str]:
    """What a node does with a frame, as the values of a text with `{node}{does}`; the node is "" where the robot
    description has the frame."""
    node = use.node.name if use.robot is None or not use.of_sensor else ""
    return {"node": node, "does": use.does.removeprefix(node)}


def place_of_edge(context: Context, edge: Edge) -> Location:
    """Where a transform comes from: the joint in the URDF or xacro file, else the node or parameter that says it."""
    joint = edge.detail.removeprefix("joint ") if edge.how == "urdf" else ""
    if edge.robot is not None and joint and not edge.catalogued:
        return (
            place_of(edge.robot, context.disk, context.environment, Attribute("joint", "name", joint)) or edge.location
        )
    return edge.location


def place_of_use(context: Context, use: Use) -> Location:
    """Where a frame is named: the element in the robot description, the value of the parameter, else the node."""
    if use.robot is not None:
        return text_place(use.robot, context.disk, context.environment, use.tag, use.written) or use.location
    return _place_of(context, use.param, use.written) if use.param is not None else use.node.location


def place_of_mention(context: Context, mention: Mention) -> Location:
    """Where a frame is named: the value of the parameter."""
    return place_of_param(context, mention.param)


def place_of_param(context: Context, param: Param) -> Location:
    """Where a parameter that is a frame has it written."""
    return _place_of(context, param, str(param.value))


def _place_of(context: Context, param: Param, value: str) -> Location:
    place = param.place
    return value_place(place, value, context.documents.get(place.file)) or place
