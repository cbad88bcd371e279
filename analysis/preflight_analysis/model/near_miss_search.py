"""Which provider each consumer without another end was most likely meant for."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from operator import itemgetter

from preflight_analysis.evaluation import names
from preflight_analysis.graph.model import Channel, ChannelKind, Connection
from preflight_analysis.incremental.derived import derived
from preflight_analysis.incremental.kept import Before
from preflight_analysis.model.alike import Names
from preflight_analysis.model.channels import channels_of
from preflight_analysis.model.context import Context
from preflight_analysis.model.dangling import GENERIC_PACKAGES, all_dangling_consumers
from preflight_analysis.model.near_miss import NearMiss
from preflight_analysis.model.near_miss_evidence import best_rank, known_type, near_miss
from preflight_analysis.model.nearest import share_words


@derived
def near_misses(context: Context, kind: ChannelKind) -> tuple[NearMiss, ...]:
    """For each consumer that dangles the provider that it was most likely meant for, if there is one.

    Where what is not known of some node may well be the other end, only strong evidence counts.
    """
    graph, consumers = context.graph, all_dangling_consumers(context)[kind]
    if graph is None or not consumers:
        return ()
    # Of one name in several domains the first one.
    channels = tuple(each for each in channels_of(context)[kind] if not (graph.domains.by_node and each.domain))
    near = context.whole(_near_misses, kind, tuple(consumers), channels, graph.blind > 0)
    if not graph.domains.by_node:
        return near
    return tuple(each for each in near if graph.domains.apart(each.consumer.node, each.provider.node) is None)


def _near_misses(
    before: Before[tuple[NearMiss, ...]] | None,
    consumers: tuple[Connection, ...],
    channels: tuple[Channel, ...],
    blind: bool,
) -> tuple[NearMiss, ...]:
    offered, found = _Offered(channels), list[NearMiss]()
    was = {id(each.consumer): each for each in (before[1] if before is not None else ())}
    for consumer in consumers:
        near = offered.meant_for(consumer)
        if near is not None and not (blind and not near.strong) and not offered.is_ambiguous(near):
            known = was.get(id(consumer))
            # What was made of it is found again.
            found.append(known if known is not None and known.is_that(near) else near)
    return tuple(found)


class _Offered:
    """What is offered, by what it may be taken for."""

    def __init__(self, channels: Sequence[Channel]) -> None:
        pairs = [(type_, each) for each in channels for type_ in {known_type(end) for end in each.providers}]
        self._of_type = {
            type_: Names((name, each) for of, each in pairs if of == type_ for name in _names(each, type_))
            for type_ in {type_ for type_, _ in pairs}
        }
        self._kinds = Counter((type_, names.leaf(each.name)) for type_, each in pairs if type_ is not None)
        self._lone = Counter(
            (side, end.endpoint.type or "", names.leaf(each.name))
            for each in channels
            if not each.providers or not each.consumers
            for side, ends in (("providers", each.providers), ("consumers", each.consumers))
            for end in ends
        )

    def meant_for(self, consumer: Connection) -> NearMiss | None:
        """The best of those that are like it."""
        type_ = known_type(consumer)
        pools = [self._of_type[each] for each in (type_, None) if each in self._of_type]
        among = {channel.name: channel for pool in pools for channel in _like(pool, consumer)}
        if type_ is None:
            among = {name: each for pool in self._of_type.values() for name, each in pool.typos(consumer.name).items()}
        ranks = ((each, best_rank(consumer, each, consumer.node)) for each in among.values())
        found = min(((each, rank) for each, rank in ranks if rank is not None), key=itemgetter(1), default=None)
        return near_miss(consumer, *found) if found is not None else None

    def is_ambiguous(self, near: NearMiss) -> bool:
        """Whether the last name alone speaks for it, or a namespace, and others of the type have it too: which of them
        was meant, if any?"""
        type_, leaf = near.consumer.endpoint.type or "", names.leaf(near.consumer.name)
        if near.likeness == "words" and leaf == names.leaf(near.provider.name):
            spaces = map(names.parent, (near.consumer.name, near.provider.name))
            return self._kinds[type_, leaf] > 1 and not share_words(*spaces)
        if near.likeness not in ("slash", "level") or not type_.startswith(GENERIC_PACKAGES):
            return False
        return any(self._lone[side, type_, leaf] > 1 for side in ("providers", "consumers"))


def _names(channel: Channel, type_: str | None) -> Iterator[str]:
    """That of the channel, and what it is called below the namespaces of those who offer it."""
    yield channel.name
    for end in channel.providers:
        if end.remap is None and known_type(end) == type_ and (below := _below(end)) is not None:
            yield below


def _like(pool: Names[Channel], consumer: Connection) -> Iterator[Channel]:
    yield from pool.alike(consumer.name).values()
    below = _below(consumer)
    yield from pool.named(below) if below is not None else ()
    yield from pool.named(consumer.name)


def _below(end: Connection) -> str | None:
    """The name below the namespace of the node; None in no namespace."""
    space = names.parent(end.node.name).rstrip("/")
    return end.name.removeprefix(space) if space and end.name.startswith(f"{space}/") else None
