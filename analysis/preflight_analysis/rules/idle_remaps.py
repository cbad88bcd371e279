"""Remaps whose name is none that their nodes use, and what they were probably meant for."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode, Remap
from preflight_analysis.graph.model import Channel, Connection, Graph
from preflight_analysis.rules.nearest import likeness
from preflight_analysis.rules.rule import Context
from preflight_analysis.rules.well_known import is_transform
from preflight_analysis.tracing.interface import Interface

_TOPIC_ROLES = ("publisher", "subscriber")


@dataclass(frozen=True, slots=True)
class IdleRemap:
    """A remap that has no effect at any node that it reaches. `nodes` are those, the first one in full."""

    remap: Remap
    nodes: tuple[LaunchNode, ...]
    meant: Connection | None
    """The end of the first node that it was most likely meant for."""
    partner: Connection | None
    """An end of another node that stands under the remap's target and that `meant` would fit."""


@dataclass(slots=True)
class _Reached:
    remap: Remap
    nodes: list[LaunchNode]


def idle_remaps(context: Context) -> tuple[IdleRemap, ...]:
    """Those of nodes that were run to their event loop. Ask through `context.once`."""
    graph = context.graph
    if graph is None:
        return ()
    idle = context.kept.each_row(_without_effect, (graph.tree.nodes, graph.interfaces))
    return tuple(_idle(graph, idle)) if any(idle) else ()


def meant_endpoints(context: Context) -> frozenset[int]:
    """The ids of the connections that an idle remap was most likely meant to bring together: that they dangle is told
    with it, once."""
    found = [i for i in context.once(idle_remaps) if i.meant is not None and i.partner is not None]
    return frozenset(id(connection) for idle in found for connection in (idle.meant, idle.partner))


def _without_effect(node: LaunchNode, interface: Interface) -> tuple[Remap, ...]:
    """The remaps that have no effect at this node, as far as is known."""
    if not node.remaps or not _reports_names(node, interface):
        return ()
    used = _used(node, interface)
    return tuple(remap for remap in node.remaps if _has_no_effect(remap, node, used))


def _idle(graph: Graph, idle: Iterable[tuple[Remap, ...]]) -> Iterator[IdleRemap]:
    # A tag reaches several nodes where it stands around them, or in a file that is included more than once: it has to
    # be idle at all of them.
    reached: dict[object, _Reached] = {}
    in_use: set[object] = set()
    for node, of_node in zip(graph.tree.nodes, idle, strict=True):
        for remap in node.remaps:
            place = remap.origin[-1]
            if place in in_use:
                continue
            if not any(remap is each for each in of_node):
                in_use.add(place)
                reached.pop(place, None)
            else:
                reached.setdefault(place, _Reached(remap, [])).nodes.append(node)
    if not reached:
        return
    wanted = {id(each.nodes[0]) for each in reached.values()}
    connections: dict[int, list[Connection]] = {}
    for channel in (*graph.topics.values(), *graph.services.values()):
        for connection in (*channel.providers, *channel.consumers):
            if id(connection.node) in wanted and connection.remap is None and not connection.endpoint.builtin:
                connections.setdefault(id(connection.node), []).append(connection)
    for each in reached.values():
        meant, partner = _meant(graph, each.remap, each.nodes[0], connections.get(id(each.nodes[0]), ()))
        yield IdleRemap(each.remap, tuple(each.nodes), meant, partner)


def _reports_names(node: LaunchNode, interface: Interface) -> bool:
    """Whether a run showed, or the source tells, all names that the node uses. One that made nothing of its own is a
    wrapper or a loader of something else, whose names nobody saw."""
    if interface.declared or not interface.known_in_full or node.unknowns:
        return False
    if node.package == "nodelet":
        return False  # those of images subscribe only while somebody reads what they make of it
    return any(not (e.builtin or e.speculative) for e in interface.endpoints)


@dataclass(frozen=True, slots=True)
class _Names:
    """What a node uses, by full names before remapping. `around` has them with all namespaces above them."""

    used: frozenset[str]
    around: frozenset[str]


def _used(node: LaunchNode, interface: Interface) -> _Names:
    given = [e.name for e in interface.endpoints if not e.builtin] + [p.name for p in interface.params if not p.builtin]
    used = frozenset(names.resolve(name, node.name) for name in given)
    return _Names(used, frozenset(names.with_namespaces(used)))


def _has_no_effect(remap: Remap, node: LaunchNode, known: _Names) -> bool:
    """Whether neither the node nor a library could mean the name.

    Libraries make names below the one that they are given (an action's five topics, the transports of an image,
    dynamic_reconfigure's, a node handle's), and beside it (`camera_info`); one that applies remaps itself hands over
    the target.
    """
    if remap.source == remap.target or not names.is_legal(remap.source):
        return False
    full, target = names.resolve(remap.source, node.name), names.resolve(remap.target, node.name)
    if is_transform(full) or full.endswith("/camera_info") or full in known.around or target in known.around:
        return False
    above = full.rpartition("/")[0]
    while above:
        if above in known.used:
            return False
        above = above.rpartition("/")[0]
    return True


def _meant(
    graph: Graph, remap: Remap, node: LaunchNode, connections: Iterable[Connection]
) -> tuple[Connection | None, Connection | None]:
    """The end that the remap was meant for, and whom it would then meet.

    Either its name is like the remap's and nothing else reaches it, or it is the node's only one without another end
    that fits what stands under the target.
    """
    full, target = names.resolve(remap.source, node.name), names.resolve(remap.target, node.name)
    lone: list[tuple[Connection, Connection | None]] = []
    for connection in connections:
        channels: Mapping[str, Channel] = graph.topics if connection.endpoint.role in _TOPIC_ROLES else graph.services
        if _facing(channels[connection.name], connection):
            continue
        lone.append((connection, _partner(channels.get(target), connection)))
    typos = [(connection, partner) for connection, partner in lone if _is_slip(full, connection)]
    if len(typos) == 1:
        return typos[0]
    fitting = [(connection, partner) for connection, partner in lone if partner is not None]
    return fitting[0] if len(fitting) == 1 else (None, None)


def _is_slip(full: str, connection: Connection) -> bool:
    """Whether the names are a typo apart, or only their namespaces differ: a missing `~`, a slash too many."""
    alike = likeness(full, connection.name)
    return (alike is not None and alike[0] == "typo") or names.leaf(full) == names.leaf(connection.name)


def _partner(channel: Channel | None, connection: Connection) -> Connection | None:
    """The first end of another node in `channel` that `connection` could talk to."""
    if channel is None:
        return None
    for other in _facing(channel, connection):
        same = connection.endpoint.type not in (None, "*") and connection.endpoint.type == other.endpoint.type
        if same and other.node is not connection.node and not other.endpoint.builtin:
            return other
    return None


def _facing(channel: Channel, connection: Connection) -> tuple[Connection, ...]:
    """The ends of the channel that one like `connection` talks to."""
    return channel.consumers if connection.endpoint.role in ("publisher", "service") else channel.providers
