"""Ends of topics or services that were probably meant to meet."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain, islice
from typing import Literal

from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import Remap
from preflight_analysis.findings.finding import Confidence, Edit, Fix, Severity
from preflight_analysis.findings.insertion import insert_child
from preflight_analysis.graph.model import Channel, ChannelKind, Connection, Graph
from preflight_analysis.rules.nearest import has_all_words, likeness, numbers_in, share_words
from preflight_analysis.rules.nearest_memory import Hit, Nearest
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
    consumers = tuple(dangling_consumers(context, kind))
    if context.graph is None or not consumers:
        return ()
    channels = tuple(context.graph.channels(kind).values())
    return context.kept.get(_near_misses, kind, channels, consumers, context.graph.blind > 0)


def _near_misses(channels: tuple[Channel, ...], consumers: tuple[Connection, ...], blind: bool) -> tuple[NearMiss, ...]:
    index = _Index(channels, consumers)
    hits = _nearest.best(index.seekers, index.pools, index.rate)
    found = []
    for consumer in consumers:
        hit = hits.get(index.seeker(consumer))
        if hit is not None:
            near = index.near_miss(consumer, hit)
            if not index.ambiguous(near) and (near.strong or not blind):
                found.append(near)
    return tuple(found)


_nearest = Nearest()


class _Index:
    """The ends of a graph as `Nearest` wants them: as all that a comparison looks at, which is not where they stand.

    Channels are put together by what a near miss has to share: the type, and the numbers in the name (`/robot3/scan`)
    or its last segment. In a fleet of like robots that leaves few to compare.
    """

    def __init__(self, channels: Iterable[Channel], consumers: Iterable[Connection]) -> None:
        self._nodes: dict[int, tuple[str, int]] = {}
        self._names: Counter[str] = Counter()
        self._consumers = {self.seeker(consumer): consumer for consumer in consumers}
        self.seekers = {seeker: _pools(consumer) for seeker, consumer in self._consumers.items()}
        """The consumers, with the pools of the channels that each may have been meant for."""
        self.pools: dict[Hashable, list[Hashable]] = {pool: [] for pools in self.seekers.values() for pool in pools}
        self._channels: dict[Hashable, Channel] = {}
        self._lone: Counter[tuple[str, str | None, str]] = Counter()
        self._provided: Counter[tuple[str | None, str]] = Counter()
        for channel in channels:
            leaf, numbers = names.leaf(channel.name), numbers_in(channel.name)
            if not channel.providers or not channel.consumers:
                side = "providers" if channel.providers else "consumers"
                connections = channel.providers or channel.consumers
                self._lone.update((side, connection.endpoint.type, leaf) for connection in connections)
            if channel.providers:
                consumed_by = tuple(map(self._node, channel.consumers))
                key = channel.name, _dangles(channel), consumed_by, *(map(self._key, channel.providers))
                self._channels[key] = channel
                for type_ in {_known_type(connection) for connection in channel.providers}:
                    self._provided[type_, leaf] += 1
                    for pool in ((), (type_,), (type_, numbers), (type_, leaf)):
                        if pool in self.pools:
                            self.pools[pool].append(key)

    def _key(self, connection: Connection) -> Hashable:
        given = connection.endpoint
        return self._node(connection), connection.remap is None, given.name, given.type, given.builtin

    def _node(self, connection: Connection) -> tuple[str, int]:
        """The node's name, and a number where several have it."""
        found = self._nodes.get(id(connection.node))
        if found is None:
            name = connection.node.name
            found = self._nodes[id(connection.node)] = name, self._names[name]
            self._names[name] += 1
        return found

    def seeker(self, consumer: Connection) -> Hashable:
        """The end as `Nearest` knows it."""
        return consumer.name, self._key(consumer)

    def rate(self, seeker: Hashable, candidate: Hashable) -> Hit | None:
        """How well a channel fits an end."""
        return min(self._hits(self._consumers[seeker], candidate), key=lambda hit: hit.rank, default=None)

    def _hits(self, consumer: Connection, candidate: Hashable) -> Iterator[Hit]:
        channel = self._channels[candidate]
        for number, kind, distance in _candidates(consumer, channel):
            how = _EVIDENCE.index(kind)
            yield Hit((how > 0, not _dangles(channel), how, distance, channel.name, number), candidate)

    def near_miss(self, consumer: Connection, hit: Hit) -> NearMiss:
        """What a hit says, with the ends as they are now."""
        channel = self._channels[hit.candidate]
        provider = channel.providers[hit.rank[-1]]
        known = _known_type(consumer) is not None and _known_type(provider) is not None
        return NearMiss(consumer, provider, _EVIDENCE[hit.rank[2]], known, _dangles(channel))

    def ambiguous(self, near: NearMiss) -> bool:
        """Whether the last name alone speaks for it, or a namespace, and others of the type have it too: which of them
        was meant, if any?"""
        type_ = near.consumer.endpoint.type or ""
        leaf = names.leaf(near.consumer.name)
        if near.likeness == "words" and leaf == names.leaf(near.provider.name):
            return self._provided[type_, leaf] > 1 and not share_words(
                *map(names.parent, (near.consumer.name, near.provider.name))
            )
        if near.likeness not in ("slash", "level") or not type_.startswith(_GENERIC_PACKAGES):
            return False
        return any(self._lone[side, type_, leaf] > 1 for side in ("providers", "consumers"))


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
    return [connection for connections in context.once(_all_lone_consumers)[kind] for connection in connections]


def dangling_providers(context: Context, kind: ChannelKind) -> list[Connection]:
    """Publishers or servers without any other end, but for those that may well be used from outside."""
    channels = context.graph.channels(kind) if context.graph is not None else {}
    found = zip(channels, context.once(_all_lone_providers)[kind], strict=True)
    return [
        connection
        for name, connections in found
        if connections and not _read_otherwise(name, channels)
        for connection in connections
    ]


_Lone = Mapping[ChannelKind, Sequence[tuple[Connection, ...]]]
"""The ends of each channel of a kind, in the order of the graph."""


def _all_lone_consumers(context: Context) -> _Lone:
    return _of_all_channels(context, _lone_consumers)


def _all_lone_providers(context: Context) -> _Lone:
    return _of_all_channels(context, _lone_providers)


def _of_all_channels(context: Context, lone: Callable[[Channel], tuple[Connection, ...]]) -> _Lone:
    graph = context.graph
    kinds: tuple[ChannelKind, ...] = ("topics", "services", "actions")
    channels = {kind: tuple(graph.channels(kind).values()) if graph is not None else () for kind in kinds}
    found = iter(context.kept.each(lone, chain.from_iterable(channels.values())))
    return {kind: tuple(islice(found, len(some))) for kind, some in channels.items()}


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


def weight(graph: Graph, near: NearMiss) -> tuple[Severity, Confidence]:
    """How severe a near miss is and how sure: without evidence beside a like name it is but a hint."""
    connections = (near.consumer.endpoint, near.provider.endpoint)
    speculative = any(connection.uncertain for connection in connections)
    sure = graph.complete and near.same_type and not speculative
    alike = near.likeness == "typo" or (near.provider_dangles and graph.likely_complete and not _of_another_node(near))
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


def fixes(context: Context, near: NearMiss) -> tuple[Fix, ...]:
    """What makes the two ends meet: the remap that gave the wrong name corrected, else a remap into a node's tag."""
    site, other = near.site, near.other
    if not near.mendable:
        return ()
    if site.remap is not None:
        corrected = _correct_remap(context, site, site.remap, other.name)
        if corrected is not None:
            return (corrected,)
    # A remap at a publisher that others listen to would only move the gap to them.
    movable = (near.consumer, *((near.provider,) if near.provider_dangles else ()))
    connections = [connection for connection in movable if connection.remap is None]
    found = [
        _insert_remap(context, connection, _partner(near, connection).name, connection is connections[0])
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
    dangles = _dangles(channel)
    if any(connection.node is consumer.node for connection in channel.consumers):
        return  # it knows that name
    alike: list[tuple[Literal["typo", "words"], int] | None] = []
    for number, provider in enumerate(channel.providers):
        if provider.endpoint.builtin or provider.node is consumer.node:
            # What a node takes in and what it gives out have like names on purpose (`points`, `points_filtered`).
            continue
        mine, theirs = _known_type(consumer), _known_type(provider)
        known = mine is not None and theirs is not None
        if (known and mine != theirs) or not (known or dangles):
            continue
        if known and dangles and consumer.name.endswith(names.leaf(channel.name)):
            short, long = sorted((consumer, provider), key=lambda connection: len(connection.name))
            how_far = len(long.name) - len(short.name)
            if _is_slash(short, long):
                yield number, "slash", how_far
                continue
            if _extra_level(short.name, long.name) is not None:
                yield number, "level", how_far
                continue
        if not alike:
            alike.append(likeness(consumer.name, channel.name))  # the same for all ends of the channel
        if alike[0] is None:
            continue
        how, distance = alike[0]
        if how == "words" and not (known and dangles and _says_enough(consumer.name, channel.name, mine or "")):
            continue
        yield number, how, distance


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


def _correct_remap(context: Context, connection: Connection, remap: Remap, new: str) -> Fix | None:
    written = context.text(remap.target_location)
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


def _insert_remap(context: Context, connection: Connection, target: str, preferred: bool) -> Fix | None:
    location: Location = connection_location(connection)
    document = context.documents.get(location.file)
    if document is None:
        return None
    source = connection.endpoint.name
    namespace = names.parent(connection.node.name)
    relative = not source.startswith("/") and target.startswith(namespace)
    written = target[len(namespace) :] if relative else target
    edit = insert_child(connection.node.action, document, f'<remap from="{source}" to="{written}"/>')
    return Fix(f"Remap '{source}' to '{written}' in {connection.node.name}", (edit,), preferred)
