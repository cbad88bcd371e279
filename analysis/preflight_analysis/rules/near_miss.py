"""Ends of topics or services that were probably meant to meet."""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain, islice
from typing import Any, Literal

from preflight_analysis.documents.document import Document
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import Remap
from preflight_analysis.findings.finding import Confidence, Edit, Fix, Severity
from preflight_analysis.findings.insertion import insert_child
from preflight_analysis.graph.model import Channel, ChannelKind, Connection, Graph
from preflight_analysis.incremental.kept import Before
from preflight_analysis.rules.channels import channels_of, of_all_kinds
from preflight_analysis.rules.nearest import has_all_words, likeness, numbers_in, share_words
from preflight_analysis.rules.nearest_memory import Hit, Search, search
from preflight_analysis.rules.places import connection_location
from preflight_analysis.rules.rule import Context
from preflight_analysis.rules.well_known import IMAGE_TRANSPORTS, may_dangle

_GENERIC_PACKAGES = ("std_msgs/", "std_srvs/")
"""Types that say nothing of what is carried: that two ends have the same one is no evidence."""

Evidence = Literal["typo", "slash", "level", "words"]
"""How two names are alike, the strongest first. `typo` and `words` as in `nearest`. `slash`: one end was given an
absolute name, and the other end's is the same below its node's namespace. `level`: one has a namespace more."""
_EVIDENCE: tuple[Evidence, ...] = ("typo", "slash", "level", "words")


@dataclass(frozen=True, slots=True)
class NearMiss:
    """`consumer` (a subscriber or client) has no other end; `provider` has a like name and no conflicting type."""

    consumer: Connection
    provider: Connection
    likeness: Evidence
    same_type: bool
    """Both types are known and equal."""
    provider_dangles: bool

    def is_that(self, other: NearMiss) -> bool:
        """Whether both say the same of the very same endpoints."""
        return (
            self.consumer is other.consumer
            and self.provider is other.provider
            and self.likeness == other.likeness
            and (self.same_type, self.provider_dangles) == (other.same_type, other.provider_dangles)
        )

    @property
    def site(self) -> Connection:
        """The endpoint at which it is reported: that whose name the launch file sets, else the consumer."""
        if self.consumer.remap is None and self.provider.remap is not None:
            return self.provider
        return self.consumer

    @property
    def other(self) -> Connection:
        """The endpoint that is not the site."""
        return self.provider if self.site is self.consumer else self.consumer

    @property
    def strong(self) -> bool:
        """Whether it speaks for itself, whatever else the launch may hold."""
        return self.likeness == "typo" and self.same_type

    @property
    def mendable(self) -> bool:
        """Whether the evidence will do for a change that is made for the user: like words are of other things as often
        as not (`pose`, `goal_pose`)."""
        if self.likeness == "words":
            same_leaf = names.leaf(self.consumer.name) == names.leaf(self.provider.name)
            return self.same_type and self.provider_dangles and same_leaf
        return self.same_type or self.provider_dangles

    @property
    def why(self) -> str:
        """What speaks for it, for a message: `same type x/Y; '/scan' is absolute`."""
        said = f"same type {self.consumer.endpoint.type}" if self.same_type else "type not known"
        short, long = sorted((self.consumer.name, self.provider.name), key=len)
        if self.likeness == "slash":
            return f"{said}; '{short}' is given with a leading slash, the other one is relative to its node's namespace"
        if self.likeness == "level":
            return f"{said}; they differ by the namespace '{_extra_level(short, long)}'"
        return said


def near_misses(context: Context, kind: ChannelKind) -> tuple[NearMiss, ...]:
    """For each consumer that dangles the provider that it was most likely meant for, if there is one.

    Where what is not known of some node may well be the other end, only strong evidence counts.
    """
    graph, seekers = context.graph, context.once(_all_seekers)[kind]
    if graph is None or not seekers:
        return ()
    candidates = context.once(_all_candidates)[kind]
    found = context.kept.patched(_near_misses, kind, candidates, seekers, graph.blind > 0)
    return tuple(near for near in found.near if near is not None)


@dataclass(frozen=True, eq=False, slots=True)
class _Candidate:
    """A channel with all that a comparison looks at, which is not where its ends stand."""

    channel: Channel
    key: Hashable
    """None where nothing is offered."""
    pools: tuple[Hashable, ...]
    provided: frozenset[tuple[str | None, str]]
    """The types that are offered, each with the last segment of the name."""
    lone: tuple[tuple[str, str | None, str], ...]
    """Of each end, where one side is missing, the side, the type, and that segment."""

    def is_like(self, other: _Candidate) -> bool:
        """Whether a comparison would find no difference."""
        return self is other or (self.key == other.key and self.pools == other.pools and self.lone == other.lone)


@dataclass(frozen=True, eq=False, slots=True)
class _Seeker:
    """A consumer, with the pools of the channels that it may have been meant for."""

    consumer: Connection
    key: Hashable
    pools: tuple[Hashable, ...]


@dataclass(frozen=True, eq=False, slots=True)
class _Found:
    """The best hit of each seeker, and what it says; the channels by key."""

    hits: tuple[Hit | None, ...]
    near: tuple[NearMiss | None, ...]
    channels: Mapping[Hashable, Channel]
    search: Search
    """What found them."""


def _all_candidates(context: Context) -> Mapping[ChannelKind, tuple[_Candidate, ...]]:
    """Those of each kind, in the order of the graph."""
    return of_all_kinds(context, _candidate, channels_of(context), context.once(_namesakes))


def _all_seekers(context: Context) -> Mapping[ChannelKind, tuple[_Seeker, ...]]:
    lone = context.once(_all_lone_consumers)
    consumers = {kind: tuple(chain.from_iterable(lone[kind])) for kind in lone}
    return of_all_kinds(context, _seeker, consumers, context.once(_namesakes))


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
    lone: tuple[tuple[str, str | None, str], ...] = ()
    if not channel.providers or not channel.consumers:
        side = "providers" if channel.providers else "consumers"
        lone = tuple((side, each.endpoint.type, leaf) for each in channel.providers or channel.consumers)
    if not channel.providers:
        return _Candidate(channel, None, (), frozenset(), lone)
    consumed_by = tuple(_node(each, namesakes) for each in channel.consumers)
    key = channel.name, _dangles(channel), consumed_by, *(_key(each, namesakes) for each in channel.providers)
    types = frozenset(map(_known_type, channel.providers))
    pools = tuple(pool for type_ in types for pool in ((), (type_,), (type_, numbers), (type_, leaf)))
    return _Candidate(channel, key, pools, frozenset((type_, leaf) for type_ in types), lone)


def _seeker(consumer: Connection, namesakes: Mapping[int, int]) -> _Seeker:
    return _Seeker(consumer, (consumer.name, _key(consumer, namesakes)), _pools(consumer))


def _key(connection: Connection, namesakes: Mapping[int, int]) -> Hashable:
    given = connection.endpoint
    return _node(connection, namesakes), connection.remap is None, given.name, given.type, given.builtin


def _node(connection: Connection, namesakes: Mapping[int, int]) -> tuple[str, int]:
    return connection.node.name, namesakes.get(id(connection.node), 0)


def _near_misses(
    before: Before[_Found] | None, candidates: tuple[_Candidate, ...], seekers: tuple[_Seeker, ...], blind: bool
) -> _Found:
    if before is None:
        return _compared(None, candidates, seekers, blind)
    if not _are_alike(before[0], candidates, seekers, blind):
        return _with_those_of(before[1], _compared(before[1].search, candidates, seekers, blind))
    # The same as before, said of the ends as they are now.
    (old_candidates, old_seekers, _), known = before
    changed = {now.key: now.channel for old, now in zip(old_candidates, candidates, strict=True) if old is not now}
    channels = {**known.channels, **changed}
    near = tuple(
        was
        if was is None or hit is None or (old is now and hit.candidate not in changed)
        else _near_miss(now.consumer, hit, channels)
        for was, hit, old, now in zip(known.near, known.hits, old_seekers, seekers, strict=True)
    )
    return _Found(known.hits, near, channels, known.search)


def _with_those_of(known: _Found, found: _Found) -> _Found:
    """The near misses of before for those that say the same of the same ends: what was made of them is found again."""
    old = {id(near.consumer): near for near in known.near if near is not None}
    near = tuple(
        was if each is not None and (was := old.get(id(each.consumer))) is not None and was.is_that(each) else each
        for each in found.near
    )
    return _Found(found.hits, near, found.channels, found.search)


def _are_alike(
    old: tuple[Any, ...], candidates: tuple[_Candidate, ...], seekers: tuple[_Seeker, ...], blind: bool
) -> bool:
    old_candidates, old_seekers, was_blind = old
    return (
        (len(old_candidates), len(old_seekers), was_blind) == (len(candidates), len(seekers), blind)
        and all(map(_Candidate.is_like, old_candidates, candidates))
        and all(one is other or one.key == other.key for one, other in zip(old_seekers, seekers, strict=True))
    )


def _compared(
    before: Search | None, candidates: tuple[_Candidate, ...], seekers: tuple[_Seeker, ...], blind: bool
) -> _Found:
    channels = {each.key: each.channel for each in candidates if each.key is not None}
    pools: dict[Hashable, list[Hashable]] = {pool: [] for seeker in seekers for pool in seeker.pools}
    for each in candidates:
        for pool in each.pools:
            if pool in pools:
                pools[pool].append(each.key)
    consumers = {seeker.key: seeker.consumer for seeker in seekers}

    def rate(seeker: Hashable, candidate: Hashable) -> Hit | None:
        """How well a channel fits an end."""
        hits = [*_hits(consumers[seeker], candidate, channels)]
        return min(hits, key=lambda hit: hit.rank) if hits else None

    found_now = search(before, {seeker.key: seeker.pools for seeker in seekers}, pools, rate)
    best = found_now.best
    hits = tuple(best.get(seeker.key) for seeker in seekers)
    provided = Counter(chain.from_iterable(each.provided for each in candidates))
    lone = Counter(chain.from_iterable(each.lone for each in candidates))
    near: list[NearMiss | None] = []
    for seeker, hit in zip(seekers, hits, strict=True):
        found = _near_miss(seeker.consumer, hit, channels) if hit is not None else None
        tells = found is not None and (found.strong or not blind) and not _is_ambiguous(found, provided, lone)
        near.append(found if tells else None)
    return _Found(hits, tuple(near), channels, found_now)


def _hits(consumer: Connection, candidate: Hashable, channels: Mapping[Hashable, Channel]) -> Iterator[Hit]:
    channel = channels[candidate]
    for number, kind, distance in _candidates(consumer, channel):
        how = _EVIDENCE.index(kind)
        yield Hit((how > 0, not _dangles(channel), how, distance, channel.name, number), candidate)


def _near_miss(consumer: Connection, hit: Hit, channels: Mapping[Hashable, Channel]) -> NearMiss:
    """What a hit says, with the ends as they are now."""
    channel = channels[hit.candidate]
    provider = channel.providers[hit.rank[-1]]
    known = _known_type(consumer) is not None and _known_type(provider) is not None
    return NearMiss(consumer, provider, _EVIDENCE[hit.rank[2]], known, _dangles(channel))


def _is_ambiguous(
    near: NearMiss, provided: Counter[tuple[str | None, str]], lone: Counter[tuple[str, str | None, str]]
) -> bool:
    """Whether the last name alone speaks for it, or a namespace, and others of the type have it too: which of them
    was meant, if any?"""
    type_ = near.consumer.endpoint.type or ""
    leaf = names.leaf(near.consumer.name)
    if near.likeness == "words" and leaf == names.leaf(near.provider.name):
        return provided[type_, leaf] > 1 and not share_words(
            *map(names.parent, (near.consumer.name, near.provider.name))
        )
    if near.likeness not in ("slash", "level") or not type_.startswith(_GENERIC_PACKAGES):
        return False
    return any(lone[side, type_, leaf] > 1 for side in ("providers", "consumers"))


def _dangles(channel: Channel) -> bool:
    return not channel.consumers and not channel.external


def _pools(consumer: Connection) -> tuple[Hashable, ...]:
    type_, numbers = _known_type(consumer), numbers_in(consumer.name)
    if type_ is None:
        return ((),)
    if not numbers:
        return ((type_,), (None,))
    return tuple((t, more) for t in (type_, None) for more in (numbers, (), names.leaf(consumer.name)))


def topic_near_misses(context: Context) -> tuple[NearMiss, ...]:
    """Those of topics, for which several rules ask: do so through `context.once`."""
    return near_misses(context, "topics")


def dangling_consumers(context: Context, kind: ChannelKind) -> list[Connection]:
    """Subscribers or clients without any other end, but for those that may well be served from outside."""
    return [*chain.from_iterable(context.once(_all_lone_consumers)[kind])]


def dangling_providers(context: Context, kind: ChannelKind) -> list[Connection]:
    """Publishers or servers without any other end, but for those that may well be used from outside."""
    channels = context.graph.channels(kind) if context.graph is not None else {}
    lone = context.once(_all_lone_providers)[kind]
    transported = {name.rpartition("/")[0] for name in channels if name.endswith(IMAGE_TRANSPORTS)}
    if transported:
        found = zip(channels, lone, strict=True)
        lone = tuple(() if name in transported and _read_otherwise(name, channels) else each for name, each in found)
    return [*chain.from_iterable(lone)]


_Lone = Mapping[ChannelKind, Sequence[tuple[Connection, ...]]]
"""The ends of each channel of a kind, in the order of the graph."""


def _all_lone_consumers(context: Context) -> _Lone:
    return of_all_kinds(context, _lone_consumers, channels_of(context))


def _all_lone_providers(context: Context) -> _Lone:
    return of_all_kinds(context, _lone_providers, channels_of(context))


def dangling_topic_providers(context: Context) -> list[Connection]:
    """Those of topics, for which several rules ask: do so through `context.once`."""
    return dangling_providers(context, "topics")


def _lone_consumers(channel: Channel) -> tuple[Connection, ...]:
    if channel.providers or channel.external:
        return ()
    return tuple(c for c in channel.consumers if c.action is None and not may_dangle(channel.name, c.endpoint))


def _lone_providers(channel: Channel) -> tuple[Connection, ...]:
    if channel.consumers or channel.external:
        return ()
    return tuple(c for c in channel.providers if c.action is None and not may_dangle(channel.name, c.endpoint))


def _read_otherwise(name: str, channels: Mapping[str, Channel]) -> bool:
    """Whether an image is read in another transport of the same publisher."""
    others = (channels.get(name + transport) for transport in IMAGE_TRANSPORTS)
    return any(channel.consumers and channel.providers for channel in others if channel is not None)


def by_type(connections: Iterable[Connection]) -> Mapping[str | None, list[Connection]]:
    """The ends by their types."""
    found: dict[str | None, list[Connection]] = {}
    for connection in connections:
        found.setdefault(connection.endpoint.type, []).append(connection)
    return found


def lone_of_type(consumer: Connection, dangling: Mapping[str | None, list[Connection]]) -> Connection | None:
    """The only one of the dangling providers that has the same specific type, if there is exactly one."""
    type_ = consumer.endpoint.type
    if type_ is None or type_ == "*" or type_.startswith(_GENERIC_PACKAGES):
        return None
    found = list(islice((c for c in dangling.get(type_, ()) if c.node is not consumer.node), 2))
    return found[0] if len(found) == 1 else None


def weight(near: NearMiss, complete: bool, likely_complete: bool) -> tuple[Severity, Confidence]:
    """How severe a near miss is and how sure, in a graph of which that is known: without evidence beside a like name it
    is but a hint."""
    connections = (near.consumer.endpoint, near.provider.endpoint)
    speculative = any(connection.uncertain for connection in connections)
    sure = complete and near.same_type and not speculative
    alike = near.likeness == "typo" or (near.provider_dangles and likely_complete and not _of_another_node(near))
    evidence = near.same_type and alike
    severity: Severity = (
        "info" if any(connection.assumed or connection.on_demand for connection in connections) else "warning"
    )
    return severity if evidence else "hint", "likely" if sure else "possible"


def _of_another_node(near: NearMiss) -> bool:
    """Whether the offered name is a private one and the wanted one is that of another node, which may well be started
    elsewhere: `/rectifier/image` for `/camera/image`, but not `/tracker/image` for `/old_tracker/image`."""
    private = near.provider.remap is None and near.provider.endpoint.name.startswith("~")
    if near.likeness != "words" or not private or near.consumer.name.startswith(f"{near.provider.node.name}/"):
        return False
    return not has_all_words(near.consumer.name, near.provider.name)


def nodes_looked_at(graph: Graph) -> str:
    """`none of the 3 nodes of this launch`, with how many of them are not known."""
    count, unknown = len(graph.tree.nodes), graph.incomplete
    nodes = f"none of the {count} nodes of this launch" if count > 1 else "no other node of this launch"
    return f"{nodes} ({unknown} of them not fully known)" if unknown else nodes


def fixes(near: NearMiss, consumers: Document | None, providers: Document | None) -> tuple[Fix, ...]:
    """What makes the two ends meet: the remap that gave the wrong name corrected, else a remap into a node's tag.
    `consumers` and `providers` are the texts in which the ends have their places: see `documents_of`."""
    site, other = near.site, near.other
    if not near.mendable:
        return ()
    if site.remap is not None:
        document = consumers if site is near.consumer else providers
        corrected = _correct_remap(document, site, site.remap, other.name)
        if corrected is not None:
            return (corrected,)
    # A remap at a publisher that others listen to would only move the gap to them.
    movable = (near.consumer, *((near.provider,) if near.provider_dangles else ()))
    connections = [connection for connection in movable if connection.remap is None]
    found = [
        _insert_remap(
            consumers if connection is near.consumer else providers,
            connection,
            _partner(near, connection).name,
            connection is connections[0],
        )
        for connection in connections
    ]
    return tuple(fix for fix in found if fix is not None)


def _known_type(connection: Connection) -> str | None:
    return None if connection.endpoint.type == "*" else connection.endpoint.type


def _partner(near: NearMiss, connection: Connection) -> Connection:
    return near.provider if connection is near.consumer else near.consumer


def _candidates(consumer: Connection, channel: Channel) -> Iterator[tuple[int, Evidence, int]]:
    """Which of the providers of the channel the consumer may have been meant for, how they are alike and how far they
    are apart."""
    # Most pairs have names that are not alike, and channels may have hundreds of ends: names are compared first.
    dangles, mine = _dangles(channel), _known_type(consumer)
    below = mine is not None and dangles and consumer.name.endswith(names.leaf(channel.name))
    alike = likeness(consumer.name, channel.name)
    if alike is None and not below:
        return
    for connection in channel.consumers:
        if connection.node is consumer.node:
            return  # it knows that name
    says_enough = alike is not None and (alike[0] == "typo" or _says_enough(consumer.name, channel.name, mine or ""))
    for number, provider in enumerate(channel.providers):
        if provider.endpoint.builtin or provider.node is consumer.node:
            # What a node takes in and what it gives out have like names on purpose (`points`, `points_filtered`).
            continue
        theirs = _known_type(provider)
        known = mine is not None and theirs is not None
        if (known and mine != theirs) or not (known or dangles):
            continue
        if known and below:
            short, long = (consumer, provider) if len(consumer.name) <= len(provider.name) else (provider, consumer)
            how_far = len(long.name) - len(short.name)
            if _is_slash(short, long):
                yield number, "slash", how_far
                continue
            if _extra_level(short.name, long.name) is not None:
                yield number, "level", how_far
                continue
        if alike is not None and says_enough and (alike[0] == "typo" or (known and dangles)):
            yield number, *alike


def _extra_level(short: str, long: str) -> str | None:
    """The one namespace that `long` has more than `short`, None if they differ otherwise."""
    parts, more = short.split("/"), long.split("/")
    if len(more) != len(parts) + 1:
        return None
    at = next((i for i, (a, b) in enumerate(zip(parts, more, strict=False)) if a != b), len(parts))
    return more[at] if at < len(parts) and parts[at:] == more[at + 1 :] else None


def _is_slash(short: Connection, long: Connection) -> bool:
    """Whether the shorter name is the longer one's but for a leading slash where the launch file or the node gave it
    and a namespace in which the node with the longer name lives."""
    home = names.parent(short.node.name)
    given = short.endpoint.name
    absolute = given.startswith("/") if short.remap is None else home != "/" and not short.name.startswith(home)
    relative = long.remap is None and not long.endpoint.name.startswith(("/", "~"))
    namespace = names.parent(long.node.name)
    return absolute and relative and namespace != "/" and long.name == namespace.rstrip("/") + short.name


def _says_enough(name: str, other: str, type_: str) -> bool:
    """Whether like words suffice: for a generic type only if the whole shorter name ends the longer one."""
    if not type_.startswith(_GENERIC_PACKAGES):
        return True
    short, long = sorted((name, other), key=len)
    return short.count("/") >= 2 and long.endswith(short)


def fixes_in(context: Context, near: NearMiss) -> tuple[Fix, ...]:
    """`fixes` in the texts as they are."""
    (consumers,), (providers,) = documents_of(context, [near])
    return fixes(near, consumers, providers)


def documents_of(context: Context, near: Iterable[NearMiss]) -> tuple[list[Document | None], list[Document | None]]:
    """The texts in which the consumers have their places, and those of the providers."""
    get, pairs = context.documents.get, list(near)
    return (
        [get(connection_location(pair.consumer).file) for pair in pairs],
        [get(connection_location(pair.provider).file) for pair in pairs],
    )


def _correct_remap(document: Document | None, connection: Connection, remap: Remap, new: str) -> Fix | None:
    if document is None:
        return None
    span = remap.target_location.span
    written = document.text[span.start : span.end]
    if "$(" in written or "&" in written or not written:
        return None
    text = _in_style_of(written, connection.name, new)
    return Fix(f"Replace '{written}' by '{text}'", (Edit(remap.target_location, text),), True)


def _in_style_of(written: str, full: str, new: str) -> str:
    """`new`, a full name, as relative as `written` is, which stands for `full`; as a full name if that cannot be."""
    if written.startswith("/"):
        return new
    mark = "~" if written.startswith("~") else ""
    stem = names.canonicalize(written[len(mark) :])
    prefix = full.removesuffix(stem)
    if full.endswith("/" + stem) and new.startswith(prefix) and len(new) > len(prefix):
        return mark + new[len(prefix) :]
    return new


def _insert_remap(document: Document | None, connection: Connection, target: str, preferred: bool) -> Fix | None:
    if document is None:
        return None
    source = connection.endpoint.name
    namespace = names.parent(connection.node.name)
    relative = not source.startswith("/") and target.startswith(namespace)
    written = target[len(namespace) :] if relative else target
    edit = insert_child(connection.node.action, document, f'<remap from="{source}" to="{written}"/>')
    return Fix(f"Remap '{source}' to '{written}' in {connection.node.name}", (edit,), preferred)
