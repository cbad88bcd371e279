"""Why one node hears another, or does not: a chain of links from the publisher to the subscriber.

Each link names one thing that has to be so: both nodes are started, both endpoints exist, the names are equal after
namespaces and remaps, types and QoS fit, both nodes are in one domain of one middleware. The first broken link is the
answer.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Literal

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.graph.domains import differences, domain_of, processes_of
from preflight_analysis.graph.model import ChannelKind, Connection, Graph
from preflight_analysis.graph.qos import policies
from preflight_analysis.model.clock import publishes_clock
from preflight_analysis.model.fit import type_misfit
from preflight_analysis.model.lifecycle import inactive
from preflight_analysis.model.nearest import nearest
from preflight_analysis.model.places import attribute_location, connection_location
from preflight_analysis.model.reach import meant_pairs
from preflight_analysis.model.variables import setting_of
from preflight_analysis.queries.enclosing import conditions_of, namespaces_of
from preflight_analysis.tracing.interface import DOES, Endpoint, Interface
from preflight_analysis.workspace.workspace import Analysis

State = Literal["ok", "broken", "unknown"]

KINDS: tuple[ChannelKind, ...] = ("topics", "services", "actions")
_NOUN: Mapping[ChannelKind, str] = {"topics": "topic", "services": "service", "actions": "action"}
_DOMAINS, _QOS = "GRF001", "QOS001"
_LISTED = 8
"""Names in one text."""


class NoSuchNodeError(Exception):
    """The launch starts no node of that name. `near` are those that may be meant."""

    def __init__(self, name: str, near: Sequence[str]) -> None:
        super().__init__(name)
        self.name, self.near = name, tuple(near)


@dataclass(frozen=True, slots=True)
class Link:
    """One link of a chain; `about` says which kind: `started`, `interface`, `endpoint`, `name`, `type`, `qos`,
    `environment`, `lifecycle`, `clock`."""

    about: str
    state: State
    text: str
    location: Location | None = None
    fixes: tuple[Fix, ...] = ()


@dataclass(frozen=True, slots=True)
class Chain:
    """From `provider` to `consumer` (full names of nodes), over one topic, service or action. `channel` is its final
    name where both ends have the same one; `provided` and `consumed` are those of each end."""

    kind: ChannelKind
    channel: str | None
    provider: str
    consumer: str
    links: tuple[Link, ...]
    provided: str | None = None
    consumed: str | None = None

    @property
    def broken(self) -> Link | None:
        """The first link that breaks."""
        return first_broken(self.links)

    @property
    def unknown(self) -> int:
        """How many links are not known."""
        return sum(link.state == "unknown" for link in self.links)

    @property
    def noun(self) -> str:
        """`topic`, `service` or `action`."""
        return _NOUN[self.kind]

    @property
    def verdict(self) -> str:
        """Whether they are connected, in a line."""
        over = f" over the {self.noun} '{self.channel}'" if self.channel is not None else ""
        pair = f"{self.provider} -> {self.consumer}{over}"
        if self.broken is not None:
            return f"{pair}: not connected: {self.broken.text}"
        if not self.unknown:
            return f"{pair}: connected"
        links = "link is" if self.unknown == 1 else "links are"
        state = "no broken link" if self.channel is not None else "no topic, service or action is known that they share"
        return f"{pair}: {state}; {self.unknown} {links} unknown"


def first_broken(links: Iterable[Link]) -> Link | None:
    """The first link that breaks."""
    return next((link for link in links if link.state == "broken"), None)


def node_named(nodes: Iterable[LaunchNode], name: str) -> LaunchNode:
    """The node of a full name, or of a last part that only one has. Raises `NoSuchNodeError`."""
    by_name = {node.name: node for node in nodes}
    found = by_name.get(name) or by_name.get(f"/{name}")
    if found is not None:
        return found
    alike = [node for full, node in by_name.items() if names.leaf(full) == name]
    if len(alike) == 1:
        return alike[0]
    if alike:
        raise NoSuchNodeError(name, [node.name for node in alike])
    near = nearest(names.leaf(name), map(names.leaf, by_name))
    raise NoSuchNodeError(name, [full for full in by_name if names.leaf(full) == near])


def chains(analysis: Analysis, graph: Graph, first: str, second: str, channel: str | None = None) -> tuple[Chain, ...]:
    """The chains between two nodes, one for each topic, service or action that they share, or for the ends that may be
    meant for each other; over `channel` alone if given: a final name, or one as the nodes' code has it.

    From `first` to `second`; the other way round where nothing leads there. Raises `NoSuchNodeError`.
    """
    a, b = node_named(graph.tree.nodes, first), node_named(graph.tree.nodes, second)
    for provider, consumer in ((a, b), (b, a)):
        found = [
            chain
            for kind in KINDS
            for pair in _pairs(analysis, graph, kind, (provider, consumer), channel)
            for chain in [_chain(analysis, graph, kind, *pair)]
        ]
        if found:
            return tuple(found)
    return (_no_pair(analysis, graph, a, b, channel),)


def _pairs(
    analysis: Analysis, graph: Graph, kind: ChannelKind, nodes: tuple[LaunchNode, LaunchNode], channel: str | None
) -> list[tuple[Connection, Connection]]:
    """The ends by which the first of two nodes reaches the second one, or else those that were meant to meet."""
    provider, consumer = nodes
    provided, consumed = graph.ends_of(provider, kind)[0], graph.ends_of(consumer, kind)[1]
    if channel is not None:
        provided = [each for each in provided if _is_called(each, channel)] or provided
        consumed = [each for each in consumed if _is_called(each, channel)] or consumed
        if not any(_is_called(each, channel) for each in (*provided, *consumed)):
            return []
    by_name = {each.name: each for each in consumed}
    same = [(each, by_name[each.name]) for each in provided if each.name in by_name]
    if same:
        return same
    asked = {*map(id, provided)}, {*map(id, consumed)}
    found = meant_pairs(analysis.context, kind)
    meant = [(one, other) for one, other in found if id(one) in asked[0] and id(other) in asked[1]]
    known = {id(other) for _, other in meant}
    return meant + _likely_pairs(provided, [each for each in consumed if id(each) not in known])


def _is_called(connection: Connection, name: str) -> bool:
    name = name.partition(" ")[0]  # views add the domain to it
    written = connection.endpoint.name
    return name in (connection.name, written) or connection.name == f"/{name}" or names.leaf(connection.name) == name


def _likely_pairs(
    provided: Sequence[Connection], consumed: Sequence[Connection]
) -> list[tuple[Connection, Connection]]:
    """For each that is consumed what may be meant for it by the one who asks about these two nodes: of the same last
    name, of a near one, of the same type if it is the only one."""
    found = []
    for consumer in consumed:
        leaf = names.leaf(consumer.name)
        by_leaf = {names.leaf(each.name): each for each in provided}
        near = leaf if leaf in by_leaf else nearest(leaf, by_leaf)
        of_type = [each for each in provided if each.endpoint.type and each.endpoint.type == consumer.endpoint.type]
        if near is not None:
            found.append((by_leaf[near], consumer))
        elif len(of_type) == 1:
            found.append((of_type[0], consumer))
    return found


def _no_pair(analysis: Analysis, graph: Graph, a: LaunchNode, b: LaunchNode, channel: str | None) -> Chain:
    """The chain where no ends fit: what each of the two is known to do."""
    kind: ChannelKind = "topics"
    over = f"'{channel}'" if channel is not None else "the other"
    links = [
        *_of_node(analysis, graph, a),
        *_of_node(analysis, graph, b),
        _ends_known(graph, kind, a, over),
        _ends_known(graph, kind, b, over),
    ]
    return Chain(kind, None, a.name, b.name, tuple(links))


def _ends_known(graph: Graph, kind: ChannelKind, node: LaunchNode, over: str) -> Link:
    provided, consumed = (sorted({each.name for each in side}) for side in graph.ends_of(node, kind))
    does = [f"{verb} {listed(ends)}" for verb, ends in (("publishes", provided), ("subscribes to", consumed)) if ends]
    text = f"no endpoint of {node.name} fits {over}; it {' and '.join(does) or 'has no topic'}"
    interface = _interface(graph, node)
    if not interface.complete:
        return Link("endpoint", "unknown", f"{text}; its interface is not completely known", node.location)
    return Link("endpoint", "broken", text, node.location)


def listed(found: Sequence[str]) -> str:
    """Names in one text, the first ones of many."""
    more = f" and {len(found) - _LISTED} more" if len(found) > _LISTED else ""
    return ", ".join(found[:_LISTED]) + more


def _interface(graph: Graph, node: LaunchNode) -> Interface:
    return next(interface for each, interface in zip(graph.tree.nodes, graph.interfaces, strict=True) if each is node)


def _chain(analysis: Analysis, graph: Graph, kind: ChannelKind, provider: Connection, consumer: Connection) -> Chain:
    links = (
        *_of_node(analysis, graph, provider.node),
        *_endpoint(analysis, provider),
        *_of_node(analysis, graph, consumer.node),
        *_endpoint(analysis, consumer),
        _name(analysis, kind, provider, consumer),
        _type(provider, consumer),
        *(_qos(provider, consumer) if kind == "topics" and graph.tree.ros.has_qos else ()),
        *_environment(analysis, graph, provider, consumer),
        *_clock(graph, provider.node, consumer.node),
    )
    channel = consumer.name if provider.name == consumer.name else None
    return Chain(kind, channel, provider.node.name, consumer.node.name, links, provider.name, consumer.name)


def _of_node(analysis: Analysis, graph: Graph, node: LaunchNode) -> Iterator[Link]:
    when = " after a timer or an event" if node.deferred else ""
    yield Link("started", "ok", f"{node.name} is started{when}", node.location)
    for condition in conditions_of(analysis.context, node):
        yield Link("started", "ok", f"{node.name} is started under the condition {condition.text}", condition.place)
    interface = _interface(graph, node)
    outcome = interface.outcome
    if outcome.status == "crashed" and not interface.complete:
        yield Link("interface", "broken", f"{node.name} crashes on start: {outcome.reason}", node.location)
    elif interface.source == "none":
        reason = f": {outcome.reason}" if outcome.reason else ""
        yield Link("interface", "unknown", f"the interface of {node.name} is not known{reason}", node.location)
    lost = inactive(analysis.context, node)
    if lost is not None:
        place = attribute_location(analysis.context, node, "exec")
        yield Link("lifecycle", "broken", f"lifecycle node {node.name} {lost.reason}", place)


def _endpoint(analysis: Analysis, connection: Connection) -> Iterator[Link]:
    end, node = connection.endpoint, connection.node
    written = names.canonicalize(end.name)
    text = f"{node.name} {DOES[end.role]} '{written}'"
    remap = connection.remap
    if remap is not None:
        text += f", remapped to '{connection.name}'"
    elif connection.name != written:
        text += f", which resolves to '{connection.name}'"
    if end.source_file is not None and end.source_line is not None:
        text += f" ({names.leaf(end.source_file)}:{end.source_line})"
    text += _evidence(connection)
    state: State = "unknown" if end.uncertain else "ok"
    yield Link("endpoint", state, text, connection_location(connection))
    if connection.name != written and not written.startswith("/"):
        for space in namespaces_of(analysis.context, connection.node):
            yield Link("endpoint", "ok", f"{node.name} is in the namespace {space.text}", space.place)


def _evidence(connection: Connection) -> str:
    end = connection.endpoint
    if end.evidence.source == "similar":
        return "; seen in a run with another configuration"
    if end.evidence.said_by:
        return f"; from {end.evidence.said_by}"
    if end.displayed:
        return "; from its configuration"
    if end.evidence.inferred:
        return "; from its source" + (", under a condition" if end.evidence.conditional else "")
    return ""


def _name(analysis: Analysis, kind: ChannelKind, provider: Connection, consumer: Connection) -> Link:
    decides = next((each for each in (consumer, provider) if each.is_placed), consumer)
    place = connection_location(decides)
    if provider.name == consumer.name:
        return Link("name", "ok", f"both use the {_NOUN[kind]} '{consumer.name}'", place)
    text = f"'{provider.name}' and '{consumer.name}' are different {_NOUN[kind]} names"
    return Link("name", "broken", text, place, _fixes(analysis, provider, consumer))


def _fixes_of(analysis: Analysis, rule: str, *connections: Connection) -> tuple[Fix, ...]:
    """Those of the findings of a rule that speak of all these ends."""
    wanted = {(each.name, each.node.name) for each in connections}
    found = (each for each in analysis.offered if each.rule == rule)
    return next((f.fixes for f in found if wanted <= {(ref.channel, ref.node) for ref in f.endpoints}), ())


def _fixes(analysis: Analysis, *connections: Connection) -> tuple[Fix, ...]:
    """Those of the findings that speak of these ends, the ones that speak of both first."""
    wanted = {(each.name, each.node.name) for each in connections}

    def both(finding: Finding) -> int:
        return -len(wanted & {(ref.channel, ref.node) for ref in finding.endpoints})

    found: dict[tuple[object, ...], Fix] = {}
    for finding in sorted(analysis.offered, key=both):
        if both(finding):
            for fix in finding.fixes:
                found.setdefault(fix.edits, fix)
    return tuple(found.values())


def _type(provider: Connection, consumer: Connection) -> Link:
    mine, theirs = consumer.endpoint.type, provider.endpoint.type
    if "*" in (mine, theirs):
        return Link("type", "ok", f"any type fits ({theirs if mine == '*' else mine})")
    misfit = type_misfit(consumer, provider)
    if misfit is not None:
        return Link("type", "broken", misfit.reason, consumer.node.location)
    if mine is None or theirs is None:
        who = consumer if mine is None else provider
        return Link("type", "unknown", f"the type that {who.node.name} uses is not known")
    same = mine if mine == theirs else f"{theirs}, which {consumer.node.name} calls {mine}"
    return Link("type", "ok", f"both use the type {same}")


def _qos(provider: Connection, consumer: Connection) -> Iterator[Link]:
    ends = provider.endpoint, consumer.endpoint
    found = [*qos_links(*ends, provider.node.name, consumer.node.name, consumer.node.location)]
    yield from found or [Link("qos", "unknown", "the QoS of both ends is not known")]


def qos_links(
    offering: Endpoint, requesting: Endpoint, provider: str, consumer: str, place: Location | None = None
) -> Iterator[Link]:
    """One link for each policy that an end is known to set; `provider` and `consumer` are the names of the nodes."""
    states: Mapping[str, State] = {"compatible": "ok", "incompatible": "broken", "unknown": "unknown"}
    for policy in policies(offering, requesting):
        offered, requested = (
            "none" if value is None else f"{value} s" if isinstance(value, (int, float)) else value.replace("_", " ")
            for value in (policy.offered, policy.requested)
        )
        if policy.fit == "unknown":
            offered = "unknown" if policy.offered is None else offered
            requested = "unknown" if policy.requested is None else requested
        text = f"QoS {policy.name.replace('_', ' ')}: {provider} offers {offered}, {consumer} requests {requested}"
        yield Link("qos", states[policy.fit], text, place)


def _environment(analysis: Analysis, graph: Graph, provider: Connection, consumer: Connection) -> Iterator[Link]:
    processes = {id(node): process for node, process in zip(graph.tree.nodes, processes_of(graph.tree), strict=True)}
    mine, theirs = (
        domain_of(processes[id(end.node)], analysis.environment.variables, graph.tree.generation)
        for end in (consumer, provider)
    )
    if mine is None or theirs is None:
        return
    bridged = graph.domains.bridged
    for each in differences(theirs, mine):
        text = f"{each.variable} differs: {provider.node.name} has {each.one}, {consumer.node.name} has {each.other}"
        settings = (
            setting_of(analysis.context, processes[id(end.node)], each.variable) for end in (consumer, provider)
        )
        place = next((setting for setting in settings if setting is not None), consumer.node.location)
        if not each.separates:
            yield Link("environment", "unknown", text, place)
        elif bridged is None:
            yield Link("environment", "unknown", f"{text}; a bridge may connect them", place)
        elif provider.name in bridged or consumer.name in bridged:
            yield Link("environment", "ok", f"{text}; a bridge carries '{consumer.name}'", place)
        else:
            yield Link("environment", "broken", text, place, _fixes_of(analysis, _DOMAINS, provider, consumer))


def _clock(graph: Graph, provider: LaunchNode, consumer: LaunchNode) -> Iterator[Link]:
    """Whether the nodes are on one clock, and whether that runs."""
    uses = {id(node): _sim_time(graph, node) for node in (provider, consumer)}
    on = [node for node in (provider, consumer) if uses[id(node)] is not None]
    if not on:
        return
    alike = publishes_clock(graph, provider) == publishes_clock(graph, consumer)
    if len(on) == 1 and provider is not consumer and alike:
        off = consumer if on[0] is provider else provider
        clocks = (each.node for each in graph.providers_for(on[0], "topics", "/clock"))
        if not any(each is off for each in clocks):
            text = f"{on[0].name} uses simulated time, {off.name} does not: their times differ"
            yield Link("clock", "unknown", text, off.location)
    node, param = on[-1], uses[id(on[-1])]
    place = param.place if param is not None else node.location
    publishing = {each.node.name for each in graph.providers_for(node, "topics", "/clock")}
    publishers = sorted(publishing | {each.name for each in graph.tree.nodes if publishes_clock(graph, each)})
    if publishers:
        text = f"{node.name} uses simulated time; /clock is published by {listed(publishers)}"
        yield Link("clock", "ok", text, place)
    elif not graph.is_external("/clock"):
        text = f"{node.name} uses simulated time, and no node of this launch publishes /clock"
        yield Link("clock", "unknown", text, place)


def _sim_time(graph: Graph, node: LaunchNode) -> Param | None:
    """The parameter that puts a node on simulated time."""
    if graph.tree.ros.own_parameters:
        param = next((each for each in node.params if each.name == "use_sim_time"), None)
    else:
        param = graph.tree.params.get("/use_sim_time")
    return param if param is not None and param.value in (True, 1) else None
