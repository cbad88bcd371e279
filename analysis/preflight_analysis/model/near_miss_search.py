"""Which provider each consumer without another end was most likely meant for.

Names, types and namespaces are compared, whosever they are: what comes out of that is kept for all consumers that are
alike, while nodes come, go and are renamed. That no node is meant for itself is looked at after that.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import field
from operator import is_, itemgetter

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation import names
from preflight_analysis.graph.model import Channel, ChannelKind, Connection
from preflight_analysis.incremental.derived import derived
from preflight_analysis.incremental.kept import Before
from preflight_analysis.model.channels import channels_of, of_all_kinds
from preflight_analysis.model.context import Context
from preflight_analysis.model.dangling import GENERIC_PACKAGES, all_dangling_consumers
from preflight_analysis.model.near_miss import NearMiss
from preflight_analysis.model.near_miss_evidence import best_rank, dangles, known_type, near_miss
from preflight_analysis.model.nearest import numbers_in, share_words
from preflight_analysis.model.nearest_memory import NOTHING, Best, Hit, Pools, Search, search


@derived
def near_misses(context: Context, kind: ChannelKind) -> tuple[NearMiss, ...]:
    """For each consumer that dangles the provider that it was most likely meant for, if there is one.

    Where what is not known of some node may well be the other end, only strong evidence counts.
    """
    graph, seekers = context.graph, _all_seekers(context)[kind]
    if graph is None or not seekers:
        return ()
    candidates = _all_candidates(context)[kind]
    near = context.whole(_found, kind, candidates, seekers, graph.blind > 0).near
    if not graph.domains.by_node:
        return near
    return tuple(each for each in near if graph.domains.apart(each.consumer.node, each.provider.node) is None)


_Node = tuple[str, int]
"""A node's name, and how many of that name are before it."""
_Kind = tuple[str, str]
"""A type, empty where none is known, and the last part of a name."""
_Mark = tuple[str, str, str]
"""What is counted of channels by kind: `offered`, or the only side that there is."""


@dataclass(frozen=True, eq=False, slots=True)
class _Shape:
    """What a comparison looks at of a channel. One that is alike stays the same object."""

    name: str
    described: Hashable
    pools: Pools


@dataclass(frozen=True, eq=False, slots=True)
class _Candidate:
    """A channel, with the nodes that take part. `shape` is None where nothing is offered."""

    channel: Channel
    shape: _Shape | None
    nodes: frozenset[_Node]
    marks: tuple[_Mark, ...]


@dataclass(frozen=True, eq=False, slots=True)
class _Seeker:
    """A consumer, with what a comparison looks at of it, and the pools of the channels that it may be meant for."""

    consumer: Connection
    node: _Node
    described: Hashable
    """Equal for those that are alike."""
    pools: Pools
    kind: _Kind


@dataclass(frozen=True, eq=False, slots=True)
class _Choice:
    """What a seeker was most likely meant for, of the best hits of all that are like it."""

    seeker: _Seeker
    best: Best
    looked_at: frozenset[str] | None
    """The channels that this depends on, None: on all."""
    near: NearMiss | None


@dataclass(frozen=True, eq=False, slots=True)
class _Found:
    candidates: Mapping[str, _Candidate] = field(default_factory=dict)
    shapes: Mapping[str, _Shape] = field(default_factory=dict)
    search: Search = NOTHING
    marks: Counter[_Mark] = field(default_factory=Counter)
    choices: tuple[_Choice, ...] = ()
    """Of all seekers, in their order."""
    near: tuple[NearMiss, ...] = ()


@derived
def _all_candidates(context: Context) -> Mapping[ChannelKind, tuple[_Candidate, ...]]:
    """Those of each kind, in the order of the graph; of one name in several domains the first one."""
    channels = channels_of(context)
    if context.graph is not None and context.graph.domains.by_node:
        channels = {kind: [each for each in some if not each.domain] for kind, some in channels.items()}
    return of_all_kinds(context, _candidate, channels, _namesakes(context))


@derived
def _all_seekers(context: Context) -> Mapping[ChannelKind, tuple[_Seeker, ...]]:
    return of_all_kinds(context, _seeker, all_dangling_consumers(context), _namesakes(context))


@derived
def _namesakes(context: Context) -> Mapping[int, int]:
    """Of nodes with the name of one before them, by id, how many of those there are."""
    nodes = context.graph.tree.nodes if context.graph is not None else ()
    if len({node.name for node in nodes}) == len(nodes):
        return {}
    seen: Counter[str] = Counter()
    found: dict[int, int] = {}
    for node in nodes:
        if seen[node.name]:
            found[id(node)] = seen[node.name]
        seen[node.name] += 1
    return found


def _candidate(channel: Channel, namesakes: Mapping[int, int]) -> _Candidate:
    # What a near miss has to share: the type, and the numbers in the name (`/robot3/scan`) or its last segment. In a
    # fleet of like robots that leaves few to compare.
    leaf, numbers = names.leaf(channel.name), numbers_in(channel.name)
    nodes = frozenset(_node(each, namesakes) for each in (*channel.providers, *channel.consumers))
    marks: list[_Mark] = []
    if not channel.providers or not channel.consumers:
        side = "providers" if channel.providers else "consumers"
        marks = [(side, each.endpoint.type or "", leaf) for each in channel.providers or channel.consumers]
    if not channel.providers:
        return _Candidate(channel, None, nodes, tuple(marks))
    types = frozenset(map(known_type, channel.providers))
    marks += [("offered", type_, leaf) for type_ in types if type_ is not None]
    pools = tuple(pool for type_ in types for pool in ((), (type_,), (type_, numbers), (type_, leaf)))
    shape = _Shape(channel.name, (dangles(channel), *map(_described, channel.providers)), pools)
    return _Candidate(channel, shape, nodes, tuple(marks))


def _seeker(consumer: Connection, namesakes: Mapping[int, int]) -> _Seeker:
    described = consumer.name, *_described(consumer)
    kind = consumer.endpoint.type or "", names.leaf(consumer.name)
    return _Seeker(consumer, _node(consumer, namesakes), described, _pools(consumer), kind)


def _pools(consumer: Connection) -> Pools:
    type_, numbers = known_type(consumer), numbers_in(consumer.name)
    if type_ is None:
        return ((),)
    if not numbers:
        return ((type_,), (None,))
    return tuple((t, more) for t in (type_, None) for more in (numbers, (), names.leaf(consumer.name)))


def _described(connection: Connection) -> tuple[Hashable, ...]:
    given = connection.endpoint
    return names.parent(connection.node.name), connection.remap is None, given.name, given.type, given.builtin


def _node(connection: Connection, namesakes: Mapping[int, int]) -> _Node:
    return connection.node.name, namesakes.get(id(connection.node), 0)


def _found(
    before: Before[_Found] | None, candidates: tuple[_Candidate, ...], seekers: tuple[_Seeker, ...], blind: bool
) -> _Found:
    known, was_blind = (before[1], before[0][2]) if before is not None else (_Found(), blind)
    now = {each.channel.name: each for each in candidates}
    changed = {name for name, each in now.items() if known.candidates.get(name) is not each}
    changed |= known.candidates.keys() - now.keys()
    shapes = _shapes(known, now, changed)
    if shapes is known.shapes and _search_alike(known.choices, seekers):
        searched = known.search
    else:
        searched = _searched(known.search, shapes.values(), seekers, now)
    marks, recounted = _marks(known, now, changed)
    # Hundreds of choices of which a handful is new: each test is one pass.
    was = tuple(map({id(each.seeker): each for each in known.choices}.get, map(id, seekers)))
    again = [each is None or each.looked_at is None or not changed.isdisjoint(each.looked_at) for each in was]
    if searched is not known.search:
        again = [
            yes or each is None or searched.best[each.seeker.described] is not each.best
            for yes, each in zip(again, was, strict=True)
        ]
    if recounted:
        again = [yes or seeker.kind in recounted for yes, seeker in zip(again, seekers, strict=True)]
    before_of = {id(each.seeker.consumer): each for each in known.choices} if any(again) else {}
    choices = tuple(
        each
        if each is not None and not yes and was_blind == blind
        else _choice(before_of.get(id(seeker.consumer)), seeker, searched.best[seeker.described], now, marks, blind)
        for each, yes, seeker in zip(was, again, seekers, strict=True)
    )
    near = tuple(choice.near for choice in choices if choice.near is not None)
    if len(near) == len(known.near) and all(map(is_, near, known.near)):
        near = known.near
    return _Found(now, shapes, searched, marks, choices, near)


def _search_alike(choices: Sequence[_Choice], seekers: Sequence[_Seeker]) -> bool:
    """Whether seekers that are alike were looked for the last time."""
    return len(choices) == len(seekers) and all(
        choice.seeker is seeker or choice.seeker.described == seeker.described
        for choice, seeker in zip(choices, seekers, strict=True)
    )


def _shapes(known: _Found, now: Mapping[str, _Candidate], changed: Iterable[str]) -> Mapping[str, _Shape]:
    """Those of all candidates, by name, the ones of before where they are alike; the same mapping where all are."""
    news = {name: now[name].shape if name in now else None for name in changed}
    different = {name: new for name, new in news.items() if not _are_alike(known.shapes.get(name), new)}
    if not different:
        return known.shapes
    shapes = {name: shape for name, shape in known.shapes.items() if name not in different}
    shapes.update((name, shape) for name, shape in different.items() if shape is not None)
    return shapes


def _are_alike(one: _Shape | None, other: _Shape | None) -> bool:
    return one is other or (one is not None and other is not None and one.described == other.described)


def _searched(
    before: Search, shapes: Iterable[_Shape], seekers: Iterable[_Seeker], now: Mapping[str, _Candidate]
) -> Search:
    alike = {seeker.described: seeker for seeker in seekers}

    def rate(described: Hashable, shape: _Shape) -> Hit | None:
        rank = best_rank(alike[described].consumer, now[shape.name].channel, None)
        return Hit(rank, shape) if rank is not None else None

    pools = {described: seeker.pools for described, seeker in alike.items()}
    return search(before, pools, {shape: shape.pools for shape in shapes}, rate)


def _marks(known: _Found, now: Mapping[str, _Candidate], changed: Iterable[str]) -> tuple[Counter[_Mark], set[_Kind]]:
    """How often there is each mark, and the kinds of which there are others now."""
    difference = Counter[_Mark]()
    for name in changed:
        difference.subtract(known.candidates[name].marks if name in known.candidates else ())
        difference.update(now[name].marks if name in now else ())
    marks = known.marks.copy()
    marks.update(difference)
    return +marks, {mark[1:] for mark, count in difference.items() if count}


def _choice(
    was: _Choice | None,
    seeker: _Seeker,
    best: Best,
    now: Mapping[str, _Candidate],
    marks: Mapping[_Mark, int],
    blind: bool,
) -> _Choice:
    consumer, of_hits = seeker.consumer, [now[hit.candidate.name] for hit in best.hits]
    looked_at: frozenset[str] | None = frozenset(each.channel.name for each in of_hits)
    of_others = next((at for at, each in enumerate(of_hits) if seeker.node not in each.nodes), None)
    among = of_hits if of_others is None else of_hits[: of_others + 1]
    if of_others is None and best.more:
        pools, looked_at = {*seeker.pools}, None
        among = [each for each in now.values() if each.shape is not None and not pools.isdisjoint(each.shape.pools)]
    ranks = ((each.channel, best_rank(consumer, each.channel, consumer.node)) for each in among)
    found = min(((channel, rank) for channel, rank in ranks if rank is not None), key=itemgetter(1), default=None)
    near = near_miss(consumer, *found) if found is not None else None
    if near is not None:
        if (blind and not near.strong) or _is_ambiguous(near, seeker.kind, marks):
            near = None
        elif was is not None and was.near is not None and was.near.is_that(near):
            near = was.near  # what was made of it is found again
    return _Choice(seeker, best, looked_at, near)


def _is_ambiguous(near: NearMiss, kind: _Kind, marks: Mapping[_Mark, int]) -> bool:
    """Whether the last name alone speaks for it, or a namespace, and others of the type have it too: which of them
    was meant, if any?"""
    type_, leaf = kind
    if near.likeness == "words" and leaf == names.leaf(near.provider.name):
        spaces = map(names.parent, (near.consumer.name, near.provider.name))
        return marks.get(("offered", *kind), 0) > 1 and not share_words(*spaces)
    if near.likeness not in ("slash", "level") or not type_.startswith(GENERIC_PACKAGES):
        return False
    return any(marks.get((side, *kind), 0) > 1 for side in ("providers", "consumers"))
