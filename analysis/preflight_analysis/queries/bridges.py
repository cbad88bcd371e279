"""What a bridge to Gazebo carries, at its argument or its entry."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from preflight_analysis.findings.markdown import code
from preflight_analysis.graph.model import Connection
from preflight_analysis.model.gazebo_bridges import Bridge, bridges
from preflight_analysis.queries.hover_text import Hover
from preflight_analysis.workspace.workspace import Analysis

_TITLES = {
    "GZ_TO_ROS": "Bridge from Gazebo to ROS",
    "ROS_TO_GZ": "Bridge from ROS to Gazebo",
    "BIDIRECTIONAL": "Bridge between ROS and Gazebo, both ways",
}
_SHOWN = 8


def bridge_hover(analyses: Sequence[Analysis], file: str, offset: int) -> Hover | None:
    """The names and types of both sides, and who is at the other end in ROS, in the first root that has the bridge."""
    for analysis in analyses:
        for bridge in bridges(analysis.context):
            at = next((each for each in bridge.written if each.file == file and each.span.contains(offset)), None)
            if at is not None and bridge.direction in _TITLES:
                return Hover("\n".join(_lines(analysis, bridge)), at.span)
    return None


def _lines(analysis: Analysis, bridge: Bridge) -> Iterator[str]:
    yield f"{_TITLES[bridge.direction]} by {code(bridge.node.name)}"
    yield ""
    yield f"- ROS: {code(bridge.topic)}, {code(bridge.ros)}"
    yield f"- Gazebo: {code(bridge.gazebo_topic)}, {code(bridge.gazebo)}"
    graph = analysis.graph
    for channel in graph.topics.values() if graph is not None else ():
        ends = (*channel.providers, *channel.consumers)
        if any(each.node.name == bridge.node.name and each.endpoint.name == bridge.topic for each in ends):
            if bridge.direction != "GZ_TO_ROS":
                yield f"- Publishers in ROS: {_others(channel.providers, bridge)}"
            if bridge.direction != "ROS_TO_GZ":
                yield f"- Subscribers in ROS: {_others(channel.consumers, bridge)}"
            return


def _others(ends: Iterable[Connection], bridge: Bridge) -> str:
    names = list(dict.fromkeys(each.node.name for each in ends if each.node.name != bridge.node.name))
    more = f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else ""
    return ", ".join(map(code, names[:_SHOWN])) + more if names else "none known"
