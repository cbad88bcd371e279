"""LaunchTree and interfaces to Graph. Namespaces and remaps are applied here, so changing one needs no new run."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree, Remap
from preflight_analysis.graph.annotations import annotated
from preflight_analysis.graph.model import Channel, Connection, Graph, ParamRead
from preflight_analysis.tracing.interface import Endpoint, Interface

_OFFERS = ("publisher", "service", "action_server")
_TOPIC_ROLES = ("publisher", "subscriber")
_SERVICE_ROLES = ("service", "client")


def build_graph(tree: LaunchTree, interfaces: Sequence[Interface]) -> Graph:
    """Who talks to whom after the launch of `tree`, given what each of its nodes does.

    `interfaces` has one entry for each of `tree.nodes`, in that order; `NOT_RUN` for a node of which nothing is known.
    Where a trace is missing or failed, what the launch file annotates is added to what was seen.

    Raises `ValueError` if the lengths differ.
    """
    merged = tuple(annotated(interface, node.action) for node, interface in zip(tree.nodes, interfaces, strict=True))
    topics: list[Connection] = []
    services: list[Connection] = []
    actions: list[Connection] = []
    reads: list[ParamRead] = []
    for node, interface in zip(tree.nodes, merged, strict=True):
        if not interface.endpoints and not interface.params:
            continue
        remaps = _effective_remaps(node)
        for endpoint in interface.endpoints:
            if endpoint.role in _TOPIC_ROLES:
                topics.append(_connect(node, endpoint, remaps))
            elif endpoint.role in _SERVICE_ROLES:
                services.append(_connect(node, endpoint, remaps))
            else:
                actions.append(_connect_action(node, endpoint, remaps))
        targets = {source: remap[1] for source, remap in remaps.items()}
        reads.extend(ParamRead(names.resolve(use.name, node.name, targets), node, use) for use in interface.params)
    return Graph(tree, merged, _channels(topics), _channels(services), _channels(actions), tuple(reads))


def _effective_remaps(node: LaunchNode) -> dict[str, tuple[Remap, str]]:
    """Resolved source to the remap and its resolved target; of two for one name the later wins, as in the clients."""
    return {
        names.resolve(remap.source, node.name): (remap, names.resolve(remap.target, node.name)) for remap in node.remaps
    }


def _connect(node: LaunchNode, endpoint: Endpoint, remaps: Mapping[str, tuple[Remap, str]]) -> Connection:
    full = names.resolve(endpoint.name, node.name)
    if full in remaps:
        remap, target = remaps[full]
        return Connection(target, node, endpoint, remap)
    return Connection(full, node, endpoint, None)


def _connect_action(node: LaunchNode, endpoint: Endpoint, remaps: Mapping[str, tuple[Remap, str]]) -> Connection:
    """An action is five topics below its name, and a remap moves them one by one: `<action>/goal` stands for all."""
    full = names.resolve(endpoint.name, node.name)
    if f"{full}/goal" in remaps:
        remap, target = remaps[f"{full}/goal"]
        if target.endswith("/goal"):
            return Connection(target.removesuffix("/goal"), node, endpoint, remap)
    return Connection(full, node, endpoint, None)


def _channels(connections: Iterable[Connection]) -> dict[str, Channel]:
    """Grouped by final name, sorted by it; ends that a node made twice alike count once."""
    grouped: dict[str, list[Connection]] = {}
    seen: set[tuple[object, ...]] = set()
    for connection in connections:
        end = connection.endpoint
        key = (connection.name, id(connection.node), end.role, end.type, end.md5)
        if key not in seen:
            seen.add(key)
            grouped.setdefault(connection.name, []).append(connection)
    return {
        name: Channel(
            name,
            tuple(c for c in grouped[name] if c.endpoint.role in _OFFERS),
            tuple(c for c in grouped[name] if c.endpoint.role not in _OFFERS),
        )
        for name in sorted(grouped)
    }
