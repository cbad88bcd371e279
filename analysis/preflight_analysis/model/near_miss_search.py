"""Which provider each consumer without another end was most likely meant for."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from collections.abc import Set as AbstractSet
from functools import cached_property, partial
from itertools import chain
from typing import NamedTuple

from preflight_analysis.evaluation import names
from preflight_analysis.graph.model import Channel, ChannelKind, Connection
from preflight_analysis.incremental.derived import derived
from preflight_analysis.incremental.kept import Before
from preflight_analysis.model.alike import Names
from preflight_analysis.model.channels import channels_of, of_all_kinds
from preflight_analysis.model.context import Context
from preflight_analysis.model.dangling import GENERIC_PACKAGES, all_dangling_consumers
from preflight_analysis.model.near_miss import EVIDENCE, NearMiss, given_name
from preflight_analysis.model.near_miss_evidence import Rank, best_rank, dangles, is_end_of, known_type, near_miss
from preflight_analysis.model.nearest import share_words
from preflight_analysis.slips import edits


class _Sought(NamedTuple):
    """What the search for the other end of a consumer looks at: its name, that below the namespace of its node, that
    before the remap, and its type."""

    name: str
    below: str | None
    given: str
    type: str | None


class _Offer(NamedTuple):
    """What a channel may be found by: its name, or what it is called below the namespace of one who offers it, and a
    type of its providers, None where that is not known."""

    name: str
    channel: str
    type: str | None


class _Offers(NamedTuple):
    """A channel, what its providers call it before remaps, with their types, and of one that has one side alone the
    side, the type and the last part of the name of each end."""

    channel: Channel
    offers: tuple[_Offer, ...]
    given: tuple[tuple[str | None, str], ...]
    lone: tuple[tuple[str, str, str], ...]


class _Like(NamedTuple):
    """The names of channels that are like a name: those that may be so by any evidence but for words, and those that
    have words in common, the nearest first."""

    close: frozenset[str] = frozenset()
    words: tuple[str, ...] = ()


class _Judged(NamedTuple):
    """What came of a consumer: of the channels of the names that are like its own, and of the one that had its name
    before a remap."""

    consumer: Connection
    like: _Like
    moved: Channel | None
    near: NearMiss | None


class _Found(NamedTuple):
    """What is like each name, among what is offered by which channels, what came of that for each consumer, by its id,
    and what is to be told."""

    like: Mapping[_Sought, _Like] = {}
    among: AbstractSet[_Offer] = frozenset()
    channels: Mapping[str, Channel] = {}
    judged: Mapping[int, _Judged] = {}
    near: tuple[NearMiss, ...] = ()


@derived
def near_misses(context: Context, kind: ChannelKind) -> tuple[NearMiss, ...]:
    """For each consumer that dangles the provider that it was most likely meant for, if there is one.

    Where what is not known of some node may well be the other end, only strong evidence counts.
    """
    return _all_near_misses(context)[kind]


@derived
def _all_near_misses(context: Context) -> Mapping[ChannelKind, tuple[NearMiss, ...]]:
    graph, consumers = context.graph, all_dangling_consumers(context)
    if graph is None or not any(consumers.values()):
        return dict.fromkeys(consumers, ())
    # Of one name in several domains the first one.
    channels = {
        kind: tuple(each for each in some if not (graph.domains.by_node and each.domain)) if consumers[kind] else ()
        for kind, some in channels_of(context).items()
    }
    offers, sought = of_all_kinds(context, _offers, channels), of_all_kinds(context, _sought, consumers)
    found: dict[ChannelKind, tuple[NearMiss, ...]] = {}
    for kind in channels:
        near = context.whole(_found, kind, consumers[kind], sought[kind], offers[kind], graph.blind > 0).near
        if graph.domains.by_node:
            near = tuple(each for each in near if not graph.domains.apart(each.consumer.node, each.provider.node))
        found[kind] = near
    return found


def _found(
    before: Before[_Found] | None,
    consumers: tuple[Connection, ...],
    sought: tuple[_Sought, ...],
    offers: tuple[_Offers, ...],
    blind: bool,
) -> _Found:
    was = before[1] if before is not None else _Found()
    offered = _Offered(offers)
    among = frozenset(offered.all)
    like = _like(was, dict.fromkeys(sought), among)
    changed = {name for name, channel in offered.by_name.items() if was.channels.get(name) is not channel}
    judged: dict[int, _Judged] = {}
    found: list[NearMiss] = []
    for consumer, each in zip(consumers, sought, strict=True):
        alike, moved = like[each], offered.before_remaps(each)[:1] if each.type is not None else ()
        if not (moved or alike.close or alike.words):
            continue
        known, first = was.judged.get(id(consumer)), moved[0] if moved else None
        if (
            known is None
            or (known.consumer is not consumer or known.like is not alike or known.moved is not first)
            or not (changed.isdisjoint(alike.close) and changed.isdisjoint(alike.words))
        ):
            close = (*(offered.by_name[name] for name in sorted(alike.close)), *moved)
            words = tuple([offered.by_name[name] for name in alike.words])
            known = _Judged(consumer, alike, first, _meant(consumer, close, words))
        judged[id(consumer)] = known
        near = known.near
        if near is not None and (near.strong or not blind) and not offered.is_ambiguous(near, each):
            found.append(near)
    return _Found(like, among, offered.by_name, judged, tuple(found))


def _meant(consumer: Connection, close: tuple[Channel, ...], words: tuple[Channel, ...]) -> NearMiss | None:
    """The best of the channels that are like a consumer."""
    best: tuple[Rank, Channel] | None = None
    for channel in close:
        rank = best_rank(consumer, channel, consumer.node)
        if rank is not None and (best is None or rank < best[0]):
            best = rank, channel
    if best is None or best[0] >= _BY_WORDS:
        fitting = ((best_rank(consumer, each, consumer.node), each) for each in words if dangles(each))
        nearest = next(((rank, each) for rank, each in fitting if rank is not None), None)
        if nearest is not None and (best is None or nearest[0] < best[0]):
            best = nearest
    return near_miss(consumer, best[1], best[0]) if best is not None else None


_BY_WORDS: Rank = (True, False, EVIDENCE.index("words"), 0, "", 0)
"""No rank of names that have but words in common is better."""


def _sought(consumer: Connection) -> _Sought:
    return _Sought(consumer.name, _below(consumer), given_name(consumer), known_type(consumer))


def _offers(channel: Channel) -> _Offers:
    ends = [(known_type(end), end) for end in channel.providers]
    offers = [_Offer(name, channel.name, type_) for type_, end in ends for name in _names(channel, end)]
    given = dict.fromkeys((type_, given_name(end)) for type_, end in ends)
    return _Offers(channel, tuple(dict.fromkeys(offers)), tuple(given), tuple(_lone_ends(channel)))


def _lone_ends(channel: Channel) -> Iterator[tuple[str, str, str]]:
    leaf = names.leaf(channel.name)
    for side, ends, others in (
        ("providers", channel.providers, channel.consumers),
        ("consumers", channel.consumers, channel.providers),
    ):
        if not others:
            yield from ((side, end.endpoint.type or "", leaf) for end in ends)


def _like(was: _Found, sought: Iterable[_Sought], among: AbstractSet[_Offer]) -> Mapping[_Sought, _Like]:
    """What is like each name. Not asked by name, as each depends on all names that are offered: what is like one is
    what it was without those that went, and with those that came."""
    came, gone = among - was.among, {each.channel for each in was.among - among}
    known = was.like if len(came) <= _FEW else {}
    pools, new = _Pools(among), _Pools(came)
    found: dict[_Sought, _Like] = {}
    for each in sought:
        like = known.get(each)
        if like is None or (gone and not (gone.isdisjoint(like.close) and gone.isdisjoint(like.words))):
            like = pools.like(each)
        elif came and (more := new.like(each)) != _NOTHING:
            like = _Like(like.close | more.close, _nearest_first(each.name, {*like.words, *more.words}))
        found[each] = like
    return found


_FEW = 16
"""Names that come: where there are more, what is like each name is looked for again."""
_NOTHING = _Like()


class _Pools:
    """Names that are offered, by type."""

    def __init__(self, offers: Iterable[_Offer]) -> None:
        self._offers = offers
        self._pools: dict[str | None, Names[str]] = {}

    def _pool(self, type_: str | None) -> Names[str]:
        """The names that a consumer of that type may be meant for, each with that of its channel."""
        if type_ not in self._pools:
            some = [each for each in self._offers if type_ is None or each.type is None or each.type == type_]
            self._pools[type_] = Names(dict.fromkeys((each.name, each.channel) for each in some))
        return self._pools[type_]

    def like(self, sought: _Sought) -> _Like:
        """What is like a name."""
        name, pool = sought.name, self._pool(sought.type)
        if sought.type is None:
            return _Like(frozenset([other for _, other in pool.typos(name)]))
        close = frozenset(chain(pool.close(name), pool.named(name), pool.named(sought.below) if sought.below else ()))
        alike: Iterator[tuple[str, str]]
        if sought.type.startswith(GENERIC_PACKAGES):
            alike = ((other, channel) for other, channel in pool.ending_alike(name) if is_end_of(name, other))
        else:
            alike = pool.alike(name)
        return _Like(close, _nearest_first(name, {other for other, channel in alike if other == channel}))


def _nearest_first(name: str, others: Iterable[str]) -> tuple[str, ...]:
    return tuple(sorted(sorted(others), key=partial(edits, name)))


class _Offered:
    """What is offered of a kind, by what it may be taken for."""

    def __init__(self, offers: Sequence[_Offers]) -> None:
        self._offers = [each for each in offers if each.offers]
        self._all = offers
        self.all = tuple([offer for each in self._offers for offer in each.offers])
        self.by_name = {each.channel.name: each.channel for each in self._offers}

    def before_remaps(self, sought: _Sought) -> Sequence[Channel]:
        """What had the name of the consumer before a remap at one of the two."""
        return self._given.get((sought.type, sought.given), ())

    @cached_property
    def _given(self) -> Mapping[tuple[str | None, str], Sequence[Channel]]:
        """The channels of each type by the names that their providers have before remaps."""
        found: dict[tuple[str | None, str], list[Channel]] = {}
        for each in self._offers:
            for key in each.given:
                found.setdefault(key, []).append(each.channel)
        return found

    @cached_property
    def _kinds(self) -> Counter[tuple[str, str]]:
        return Counter(
            (type_, names.leaf(each.channel.name))
            for each in self._offers
            for type_ in {each.type for each in each.offers}
            if type_ is not None
        )

    @cached_property
    def _several(self) -> AbstractSet[tuple[str, str]]:
        """Types, and last parts of names, of which several ends have one side alone."""
        lone = Counter(chain.from_iterable([each.lone for each in self._all]))
        return {(type_, leaf) for (_, type_, leaf), count in lone.items() if count > 1}

    def is_ambiguous(self, near: NearMiss, sought: _Sought) -> bool:
        """Whether the last name alone speaks for it, or a namespace, and others of the type have it too: which of them
        was meant, if any?"""
        type_, leaf = near.consumer.endpoint.type or "", names.leaf(near.consumer.name)
        if near.likeness == "words" and leaf == names.leaf(near.provider.name):
            spaces = map(names.parent, (near.consumer.name, near.provider.name))
            return self._kinds[type_, leaf] > 1 and not share_words(*spaces)
        if near.likeness == "remap":
            return len(self.before_remaps(sought)) != 1
        if near.likeness not in ("slash", "level") or not type_.startswith(GENERIC_PACKAGES):
            return False
        return (type_, leaf) in self._several


def _names(channel: Channel, end: Connection) -> Iterator[str]:
    yield channel.name
    if end.remap is None and (below := _below(end)) is not None:
        yield below


def _below(end: Connection) -> str | None:
    """The name below the namespace of the node; None in no namespace."""
    space = names.parent(end.node.name).rstrip("/")
    return end.name.removeprefix(space) if space and end.name.startswith(f"{space}/") else None
