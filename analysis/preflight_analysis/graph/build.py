"""LaunchTree and interfaces to Graph. Namespaces and remaps are applied here, so changing one needs no new run."""

from __future__ import annotations

import fnmatch
import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import chain

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.arguments import remaps_in
from preflight_analysis.evaluation.ros2.remaps import source_for
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree, Remap
from preflight_analysis.generation import ros
from preflight_analysis.graph.actions import ActionEndpoint, actions_of, moves_actions
from preflight_analysis.graph.domains import Domain, Domains, domains_of, groups_apart, separation
from preflight_analysis.graph.model import PROVIDERS, Channel, Connection, Graph, ParamRead, Standing
from preflight_analysis.graph.processes import each_node
from preflight_analysis.incremental.kept import Kept
from preflight_analysis.tracing.interface import Endpoint, Interface
from preflight_analysis.tracing.nodelets import manager_of
from preflight_analysis.tracing.request import split_args

_TOPIC_ROLES = ("publisher", "subscriber")
_SERVICE_ROLES = ("service", "client")


def build_graph(
    tree: LaunchTree,
    interfaces: Sequence[Interface],
    external_topics: Sequence[str] = (),
    environment: Environment | None = None,
    documents: Mapping[str, Document] | None = None,
    kept: Kept | None = None,
) -> Graph:
    """Who talks to whom after the launch of `tree`, given what each of its nodes does.

    `interfaces` has one entry for each of `tree.nodes_and_simulated`, in that order; `NOT_RUN` for a node of which
    nothing is known.

    `external_topics` are patterns of the topics that something outside of the launch offers or wants. The
    client libraries of the `environment`'s distribution decide what a remap moves, and its variables are those that the
    launch is started with. `documents` are the texts of parameter files, which may have something for other nodes of a
    process than the launch file's. What was `kept` of the graph before is taken over.

    Raises `ValueError` if the lengths differ.
    """
    kept = kept or Kept()
    started, nodes = len(tree.nodes), tree.nodes_and_simulated
    if len(nodes) != len(interfaces):
        raise ValueError(f"{len(interfaces)} interfaces of {len(nodes)} nodes")
    processes = tuple(interfaces[:started])
    tree = replace(tree, nodes=nodes, simulated=()) if tree.simulated else tree
    tree, merged = each_node(tree, (*processes, *interfaces[started:]), documents or {})
    columns = tree.nodes, merged, _managers(tree)
    distro, variables = (environment.distro, environment.variables) if environment is not None else (None, {})
    made = kept.each_row(_of_node, columns, tree.generation, moves_actions(distro))
    domains = domains_of(tree, variables, documents or {}, kept)
    return Graph(
        tree,
        merged,
        processes,
        *_all_channels(kept, made, external_topics, domains),
        tuple(each.reads for each in made),
        kept.each(Standing.of, merged),
        tuple(external_topics),
        domains,
    )


@dataclass(frozen=True, slots=True)
class _Made:
    """What one node brings into the graph."""

    topics: tuple[Connection, ...]
    services: tuple[Connection, ...]
    actions: tuple[Connection, ...]
    reads: tuple[ParamRead, ...]


def _managers(tree: LaunchTree) -> list[LaunchNode | None]:
    """Of each node of a tree the manager that it is loaded into as a nodelet, if the launch starts that."""
    if not tree.ros.has_nodelets or not any(node.package == "nodelet" for node in tree.nodes):
        return [None] * len(tree.nodes)
    by_name = {node.name: node for node in tree.nodes}
    return [by_name.get(manager_of(node) or "") for node in tree.nodes]


def _of_node(node: LaunchNode, interface: Interface, manager: LaunchNode | None, generation: int, moves: bool) -> _Made:
    topics: list[Connection] = []
    services: list[Connection] = []
    actions: list[Connection] = []
    remaps = effective_remaps(node, generation)
    if manager is not None:
        remaps = _within(effective_remaps(manager, generation), remaps)
    of_actions: set[int] = set()
    for action in actions_of(interface.endpoints, generation):
        whole, parts = _connect_action(node, action, remaps, as_a_whole=moves)
        of_actions.update(map(id, action.parts))
        actions.extend(whole)
        for part in parts:
            (topics if part.endpoint.role in _TOPIC_ROLES else services).append(part)
    for endpoint in interface.endpoints:
        if endpoint.role in _TOPIC_ROLES and id(endpoint) not in of_actions:
            topics.append(_connect(node, endpoint, remaps))
        elif endpoint.role in _SERVICE_ROLES:
            services.append(_connect(node, endpoint, remaps))
    targets = {source: remap[1] for source, remap in remaps.items()}
    reads = tuple(ParamRead(names.resolve(use.name, node.name, targets), node, use) for use in interface.params)
    return _Made(tuple(topics), tuple(services), tuple(actions), reads)


def effective_remaps(node: LaunchNode, generation: int) -> dict[str, tuple[Remap | None, str]]:
    """Resolved source to the remap and its resolved target; of two for one name the later wins in ROS 1, the first one
    in ROS 2, as in the clients. In ROS 1 arguments of a node are remaps as well, before those of tags and without one
    (http://wiki.ros.org/Remapping%20Arguments)."""
    rules = ros(generation)
    ordered = reversed(node.remaps) if rules.first_remap_wins else node.remaps
    found: dict[str, tuple[Remap | None, str]] = {}
    if not rules.ament and ":=" in node.args:
        for given, target in remaps_in(split_args(node.args)):
            found[names.resolve(given, node.name)] = None, names.resolve(target, node.name)
    for remap in ordered:
        source = source_for(remap.source, node.name) if rules.remaps_of_nodes else remap.source
        if source is not None:
            found[names.resolve(source, node.name)] = remap, names.resolve(remap.target, node.name)
    return found


def _within(
    outer: Mapping[str, tuple[Remap | None, str]], own: Mapping[str, tuple[Remap | None, str]]
) -> dict[str, tuple[Remap | None, str]]:
    """The remaps of a nodelet whose manager has `outer`. roscpp applies those of its process to both sides of what a
    handle is given, so that the manager's win (`ros::NodeHandle::initRemappings`, seen with a real manager)."""

    def moved(name: str) -> str:
        return outer[name][1] if name in outer else name

    return {**outer, **{moved(source): (remap, moved(target)) for source, (remap, target) in own.items()}}


def _connect(node: LaunchNode, endpoint: Endpoint, remaps: Mapping[str, tuple[Remap | None, str]]) -> Connection:
    full = names.resolve(endpoint.name, node.name)
    if full in remaps:
        remap, target = remaps[full]
        return Connection(target, node, endpoint, remap)
    return Connection(full, node, endpoint, None)


def _connect_action(
    node: LaunchNode, action: ActionEndpoint, remaps: Mapping[str, tuple[Remap | None, str]], *, as_a_whole: bool
) -> tuple[list[Connection], list[Connection]]:
    """The action and what it is made of. It is none any more, but topics and services, where remaps move those apart.

    A remap of the action's own name moves all of them where the client library looks it up before it appends the names.
    """
    endpoint = action.endpoint
    base, remap = names.resolve(endpoint.name, node.name), None
    if endpoint.md5 is not None:
        # Told by a client library, which had moved the name when it made the topics (rospy: if it is written alike).
        remap = next((r for r, target in remaps.values() if target == base), None)
    elif base in remaps and as_a_whole:
        remap, base = remaps[base]
    moved_names: list[tuple[str, Remap | None]] = []
    for part in action.names:
        moved = remaps.get(f"{base}/{part}")
        moved_names.append((moved[1], moved[0]) if moved is not None else (f"{base}/{part}", remap))
    full, remap = moved_names[0][0].removesuffix(f"/{action.names[0]}"), moved_names[0][1]
    together = [name for name, _ in moved_names] == [f"{full}/{part}" for part in action.names]
    parts = [
        Connection(name, node, end, moved_by, full if together else None)
        for (name, moved_by), end in zip(moved_names, action.parts, strict=True)
    ]
    return [Connection(full, node, endpoint, remap)] if together else [], parts


def _named(kept: Kept, services: Sequence[Connection]) -> Sequence[Connection]:
    """A client that told only its MD5 sum has the type of the server of that sum, if its own server does not have it of
    the only one in the graph."""
    if not any(kept.each(_has_no_type, services)):
        return services
    types: dict[tuple[str | None, str], set[str]] = {}
    for server in services:
        end = server.endpoint
        if end.role == "service" and end.type and end.md5:
            for name in (server.name, None):
                types.setdefault((name, end.md5), set()).add(end.type)

    def named(client: Connection) -> Connection:
        if not _has_no_type(client):
            return client
        end = client.endpoint
        found = types.get((client.name, end.md5 or "")) or types.get((None, end.md5 or "")) or set()
        return replace(client, endpoint=replace(end, type=next(iter(found)))) if len(found) == 1 else client

    return [named(connection) for connection in services]


def _has_no_type(client: Connection) -> bool:
    end = client.endpoint
    return end.role == "client" and end.type is None and bool(end.md5)


def _all_channels(
    kept: Kept, made: Sequence[_Made], external: Sequence[str], domains: Domains
) -> tuple[dict[str, Channel], dict[str, Channel], dict[str, Channel]]:
    """Topics, services and actions."""
    connections = (
        chain.from_iterable(each.topics for each in made),
        _named(kept, [*chain.from_iterable(each.services for each in made)]),
        chain.from_iterable(each.actions for each in made),
    )
    grouped = [kept.grouped(_name, kind, each) for kind, each in enumerate(connections)]
    sorted_names = [sorted(groups) for groups in grouped]
    is_external = re.compile("|".join(fnmatch.translate(pattern) for pattern in external)).match if external else None
    outside = [
        kind == 0 and is_external is not None and is_external(name) is not None
        for kind in range(3)
        for name in sorted_names[kind]
    ]
    channels = iter(
        kept.each_row(
            _channel,
            (
                chain.from_iterable(sorted_names),
                [groups[name] for groups, found in zip(grouped, sorted_names, strict=True) for name in found],
                outside,
            ),
        )
    )
    topics, services, actions = (
        _by_domain(kept, kind, {name: next(channels) for name in found}, domains)
        for kind, found in enumerate(sorted_names)
    )
    return topics, services, actions


def _by_domain(kept: Kept, kind: int, channels: dict[str, Channel], domains: Domains) -> dict[str, Channel]:
    """Each channel whose ends cannot reach each other as several of the same name."""
    if not domains.by_node or domains.bridged is None:
        return channels
    found: dict[str, Channel] = {}
    for name, channel in channels.items():
        if name in domains.bridged:
            found[name] = channel
            continue
        of_ends = tuple(domains.by_node[id(each.node)] for each in (*channel.providers, *channel.consumers))
        found.update((part.key, part) for part in kept.get(_parts, (kind, name), channel, of_ends))
    return found


def _parts(channel: Channel, of_ends: tuple[Domain | None, ...]) -> tuple[Channel, ...]:
    ends = (*channel.providers, *channel.consumers)
    groups = groups_apart(of_ends)
    if len(groups) < 2:
        return (channel,)
    parts = []
    for domains in groups:
        own = {id(end) for end, domain in zip(ends, of_ends, strict=True) if domain in domains}
        apart = separation(groups[0][0], domains[0]) if domains is not groups[0] else None
        parts.append(
            replace(
                channel,
                providers=tuple(each for each in channel.providers if id(each) in own),
                consumers=tuple(each for each in channel.consumers if id(each) in own),
                domain=f"{apart.variable} {apart.other}" if apart is not None else "",
                apart=tuple(each for each in ends if id(each) not in own),
            )
        )
    return tuple(parts)


def _name(connection: Connection) -> str:
    return connection.name


def _channel(name: str, connections: Sequence[Connection], external: bool) -> Channel:
    alike: dict[tuple[object, ...], Connection] = {}
    for each in connections:
        end = each.endpoint
        alike.setdefault((id(each.node), end.role, end.type, end.md5), each)
    providers = tuple(each for each in alike.values() if each.endpoint.role in PROVIDERS)
    consumers = tuple(each for each in alike.values() if each.endpoint.role not in PROVIDERS)
    return Channel(name, providers, consumers, external)
