"""Graph to what the running system should show."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location, Place
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.generation import ros
from preflight_analysis.graph.actions import topic_endpoints
from preflight_analysis.graph.model import Connection, Graph
from preflight_analysis.live.model import Expected, ExpectedEndpoint, ExpectedNode
from preflight_analysis.model.places import connection_location
from preflight_analysis.tracing.interface import Interface
from preflight_analysis.tracing.nodelets import manager_of

_NO_NODES = ("test", "process")
_HIDDEN = "/_action/"
"""In what an action of ROS 2 is made of, where a remap moved a part of it: the helper does not show these."""


def expected_of(graph: Graph, documents: Mapping[str, Document]) -> Expected:
    """What is to be expected of a running system. `documents` has the texts that places are counted in."""
    endpoints: dict[int, list[Connection]] = defaultdict(list)
    for channels in (graph.topics, graph.services, graph.actions):
        for channel in channels.values():
            for connection in (*channel.providers, *channel.consumers):
                endpoints[id(connection.node)].append(connection)
    nodes = [
        _node(node, interface, endpoints[id(node)], graph.tree.generation, documents)
        for node, interface in zip(graph.tree.nodes, graph.interfaces, strict=True)
        if node.kind not in _NO_NODES
    ]
    return Expected(graph.tree.generation, tuple(nodes), graph.tree.complete)


def _node(
    node: LaunchNode,
    interface: Interface,
    connections: Iterable[Connection],
    generation: int,
    documents: Mapping[str, Document],
) -> ExpectedNode:
    # The name of an executable is not that of the node, unless a run told it.
    certain = "$(" not in node.name and (node.named or (node.name_from_code and not node.name_inferred))
    manager = manager_of(node) if ros(generation).has_nodelets else None
    ended = interface.outcome.status == "exited" and not interface.outcome.exit_code
    return ExpectedNode(
        node.name,
        tuple(
            _endpoint(connection, generation, documents)
            for connection in connections
            if connection.action is None and not connection.endpoint.builtin and _HIDDEN not in connection.name
        ),
        interface.complete and certain,
        _place(node.location, documents),
        certain,
        ended,
        interface.outcome.reason if interface.outcome.status in ("exited", "crashed") else None,
        manager,
    )


def _endpoint(connection: Connection, generation: int, documents: Mapping[str, Document]) -> ExpectedEndpoint:
    endpoint = connection.endpoint
    is_action = endpoint.role in ("action_client", "action_server")
    return ExpectedEndpoint(
        endpoint.role,
        connection.name,
        endpoint.type,
        endpoint.qos,
        not endpoint.uncertain,
        "on demand" in endpoint.evidence.doubts,
        topic_endpoints(endpoint.role, connection.name) if is_action and not ros(generation).native_actions else (),
        _place(connection_location(connection), documents),
        Place(endpoint.source_file, endpoint.source_line) if endpoint.source_file and endpoint.source_line else None,
    )


def _place(location: Location, documents: Mapping[str, Document]) -> Place:
    document = documents.get(location.file)
    line, column = document.lines.position(location.span.start) if document is not None else (0, 0)
    return Place(location.file, line + 1, column + 1)
