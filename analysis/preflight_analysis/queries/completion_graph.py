"""Names of topics, services and parameters at a cursor, from what is known of the nodes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from preflight_analysis.documents.document import Element
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.markdown import code
from preflight_analysis.generation import ros
from preflight_analysis.graph.actions import actions_of
from preflight_analysis.graph.model import Connection, Graph
from preflight_analysis.launch.model import NODE_KINDS
from preflight_analysis.queries.completion_items import Item
from preflight_analysis.queries.cursor import Place
from preflight_analysis.queries.param_texts import default_text
from preflight_analysis.queries.places import link
from preflight_analysis.tracing.interface import Endpoint, Interface, ParamUse
from preflight_analysis.workspace.workspace import Analysis

_SHOWN_ENDPOINTS = 5
_ROLES = {
    "publisher": "publishes",
    "subscriber": "subscribes",
    "service": "offers service",
    "client": "calls service",
    "action_server": "offers action",
    "action_client": "calls action",
}


def namespaces(analysis: Analysis, file: str, place: Place, element: Element, before: str) -> Iterator[Item]:
    """Those that other nodes are in."""
    found = {node.namespace.strip("/") for node in analysis.tree.nodes} - {""}
    for name in sorted(found):
        text = f"/{name}" if before.startswith("/") else name
        yield Item("namespace", text, text)


def parameters(analysis: Analysis, file: str, place: Place, element: Element, before: str) -> Iterator[Item]:
    """In a node: its private parameters that its tag does not set yet; elsewhere: those that any node asks for."""
    graph = analysis.graph
    if graph is None:
        return
    node = _node_tag(place)
    if node is None:
        reads = {read.name: read for read in graph.param_reads if not read.use.builtin and "~" not in read.name}
        for name, read in sorted(reads.items()):
            doc = parameter_doc(read.node, read.use, analysis.tree.generation)
            yield Item("parameter", name, name, doc, default_of(read.use, analysis.tree.generation))
        return
    siblings = (child.get("name") for child in node.elements if child.span != element.span)
    present = {written.value.text for written in siblings if written is not None}
    seen: set[str] = set()
    for asking, interface in _interfaces(analysis, graph, file, node):
        for use in interface.params:
            own = own_name(use, analysis.tree.generation)
            if own is None or use.builtin or use.access == "set" or own in seen or own in present:
                continue
            seen.add(own)
            generation = analysis.tree.generation
            yield Item("parameter", own, own, parameter_doc(asking, use, generation), default_of(use, generation))


def own_name(use: ParamUse, generation: int) -> str | None:
    """The name of a node's own parameter as it is written in its tag; None for one of others. In ROS 2 all are its
    own."""
    if ros(generation).own_parameters:
        return use.name.removeprefix("~")
    return use.name[1:] if use.name.startswith("~") else None


def parameter_doc(node: LaunchNode, use: ParamUse, generation: int) -> str:
    """Which node asks for a parameter, and where its source does."""
    where = f" — {link(use.source_file, use.source_line)}" if use.source_file else ""
    return f"{'Declared' if ros(generation).own_parameters else 'Read'} by {code(node.name)}{where}"


def default_of(use: ParamUse, generation: int) -> str:
    """What a parameter is where it is not set; nodes of ROS 2 declare its type with that."""
    if ros(generation).own_parameters:
        return default_text(use).replace("`", "")
    return f"default: {use.default!r}" if use.has_default else "no default" if use.mandatory else ""


def remap_sources(analysis: Analysis, file: str, place: Place, element: Element, before: str) -> Iterator[Item]:
    """What the nodes that the remap reaches call their topics, services and actions."""
    for endpoint in _endpoints(analysis, file, place):
        detail = ", ".join(part for part in (endpoint.type, _ROLES[endpoint.role]) if part)
        yield Item("endpoint", endpoint.name, endpoint.name, detail=detail)


def remap_targets(analysis: Analysis, file: str, place: Place, element: Element, before: str) -> Iterator[Item]:
    """The names that there are in the graph, first those of the type of what is remapped."""
    graph = analysis.graph
    written = element.get("from")
    if graph is None:
        return
    source = written.value.text if written is not None else ""
    types = {e.type for e in _endpoints(analysis, file, place) if e.name == source and e.type is not None}
    node = _node_tag(place)
    namespace = next((n.namespace for n, _ in _interfaces(analysis, graph, file, node)), "/") if node else "/"
    found: list[tuple[bool, str, Item]] = []
    for channel in (*graph.topics.values(), *graph.services.values(), *graph.actions.values()):
        connections = (*channel.providers, *channel.consumers)
        if channel.domain or not any(
            not connection.endpoint.builtin and not _made_here(connection, file, element) for connection in connections
        ):
            continue
        name = channel.name
        if before and not before.startswith("/") and name.startswith(namespace):
            name = name[len(namespace) :]
        there = channel.types
        item = Item("endpoint", name, name, _connections(connections), ", ".join(there))
        found.append((types.isdisjoint(there), name, item))
    yield from (item for _, _, item in sorted(found, key=lambda each: each[:2]))


def _connections(connections: Sequence[Connection]) -> str:
    lines = [
        f"- {code(connection.node.name)} {_ROLES[connection.endpoint.role]}"
        for connection in connections[:_SHOWN_ENDPOINTS]
    ]
    if len(connections) > _SHOWN_ENDPOINTS:
        lines.append(f"- … and {len(connections) - _SHOWN_ENDPOINTS} more")
    return "\n".join(lines)


def _made_here(connection: Connection, file: str, element: Element) -> bool:
    """Whether the name is only there because this very remap has it, half-typed as it may be."""
    if connection.remap is None:
        return False
    place = connection.remap.origin[-1]
    return place.file == file and place.span.start == element.span.start


def _node_tag(place: Place) -> Element | None:
    return next((e for e in reversed(place.parents) if e.tag.lower() in NODE_KINDS), None)


def _endpoints(analysis: Analysis, file: str, place: Place) -> Iterator[Endpoint]:
    """What the nodes in reach use, without what every node has, each name once."""
    graph = analysis.graph
    scope = _node_tag(place) or place.parent
    if graph is None or scope is None:
        return
    seen: set[str] = set()
    for _, interface in _interfaces(analysis, graph, file, scope):
        for endpoint in (*(action.endpoint for action in actions_of(interface.endpoints)), *interface.endpoints):
            if not endpoint.builtin and endpoint.name not in seen:
                seen.add(endpoint.name)
                yield endpoint


def _interfaces(analysis: Analysis, graph: Graph, file: str, scope: Element) -> Iterator[tuple[LaunchNode, Interface]]:
    """The nodes that a tag, or what is in it, starts; for a node's tag also others that run the same executable, as
    the tag itself may be too new to be known."""
    package, executable = scope.get("pkg"), scope.get("exec") or scope.get("type") or scope.get("plugin")
    same = (package.value.text, executable.value.text) if package is not None and executable is not None else None
    others: list[tuple[LaunchNode, Interface]] = []
    for node, interface in zip(analysis.tree.nodes, graph.processes, strict=True):
        if any(s.file == file and scope.span.start <= s.span.start < scope.span.end for s in node.origin):
            yield node, interface
        elif (node.package, node.executable) == same:
            others.append((node, interface))
    yield from others
