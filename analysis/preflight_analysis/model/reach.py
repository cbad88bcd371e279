"""Whom a name reaches: who was meant to be at the other end of a topic, service or action that has one side only, and
who may be there unseen. Rules, `why` and hover ask here; who is there has the graph."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import field
from typing import NamedTuple

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation import names
from preflight_analysis.findings.doubt import Doubt, doubts
from preflight_analysis.graph.model import Channel, ChannelKind, Connection, Graph
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.channels import not_all_known
from preflight_analysis.model.context import Context
from preflight_analysis.model.dangling import by_type, dangling_consumers, dangling_providers
from preflight_analysis.model.idle_remaps import idle_remaps
from preflight_analysis.model.moveit import known_to_moveit, unserved
from preflight_analysis.model.near_miss import NearMiss, given_name
from preflight_analysis.model.near_miss_search import near_misses
from preflight_analysis.model.nearest import numbers_in, share_words
from preflight_analysis.model.remaps_elsewhere import Elsewhere, used_elsewhere
from preflight_analysis.model.well_known import may_dangle


class Seen(NamedTuple):
    """How much is known of who is there: `lacks` are the first nodes that were not analysed as a whole, or whether
    anything else is not known, `aside` is that for a message; `blind`: a node ended before it came to its event loop,
    and nothing is known of it from elsewhere."""

    lacks: str | bool
    aside: str
    likely_complete: bool
    blind: bool


def seen(context: Context, graph: Graph) -> Seen:
    """That of a launch: the same object as before an edit that leaves it alone, as findings are kept by it."""
    count, unknown = len(graph.tree.nodes), graph.incomplete
    aside = f"; {unknown} of {count} nodes not fully analysed" if unknown else ""
    return context.one(Seen, "", not_all_known(graph), aside, graph.likely_complete, graph.blind > 0)


@dataclass(frozen=True, slots=True)
class Unmet:
    """The ends of a kind that have no other one in the launch: `near` are those that were probably meant to meet,
    `consumers` and `providers` all others. What may well be used or served from outside is not among them, nor what
    something else explains: a remap without effect that was meant for the end, MoveIt's controllers, a nodelet's
    manager.
    `elsewhere` has what the files around call some of them, by id."""

    near: tuple[NearMiss, ...] = ()
    consumers: tuple[Connection, ...] = ()
    providers: tuple[Connection, ...] = ()
    elsewhere: Mapping[int, Elsewhere] = field(default_factory=dict)


@derived
def unmet(context: Context, kind: ChannelKind) -> Unmet:
    """Those of a launch."""
    graph = context.graph
    if graph is None:
        return Unmet()
    remapped = _remapped(context)
    consumers = [each for each in dangling_consumers(context, kind) if not _is_explained(context, kind, each)]
    asking = {id(each) for each in consumers} - remapped
    pairs = near_misses(context, kind)
    near = tuple(each for each in pairs if id(each.consumer) in asking and id(each.provider) not in remapped)
    asking.difference_update(id(each.consumer) for each in near)
    if kind == "topics" and len(graph.tree.nodes) == 1:
        # RViz alone shows what another launch publishes.
        asking.difference_update(id(each) for each in consumers if each.endpoint.displayed)
    offered = {id(each.provider) for each in pairs} | remapped
    return Unmet(
        near,
        tuple(each for each in consumers if id(each) in asking),
        tuple(each for each in dangling_providers(context, kind) if id(each) not in offered),
        used_elsewhere(context) if kind != "actions" else {},
    )


@derived
def _remapped(context: Context) -> frozenset[int]:
    """The ids of the ends that a remap without effect was meant to bring together."""
    return frozenset(id(end) for pair in _by_remaps(context) for end in pair)


@derived
def _by_remaps(context: Context) -> tuple[tuple[Connection, Connection], ...]:
    found = ((each.meant, each.partner) for each in idle_remaps(context))
    return tuple((meant, partner) for meant, partner in found if meant is not None and partner is not None)


def _is_explained(context: Context, kind: ChannelKind, end: Connection) -> bool:
    if kind == "services":
        # A nodelet asks its manager to be loaded: LCH034 says where that is not there.
        return end.endpoint.type == "nodelet/NodeletLoad" and end.node.package == "nodelet"
    return kind == "actions" and (id(end.node), end.name) in _of_moveit(context)


@derived
def _of_moveit(context: Context) -> frozenset[tuple[int, str]]:
    """Actions of controllers: MVT001 reports them, by more than the name; others have one that the launch loads."""
    wrong = (each.known for each in unserved(context))
    served = (each for each in known_to_moveit(context) if each.loaded is not None)
    return frozenset((id(each.node), each.action) for each in (*wrong, *served))


@derived
def awaited(context: Context) -> Mapping[int, Connection]:
    """For clients without a server that their node was seen to wait for before it did anything else, by id: the one
    service of its type that nobody calls and that has a word in common."""
    graph = context.graph
    pairs = zip(graph.tree.nodes, graph.interfaces, strict=True) if graph is not None else ()
    answers = {id(node): interface.outcome.answers for node, interface in pairs if interface.outcome.answers}
    if not answers:
        return {}
    unused = by_type(context, "services", dangling_providers(context, "services"))
    clients = unmet(context, "services").consumers
    found = ((each, _offer(each, answers.get(id(each.node), ()), unused)) for each in clients)
    return {id(client): offer for client, offer in found if offer is not None}


def _offer(
    client: Connection, answers: Iterable[str], unused: Mapping[str | None, Sequence[Connection]]
) -> Connection | None:
    given = {client.name, client.endpoint.name, names.resolve(client.endpoint.name, client.node.name)}
    if not any(answer.startswith(f"it waits for the service {name}, ") for name in given for answer in answers):
        return None
    alike = [
        offer
        for offer in unused.get(client.endpoint.type, ())
        if client.endpoint.type
        and offer.node is not client.node
        and not offer.endpoint.uncertain
        and share_words(offer.name, client.name)
        and numbers_in(offer.name) == numbers_in(client.name)
    ]
    return alike[0] if len(alike) == 1 else None


@derived
def crossed(context: Context) -> Mapping[int, tuple[Connection, Connection]]:
    """For publishers without a subscriber, by id, the only one that a remap took to a like publisher in another
    namespace, where its own like listens already, and that publisher."""
    graph = context.graph
    lone = unmet(context, "topics").providers if graph is not None else ()
    names_of_lone = {each.name for each in lone}
    moved: dict[str, list[tuple[Connection, Channel]]] = {}
    for channel in graph.topics.values() if graph is not None and lone else ():
        for end in channel.consumers if channel.providers else ():
            if end.remap is not None and (name := given_name(end)) in names_of_lone:
                moved.setdefault(name, []).append((end, channel))
    found: dict[int, tuple[Connection, Connection]] = {}
    for each in lone if moved else ():
        pairs = [pair for end, channel in moved.get(each.name, ()) if (pair := _crossing(each, end, channel))]
        if len(pairs) == 1:
            found[id(each)] = pairs[0]
    return found


def _crossing(own: Connection, end: Connection, channel: Channel) -> tuple[Connection, Connection] | None:
    if end.endpoint.type != own.endpoint.type or own.endpoint.type in (None, "*"):
        return None
    other = next((each for each in channel.providers if _are_siblings(each, own)), None)
    taken = any(_are_siblings(each, end) and each.remap is None for each in channel.consumers)
    return (end, other) if other is not None and taken else None


def _are_siblings(one: Connection, other: Connection) -> bool:
    """Whether two nodes of one program in two namespaces have the end alike."""
    a, b = one.node, other.node
    alike = (a.package, a.executable, a.plugin) == (b.package, b.executable, b.plugin) and a.namespace != b.namespace
    return alike and (one.endpoint.name, one.endpoint.role) == (other.endpoint.name, other.endpoint.role)


def meant_pairs(context: Context, kind: ChannelKind) -> Iterator[tuple[Connection, Connection]]:
    """The ends of a kind that were probably meant to meet and do not, whatever says so, each provider with its
    consumer."""
    for each in unmet(context, kind).near:
        yield each.provider, each.consumer
    graph = context.graph
    for one, other in _by_remaps(context) if graph is not None else ():
        if kind == ("topics" if one.endpoint.role in ("publisher", "subscriber") else "services"):
            yield (one, other) if one.endpoint.role in ("publisher", "service") else (other, one)
    if kind == "services":
        clients = {id(each): each for each in unmet(context, kind).consumers}
        yield from ((offer, clients[client]) for client, offer in awaited(context).items())


class Absence(NamedTuple):
    """That a side of a channel has nobody in the launch: `meant` is who was meant to be there, `elsewhere` the name
    that the files around have for it, `doubts` why somebody may be there all the same."""

    meant: Connection | None
    elsewhere: Elsewhere | None
    doubts: tuple[Doubt, ...]

    @property
    def reason(self) -> str:
        """Who is meant, or else who may be there, in words."""
        if self.meant is not None:
            return f"did you mean '{self.meant.name}' of {self.meant.node.name}?"
        if self.elsewhere is not None:
            return f"did you mean '{self.elsewhere.name}'?"
        return "; ".join(each.reason.sentence for each in self.doubts)


def absence(context: Context, kind: ChannelKind, channel: Channel) -> Absence | None:
    """What is known of the side of a channel that has nobody; None where both have somebody."""
    graph = context.graph
    there = channel.providers or channel.consumers
    if graph is None or not there or (channel.providers and channel.consumers):
        return None
    ends = {id(each) for each in there}
    for provider, consumer in meant_pairs(context, kind):
        if id(provider) in ends or id(consumer) in ends:
            return Absence(consumer if id(provider) in ends else provider, None, ())
    found = unmet(context, kind)
    named = next((found.elsewhere[each] for each in ends if each in found.elsewhere), None)
    outside = channel.external or all(may_dangle(channel.name, each.endpoint) for each in there)
    return Absence(
        None,
        named,
        doubts(
            OUTSIDE=outside,
            NOT_ANALYSED=not outside and (graph.is_of_unknown(kind, channel.name) or not_all_known(graph)),
            OTHER_LAUNCH=not outside,
        ),
    )
