"""A graph and the findings about it as what a picture shows: nodes, channels and the edges between them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, Literal

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location, Origin, Place
from preflight_analysis.evaluation.json_values import json_value
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.finding import SEVERITIES, Finding, Severity
from preflight_analysis.findings.report import positions
from preflight_analysis.graph.model import ChannelKind, Connection, Graph
from preflight_analysis.model.context import Context
from preflight_analysis.model.places import connection_location
from preflight_analysis.model.reach import notes
from preflight_analysis.tracing.interface import Interface, Role

Kind = Literal["topic", "service", "action"]
State = Literal["normal", "missing", "extra", "wrong"]
"""How a running robot compares: as launched, not there, there without having been launched, or of another type."""

_KINDS: Mapping[ChannelKind, Kind] = {"topics": "topic", "services": "service", "actions": "action"}
TOWARDS_CHANNEL: frozenset[Role] = frozenset(("publisher", "client", "action_client"))
"""The roles from which messages, calls and goals go out: their edges point at the channel, the others away from it."""


@dataclass(frozen=True, slots=True)
class ViewFinding:
    """What a finding says of a node or of an edge."""

    rule: str
    severity: Severity
    message: str
    place: Place


@dataclass(frozen=True, slots=True)
class ViewNode:
    """A node. `file` is the launch file with its tag, `places` the tag and then the includes that lead to it."""

    name: str
    package: str
    executable: str
    kind: str
    file: str
    places: tuple[Place, ...]
    source: str
    outcome: str
    reason: str | None
    findings: tuple[int, ...]
    state: State = "normal"


@dataclass(frozen=True, slots=True)
class ViewChannel:
    """A topic, service or action under its final name. `external`: the settings say that something else uses it.
    `notes` say what keeps its ends from each other, or why a side has nobody."""

    kind: Kind
    name: str
    types: tuple[str, ...]
    builtin: bool
    external: bool
    findings: tuple[int, ...]
    notes: tuple[str, ...] = ()
    state: State = "normal"


@dataclass(frozen=True, slots=True)
class ViewEdge:
    """One end: what `node` does with `channel`, by their positions in the view. `places` has the line of the source
    that makes it, where that is known, and the place of the launch file that decides on its name."""

    node: int
    channel: int
    role: Role
    type: str | None
    qos: Mapping[str, Any]
    remapped_from: str | None
    places: tuple[Place, ...]
    builtin: bool
    uncertain: bool
    findings: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class GraphView:
    """All that a picture of the graph shows. `findings` are those that its parts refer to, by position; `files` the
    launch files in the order of the launch tree, by which they are coloured in both."""

    root: str
    generation: int
    nodes: tuple[ViewNode, ...]
    channels: tuple[ViewChannel, ...]
    edges: tuple[ViewEdge, ...]
    findings: tuple[ViewFinding, ...]
    files: tuple[str, ...]

    def severity(self, findings: Iterable[int]) -> Severity | None:
        """The worst of some findings."""
        return max((self.findings[i].severity for i in findings), key=SEVERITIES.index, default=None)

    def without_builtin(self) -> GraphView:
        """Without what every node has by its client library, and the channels that nothing else uses."""
        edges = [edge for edge in self.edges if not edge.builtin]
        kept = sorted({edge.channel for edge in edges})
        moved = {old: new for new, old in enumerate(kept)}
        return GraphView(
            self.root,
            self.generation,
            self.nodes,
            tuple(self.channels[old] for old in kept),
            tuple(replace(edge, channel=moved[edge.channel]) for edge in edges),
            self.findings,
            self.files,
        )


def graph_view(graph: Graph, findings: Sequence[Finding], context: Context) -> GraphView:
    """The view of a graph. The topics that actions are made of are left out, an action is shown as such."""
    return _Builder(graph, findings, context).view()


class _Builder:
    def __init__(self, graph: Graph, findings: Sequence[Finding], context: Context) -> None:
        self._graph = graph
        self._context = context
        self._findings: list[ViewFinding] = []
        self._of_endpoints: dict[tuple[str, str, str], list[int]] = {}
        self._of_nodes: dict[int, list[int]] = {}
        tags = _tags(graph.tree.nodes)
        for finding in findings:
            nodes = [] if finding.endpoints else _nodes_at(tags, finding.location)
            if not finding.endpoints and not nodes:
                continue
            index = len(self._findings)
            shown = ViewFinding(finding.rule, finding.severity, finding.message, self._place(finding.location))
            self._findings.append(shown)
            for connection in dict.fromkeys(finding.endpoints):
                self._of_endpoints.setdefault(connection, []).append(index)
            for node in nodes:
                self._of_nodes.setdefault(node, []).append(index)

    def view(self) -> GraphView:
        graph = self._graph
        nodes = [self._node(i, *pair) for i, pair in enumerate(zip(graph.tree.nodes, graph.interfaces, strict=True))]
        index = {id(node): i for i, node in enumerate(graph.tree.nodes)}
        channels: list[ViewChannel] = []
        edges: list[ViewEdge] = []
        for of_kind, kind in _KINDS.items():
            for channel in graph.channels(of_kind).values():
                connections = (*channel.providers, *channel.consumers)
                if all(connection.action is not None for connection in connections):
                    continue
                at = len(channels)
                made = [self._edge(kind, connection, index[id(connection.node)], at) for connection in connections]
                finding_ids = tuple(dict.fromkeys(i for edge in made for i in edge.findings))
                builtin = all(edge.builtin for edge in made)
                said = notes(self._context, of_kind, channel) if not builtin else ()
                channels.append(
                    ViewChannel(kind, channel.key, channel.types, builtin, channel.external, finding_ids, said)
                )
                edges += made
        return GraphView(
            graph.tree.file,
            graph.tree.generation,
            tuple(nodes),
            tuple(channels),
            tuple(edges),
            tuple(self._findings),
            graph.tree.files,
        )

    def _node(self, index: int, node: LaunchNode, interface: Interface) -> ViewNode:
        return ViewNode(
            node.name,
            node.package,
            node.executable or node.plugin or "",
            node.kind,
            node.location.file,
            self._places(node.origin),
            interface.source,
            interface.outcome.status,
            interface.outcome.reason,
            tuple(self._of_nodes.get(index, ())),
        )

    def _edge(self, kind: Kind, connection: Connection, node: int, channel: int) -> ViewEdge:
        endpoint = connection.endpoint
        launch = connection_location(connection)
        source = (
            (Place(endpoint.source_file, endpoint.source_line),)
            if endpoint.source_file is not None and endpoint.source_line is not None
            else ()
        )
        return ViewEdge(
            node,
            channel,
            endpoint.role,
            endpoint.type,
            {policy: json_value(value) for policy, value in endpoint.qos.items() if value is not None},
            endpoint.name if connection.remap is not None else None,
            (*source, self._place(launch)),
            endpoint.builtin,
            endpoint.uncertain,
            tuple(self._of_endpoints.get((kind, connection.name, connection.node.name), ())),
        )

    def _places(self, origin: Origin) -> tuple[Place, ...]:
        return tuple(self._place(step) for step in reversed(origin))

    def _place(self, location: Location) -> Place:
        (line, column), _ = positions(location, self._context.documents)
        return Place(location.file, line + 1, column + 1)


def _tags(nodes: Sequence[LaunchNode]) -> dict[str, dict[tuple[int, int], list[int]]]:
    """The nodes by file and extent of their tags: a tag in a file that is included twice starts two."""
    found: dict[str, dict[tuple[int, int], list[int]]] = {}
    for i, node in enumerate(nodes):
        span = node.action.span
        found.setdefault(node.location.file, {}).setdefault((span.start, span.end), []).append(i)
    return found


def _nodes_at(tags: Mapping[str, Mapping[tuple[int, int], list[int]]], location: Location) -> list[int]:
    """The nodes whose tag a place lies in: a composable node's, not its container's."""
    start, connection = location.span
    around = [extent for extent in tags.get(location.file, {}) if extent[0] <= start and connection <= extent[1]]
    return tags[location.file][min(around, key=lambda extent: extent[1] - extent[0])] if around else []
