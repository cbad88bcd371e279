"""Whom a name reaches: who was meant to be at the other end of a topic, service or action that has one side only, and
who may be there unseen. Rules, `why` and hover ask here; who is there has the graph."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import field
from itertools import chain
from typing import Literal, NamedTuple, TypeVar

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation import names
from preflight_analysis.findings.doubt import doubts
from preflight_analysis.graph.model import Channel, ChannelKind, Connection, Graph
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.channels import not_all_known
from preflight_analysis.model.context import Context
from preflight_analysis.model.dangling import (
    by_type,
    dangling_consumers,
    dangling_providers,
    lone_of_type,
    read_otherwise,
)
from preflight_analysis.model.fit import double_types, qos_misfits, separations, type_misfits
from preflight_analysis.model.idle_remaps import idle_remaps
from preflight_analysis.model.moveit import known_to_moveit, unserved
from preflight_analysis.model.near_miss import NearMiss, given_name
from preflight_analysis.model.near_miss_search import near_misses
from preflight_analysis.model.nearest import nearest_typo, numbers_in, share_words
from preflight_analysis.model.remaps_elsewhere import Elsewhere, used_elsewhere
from preflight_analysis.model.well_known import may_dangle

V = TypeVar("V")


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
    count, unknown = len(graph.tree.nodes), len(graph.incomplete)
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


@derived
def of_same_type(context: Context) -> Mapping[int, Connection]:
    """For subscribers without a publisher, by id, the only publisher of their type that nobody subscribes to, where the
    type is specific. Of what a display might show instead its type says nothing."""
    found = unmet(context, "topics")
    others = [each for each in found.consumers if id(each) not in found.elsewhere and not each.endpoint.displayed]
    if not others:
        return {}
    dangling = by_type(context, "topics", dangling_providers(context, "topics"))
    of_types = [dangling.get(each.endpoint.type, ()) for each in others]
    lone = context.each_row(lone_of_type, (others, of_types))
    return {id(each): meant for each, meant in zip(others, lone, strict=True) if meant is not None}


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
    yield from _taken(context, kind)


@derived
def _meant(context: Context, kind: ChannelKind) -> Mapping[int, Connection]:
    """For each end that was meant to meet another one, by id, that one."""
    found: dict[int, Connection] = {}
    for provider, consumer in meant_pairs(context, kind):
        found.setdefault(id(provider), consumer)
        found.setdefault(id(consumer), provider)
    return found


def meant_by_text(context: Context, topic: str, wanted: Literal["publisher", "subscriber"]) -> Connection | None:
    """The end that a topic was probably meant to reach which only a text names, as the arguments of a recorder or of a
    player: that of the nearest name that differs by a slip, to a subscriber only where nobody publishes. None where the
    topic is known, and where it may be that of a node of which nothing is known."""
    graph = context.graph
    if graph is None or graph.blind or graph.is_external(topic) or graph.is_of_unknown("topics", topic):
        return None
    there = graph.topics.get(topic)
    if there is not None and (there.consumers or wanted == "publisher"):
        return None  # of what others subscribe to and nobody publishes their own findings speak
    ends = (
        (name, each.providers if wanted == "publisher" else each.consumers if not each.providers else ())
        for name, each in graph.topics.items()
    )
    found = {name: some[0] for name, some in ends if some}
    near = nearest_typo(topic, found)
    return found[near] if near is not None else None


def why_nobody(context: Context, kind: ChannelKind, channel: Channel) -> str | None:
    """Of a side of a channel that has nobody who is meant to be there, or else who may be there, in words; None where
    both sides have somebody."""
    graph = context.graph
    there = channel.providers or channel.consumers
    if graph is None or not there or (channel.providers and channel.consumers):
        return None
    taken = crossed(context) if kind == "topics" else {}
    if (pair := _first(taken, there)) is not None:
        end, other = pair
        return f"{end.node.name} is remapped to '{end.name}' of {other.node.name}"
    if (meant := _first(_meant(context, kind), there)) is not None:
        return f"did you mean '{meant.name}' of {meant.node.name}?"
    ends = {*map(id, there)}
    apart = chain.from_iterable(separations(graph, each) for each in graph.named(kind, channel.name))
    for each in apart if channel.apart else ():
        if not ends.isdisjoint((id(each.consumer), id(each.provider))):
            return each.reason
    if not graph.blind and (named := _first(unmet(context, kind).elsewhere, there)) is not None:
        return f"did you mean '{named.name}'?"
    alike = of_same_type(context) if kind == "topics" and not graph.blind else {}
    if (same := _first(alike, there)) is not None:
        return f"'{same.name}' of {same.node.name} has the same type and no subscriber"
    if kind == "topics" and channel.providers and channel.name in read_otherwise(context):
        return "it is read in another transport"
    outside = channel.external or all(may_dangle(channel.name, each.endpoint) for each in there)
    found = doubts(
        OUTSIDE=outside,
        NOT_ANALYSED=not outside and (graph.is_of_unknown(kind, channel.name) or _lacks(context)),
        OTHER_LAUNCH=not outside,
    )
    return "; ".join(each.reason.sentence for each in found)


@derived
def _lacks(context: Context) -> str | bool:
    return context.graph is not None and not_all_known(context.graph)


def _first(found: Mapping[int, V], ends: Iterable[Connection]) -> V | None:
    return next((found[id(each)] for each in ends if id(each) in found), None)


_SIDES: Mapping[ChannelKind, tuple[str, str]] = {
    "topics": ("publisher", "subscriber"),
    "services": ("server", "client"),
    "actions": ("server", "client"),
}


def notes(context: Context, kind: ChannelKind, channel: Channel) -> tuple[str, ...]:
    """What there is to say of a channel, in words: that a side has nobody, and why; what keeps ends that are there from
    each other; who was taken to it by a remap."""
    found: list[str] = []
    why = why_nobody(context, kind, channel)
    if why is not None:
        side = _SIDES[kind][bool(channel.providers)]
        found.append(f"no {side}" + (f"; {why}" if why else ""))
    found += (each.reason for each in type_misfits(channel))
    if kind == "topics":
        found += (each.reason for each in double_types(channel))
    if kind == "topics" and context.tree.ros.has_qos:
        found += (each.reason for each in qos_misfits(channel))
    ends = {*map(id, channel.consumers)}
    found += (
        f"nobody subscribes to '{own.name}' of {own.node.name}, the name of {end.node.name} without its remap"
        for own, end in _taken(context, kind)
        if id(end) in ends
    )
    return tuple(dict.fromkeys(found))


def _taken(context: Context, kind: ChannelKind) -> Iterator[tuple[Connection, Connection]]:
    """The pairs of `crossed`: a publisher that nobody hears, and the subscriber that a remap took away."""
    taken = crossed(context) if kind == "topics" else {}
    if taken:
        own = {id(each): each for each in unmet(context, "topics").providers}
        yield from ((own[at], end) for at, (end, _) in taken.items())
