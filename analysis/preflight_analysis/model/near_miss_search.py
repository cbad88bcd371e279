"""Which provider each consumer without another end was most likely meant for."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from operator import itemgetter
from typing import NamedTuple

from preflight_analysis.evaluation import names
from preflight_analysis.graph.model import Channel, ChannelKind, Connection
from preflight_analysis.incremental.derived import derived
from preflight_analysis.incremental.kept import Before
from preflight_analysis.model.alike import Names
from preflight_analysis.model.channels import channels_of
from preflight_analysis.model.context import Context
from preflight_analysis.model.dangling import GENERIC_PACKAGES, all_dangling_consumers
from preflight_analysis.model.near_miss import NearMiss, given_name
from preflight_analysis.model.near_miss_evidence import Rank, best_rank, known_type, near_miss
from preflight_analysis.model.nearest import share_words

_FEW = 16
"""Channels that are others than before: where there are more, all consumers are looked at again."""


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
    near = tuple(context.whole(_found, kind, tuple(consumers), channels, graph.blind > 0).near.values())
    if not graph.domains.by_node:
        return near
    return tuple(each for each in near if graph.domains.apart(each.consumer.node, each.provider.node) is None)


class _Choice(NamedTuple):
    """The channel that a consumer was most likely meant for, and how well it fits; None where none does."""

    consumer: Connection
    best: tuple[Channel, Rank] | None

    @property
    def near(self) -> NearMiss | None:
        """What that says."""
        return near_miss(self.consumer, *self.best) if self.best is not None else None


class _Found(NamedTuple):
    """By the ids of the consumers."""

    choices: Mapping[int, _Choice]
    near: Mapping[int, NearMiss]


def _found(
    before: Before[_Found] | None, consumers: tuple[Connection, ...], channels: tuple[Channel, ...], blind: bool
) -> _Found:
    """What a consumer was meant for is what it was, unless that channel went or one that came fits better."""
    (_, last, _), was = before if before is not None else (((), (), False), _Found({}, {}))
    gone = {*map(id, last)}
    new = [each for each in channels if id(each) not in gone]
    gone.difference_update(map(id, channels))
    offered, came = _Offered(channels), _Offered(new)
    known = was.choices if len(new) <= _FEW else {}
    choices: dict[int, _Choice] = {}
    for consumer in consumers:
        choice = known.get(id(consumer))
        if choice is None or choice.consumer is not consumer or (choice.best and id(choice.best[0]) in gone):
            choice = _Choice(consumer, offered.best(consumer))
        else:
            better = came.best(consumer) if new else None
            if better is not None and (choice.best is None or better[1] < choice.best[1]):
                choice = _Choice(consumer, better)
        choices[id(consumer)] = choice
    near: dict[int, NearMiss] = {}
    for key, choice in choices.items():
        said = was.near.get(key) if known.get(key) is choice else None
        said = said or choice.near
        if said is not None and not (blind and not said.strong) and not offered.is_ambiguous(said):
            near[key] = said
    return _Found(choices, near)


class _Offered:
    """What is offered, by what it may be taken for."""

    def __init__(self, channels: Sequence[Channel]) -> None:
        self._channels = channels
        self._pairs: dict[str | None, list[Channel]] = {}
        for each in channels:
            for type_ in {known_type(end) for end in each.providers}:
                self._pairs.setdefault(type_, []).append(each)
        self._pools: dict[str | None, Names[Channel]] = {}

    def _pool(self, type_: str | None) -> Names[Channel]:
        if type_ not in self._pools:
            self._pools[type_] = Names(
                (name, each) for each in self._pairs.get(type_, ()) for name in _names(each, type_)
            )
        return self._pools[type_]

    def _like(self, consumer: Connection) -> Mapping[str, Channel]:
        """The channels that a consumer may be meant for, by their names."""
        type_ = known_type(consumer)
        if type_ is None:
            every = (self._pool(each).typos(consumer.name) for each in self._pairs)
            return {name: channel for found in every for name, channel in found.items()}
        pools = [self._pool(each) for each in (type_, None) if each in self._pairs]
        found = (*(each for pool in pools for each in _like(pool, consumer)), *self._before_remaps(consumer)[:1])
        return {channel.name: channel for channel in found}

    def _before_remaps(self, consumer: Connection) -> Sequence[Channel]:
        """What had the name of the consumer before a remap at one of the two."""
        return self._given.get((known_type(consumer), given_name(consumer)), ())

    @cached_property
    def _given(self) -> Mapping[tuple[str | None, str], Sequence[Channel]]:
        """The channels of each type by the names that their providers have before remaps."""
        found: dict[tuple[str | None, str], list[Channel]] = {}
        for type_, some in self._pairs.items():
            for each in some:
                for name in {given_name(end) for end in each.providers if known_type(end) == type_}:
                    found.setdefault((type_, name), []).append(each)
        return found

    def best(self, consumer: Connection) -> tuple[Channel, Rank] | None:
        """The best of those that are like it, and how well it fits."""
        among = self._like(consumer).values()
        ranks = ((each, best_rank(consumer, each, consumer.node)) for each in among)
        return min(((each, rank) for each, rank in ranks if rank is not None), key=itemgetter(1), default=None)

    @cached_property
    def _kinds(self) -> Counter[tuple[str, str]]:
        return Counter(
            (type_, names.leaf(each.name)) for type_, some in self._pairs.items() if type_ is not None for each in some
        )

    @cached_property
    def _lone(self) -> Counter[tuple[str, str, str]]:
        return Counter(
            (side, end.endpoint.type or "", names.leaf(each.name))
            for each in self._channels
            if not each.providers or not each.consumers
            for side, ends in (("providers", each.providers), ("consumers", each.consumers))
            for end in ends
        )

    def is_ambiguous(self, near: NearMiss) -> bool:
        """Whether the last name alone speaks for it, or a namespace, and others of the type have it too: which of them
        was meant, if any?"""
        type_, leaf = near.consumer.endpoint.type or "", names.leaf(near.consumer.name)
        if near.likeness == "words" and leaf == names.leaf(near.provider.name):
            spaces = map(names.parent, (near.consumer.name, near.provider.name))
            return self._kinds[type_, leaf] > 1 and not share_words(*spaces)
        if near.likeness == "remap":
            return len(self._before_remaps(near.consumer)) != 1
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
