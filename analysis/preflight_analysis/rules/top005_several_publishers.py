"""TOP005: two nodes publish a topic that is meant for one."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import replace

from preflight_analysis.documents.document import Document
from preflight_analysis.findings.claim import say
from preflight_analysis.findings.clipping import clipped
from preflight_analysis.findings.doubt import Doubt, Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.findings.policy import doubted
from preflight_analysis.graph.model import Channel, Connection
from preflight_analysis.model.channels import OF_ENDS, doubts_of_ends
from preflight_analysis.model.context import Context
from preflight_analysis.model.places import connection_location, endpoints_of, related_endpoint, subject_of
from preflight_analysis.model.problems import include_chain
from preflight_analysis.model.well_known import is_transform
from preflight_analysis.rules.further_reading import TOPICS, TOPICS_2
from preflight_analysis.rules.rule import Rule

_STATE = frozenset({"nav_msgs/OccupancyGrid", "nav_msgs/MapMetaData", "sensor_msgs/CameraInfo"})
"""Types of which a latched message is the state of the world: there is one."""
_STREAMS = frozenset({"sensor_msgs/Image", "sensor_msgs/CameraInfo"})
"""Types of which a topic has one source: an image belongs to the calibration beside it."""
_WITH_FRAME = frozenset({"sensor_msgs/LaserScan", "sensor_msgs/Imu", "nav_msgs/Odometry"})
"""Likewise, but two range finders of one robot may be read from one topic, by those who look at the frame of each."""
_SAID = "'{name}' has {number} publishers ({node}{more}): {happens}"
_SHARED = ("visualization_msgs/", "diagnostic_msgs/", "actionlib_msgs/", "dynamic_reconfigure/")
"""Types whose messages say whose they are: many publish them on one topic."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    channels = [*context.graph.topics.values()] if context.graph is not None else []
    for channel, finding in zip(channels, context.each(_of_channel, channels, rule), strict=True):
        if finding is not None:
            module = _imported_by_all(context, channel)
            yield finding if module is None else _of_module(finding, module)


def _of_channel(channel: Channel, rule: Rule) -> Finding | None:
    if len(channel.providers) < 2 or is_transform(channel.name):
        return None
    connections = list({c.node.name: c for c in channel.providers if not (c.endpoint.builtin or c.action)}.values())
    latched = [
        connection
        for connection in connections
        if connection.endpoint.qos.get("latch") is True and not _is_shared(connection)
    ]
    if channel.name == "/clock" and len(connections) > 1:
        return _finding(rule, channel, connections, "time jumps between them")
    if len(latched) > 1:
        why = doubts(INTENDED=latched[0].endpoint.type not in _STATE)
        consequence = "each latches its last message, and a new subscriber receives all of them in any order"
        return _finding(rule, channel, latched, consequence, why)
    types = {connection.endpoint.type for connection in connections}
    if len(connections) > 1 and len(types) == 1 and not types.isdisjoint(_STREAMS | _WITH_FRAME):
        copies = connections[0].node.name if _is_of_copies(channel, connections) else ""
        why = doubts(INTENDED=not types.isdisjoint(_WITH_FRAME), ASSUMED=copies)
        return _finding(rule, channel, connections, "a subscriber receives the messages of all in turn", why)
    return None


def _is_of_copies(channel: Channel, connections: list[Connection]) -> bool:
    """Whether nobody listens to copies of one program, as eight viewers, of which only the catalogue tells how they
    make the name: they may put it below one that is remapped."""
    programs = {(each.node.package, each.node.executable) for each in connections}
    told = all(each.endpoint.evidence.of_catalogue for each in connections)
    return told and len(programs) == 1 and not channel.consumers


def _is_shared(connection: Connection) -> bool:
    return (connection.endpoint.type or "").startswith(_SHARED)


def _finding(
    rule: Rule, channel: Channel, connections: list[Connection], consequence: str, why: tuple[Doubt, ...] = ()
) -> Finding:
    first, *others = connections = sorted(connections, key=lambda connection: connection.is_placed)
    more = "".join(f" and {each.node.name}" for each in others)
    told = {each.reason for each in why}
    return rule.claim(
        say(_SAID, name=channel.name, number=len(connections), node=first.node.name, more=more, happens=consequence),
        connection_location(connections[-1]),
        subject=subject_of(first),
        doubts=(*why, *(each for each in doubts_of_ends(*connections) if each.reason not in told)),
        related=(
            *(related_endpoint(connection, "publishes") for connection in connections[:-1]),
            *include_chain(connections[-1].node.origin),
        ),
        endpoints=endpoints_of(*connections),
    )


def _imported_by_all(context: Context, channel: Channel) -> str | None:
    """The Python module that makes the publishers of different programs as they import it: some may never use it."""
    places = {(each.endpoint.source_file, each.endpoint.source_line) for each in channel.providers}
    programs = {(each.node.package, each.node.executable) for each in channel.providers}
    file, line = places.pop()
    if places or len(programs) == 1 or file is None or line is None or not file.endswith(".py"):
        return None
    document = context.disk.text(file)
    lines = document.text.splitlines() if isinstance(document, Document) else []
    return file if 0 < line <= len(lines) and not lines[line - 1].startswith((" ", "\t")) else None


def _of_module(finding: Finding, module: str) -> Finding:
    file = os.path.basename(module)
    text = finding.text.followed_by(", if both use it: '{file}' makes it on import", file=file)
    return replace(doubted(finding, Doubt(Reason.ASSUMED, file)), text=text, message=clipped(str(text)))


RULE = Rule(
    id="TOP005",
    name="several-publishers",
    effect="misbehaves",
    kind="duplicate",
    sometimes=(Reason.INTENDED, *OF_ENDS),
    what="Checks for several publishers of a topic that should have one: `/clock`, latched topics and sensor data. "
    "Transforms, markers and diagnostics name their source in each message, and are not reported.",
    why="Subscribers treat a latched message as the state of the world. With two publishers the state depends on "
    "the order of arrival.",
    example='<node pkg="map_server" type="map_server" name="map_server"/> <!-- both publish /map -->\n'
    '<node pkg="gmapping" type="slam_gmapping" name="slam"/>',
    instead='<node pkg="gmapping" type="slam_gmapping" name="slam"/>',
    references=(
        TOPICS,
        TOPICS_2,
    ),
    settings=(
        "external",
        "nodes",
    ),
    check=_check,
    needs_graph=True,
    every_root=True,
)
