"""Remaps whose name is none that their nodes use, and what they were probably meant for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from itertools import chain

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.ros2.spawners import asked_of, is_spawner
from preflight_analysis.evaluation.tree import LaunchNode, Remap
from preflight_analysis.graph.model import Channel, Connection, Graph
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import likeness, words_in
from preflight_analysis.model.well_known import is_transform
from preflight_analysis.tracing.interface import ENDS, Interface

_TOPIC_ROLES = ("publisher", "subscriber")
_LETTERS = 4
"""Of a word that says what a topic carries."""
BY_SOURCE = "in its source"
BY_CATALOGUE = "according to the catalogue"
_BY_RUN = "before its event loop"
_KNOWN_BY = {"source": BY_SOURCE, "catalogue": BY_CATALOGUE}


@dataclass(frozen=True, slots=True)
class IdleRemap:
    """A remap that has no effect at any node that it reaches. `nodes` are those, the first one in full."""

    remap: Remap
    nodes: tuple[LaunchNode, ...]
    known_by: str
    """How the names of the nodes are known, as a message says it."""
    meant: Connection | None = None
    """The end of the first node that it was most likely meant for."""
    partner: Connection | None = None
    """An end of another node that stands under the remap's target and that `meant` would fit."""
    sure: bool = True
    """Whether all names of the nodes are known. If not, `meant` has the very name but for a `~` or a namespace, or
    for a slip at a node that the catalogue has."""
    is_reversed: bool = False
    """Whether the target is a name that the source of each node makes, and another node has the one that the remap is
    for: `from` and `to` are the wrong way around."""

    manager: str = ""
    """At a spawner, the node in whose process the controllers live that it asks for, which are `helped`: `meant` is an
    end of one of them."""
    helped: tuple[str, ...] = ()

    @property
    def to_itself(self) -> bool:
        """Whether it is from a name to the same name, which says nothing unless something else was meant."""
        return _is_to_itself(self.remap, self.nodes[0])


@dataclass(frozen=True, slots=True)
class _Reached:
    """A remap at one of the nodes that it reaches."""

    remap: Remap
    node: LaunchNode
    has_effect: bool
    known_by: str
    sure: bool
    is_reversed: bool = False
    manager: str = ""
    controllers: tuple[str, ...] = ()


@derived
def idle_remaps(context: Context) -> tuple[IdleRemap, ...]:
    """Those of nodes that were run to their event loop."""
    graph = context.graph
    if graph is None:
        return ()
    reached = context.each_row(_reached, (graph.tree.nodes, graph.interfaces))
    # A tag reaches several nodes where it stands around them, or in a file that is included more than once.
    of_tags = context.grouped(_tag, "", chain.from_iterable(reached))
    idle = [*filter(None, context.each(_idle, of_tags.values()))]
    if not idle:
        return ()
    own_ends = context.each(_own_ends, chain(graph.topics.values(), graph.services.values()))
    of_nodes = context.grouped(_node, "", chain.from_iterable(own_ends))
    names_of = {node.name: id(node) for node in graph.tree.nodes} if any(each.helped for each in idle) else {}
    rows = ((each, [id(each.nodes[0]), *(names_of.get(name, 0) for name in each.helped)]) for each in idle)
    found = (
        _with_meaning(context, graph, each, tuple(chain.from_iterable(of_nodes.get(node, ()) for node in nodes)))
        for each, nodes in rows
    )
    return tuple(
        each for each in found if (each.sure and not (each.to_itself or each.is_reversed)) or each.meant is not None
    )


def _reached(node: LaunchNode, interface: Interface) -> tuple[_Reached, ...]:
    if not node.remaps:
        return ()
    sure, known = _reports_names(node, interface), _used(node, interface)
    tells = sure or _tells_in_part(node, interface)
    known_by = _KNOWN_BY.get(interface.source, _BY_RUN)
    asked = asked_of(node) if is_spawner(node) else None
    manager, helped = "", tuple[str, ...]()
    if asked is not None:
        # It calls services of the manager, whatever it was seen to do, and the controllers live there.
        manager, helped = asked.manager, tuple(names.join(names.parent(asked.manager), c) for c in asked.controllers)
        sure = tells = True
        known_by = BY_CATALOGUE
        known = _Names(known.used | {manager}, known.around | {*names.with_namespaces([manager])})
    found = []
    for remap in node.remaps:
        # One to itself has none whatever the node uses.
        idle = (tells or _is_to_itself(remap, node)) and _has_no_effect(remap, node, known)
        swapped = not idle and tells and interface.source == "source" and _is_reversed(remap, node, known)
        found.append(_Reached(remap, node, not (idle or swapped), known_by, sure, swapped, manager, helped))
    return tuple(found)


def _tag(reached: _Reached) -> Location:
    return reached.remap.origin[-1]


def _idle(reached: tuple[_Reached, ...]) -> IdleRemap | None:
    """What is to say of a tag, of all nodes that it reaches; nothing where it has an effect at any."""
    if any(each.has_effect for each in reached):
        return None
    ways = {each.known_by for each in reached}
    known_by = _BY_RUN if len(ways) > 1 else reached[0].known_by
    sure = all(each.sure for each in reached)
    swapped = {each.is_reversed for each in reached}
    if len(swapped) > 1:
        return None
    first = reached[0]
    return IdleRemap(
        first.remap,
        tuple(each.node for each in reached),
        known_by,
        sure=sure,
        is_reversed=swapped.pop(),
        manager=first.manager,
        helped=first.controllers,
    )


def _own_ends(channel: Channel) -> tuple[Connection, ...]:
    """Those whose names nothing has moved."""
    ends = (*channel.providers, *channel.consumers)
    return tuple(each for each in ends if each.remap is None and not each.endpoint.builtin)


def _node(connection: Connection) -> int:
    return id(connection.node)


def _with_meaning(context: Context, graph: Graph, idle: IdleRemap, own: tuple[Connection, ...]) -> IdleRemap:
    leads_to = idle.remap.source if idle.is_reversed else idle.remap.target
    target = names.resolve(leads_to, idle.nodes[0].name)
    channels = tuple(_channel_of(graph, each) for each in own)
    targets = tuple(_channels(graph, each).get(target) for each in own)
    # What an argument says is only by default the same name.
    on_purpose = idle.to_itself and "(" not in context.text(idle.remap.target_location)
    return context.one(_meaning, id(idle), idle, own, channels, targets, on_purpose)


def _channels(graph: Graph, connection: Connection) -> Mapping[str, Channel]:
    return graph.topics if connection.endpoint.role in _TOPIC_ROLES else graph.services


def _channel_of(graph: Graph, connection: Connection) -> Channel:
    channel = _channels(graph, connection)[connection.name]
    if not channel.apart:
        return channel
    of_name = graph.named("topics" if connection.endpoint.role in _TOPIC_ROLES else "services", connection.name)
    return next(each for each in of_name if any(end is connection for end in (*each.providers, *each.consumers)))


def _meaning(
    idle: IdleRemap,
    own: tuple[Connection, ...],
    channels: tuple[Channel, ...],
    targets: tuple[Channel | None, ...],
    on_purpose: bool,
) -> IdleRemap:
    """With the end that the remap was meant for, and whom it would then meet.

    Either its name is like the remap's and nothing else reaches it, or it is the node's only one without another end
    that fits what stands under the target. Of a remap from a name to itself, `on_purpose`, it may join others of its
    kind there.
    `own` are the ends of the node, `channels` what they are in and `targets` what is under the target's name, of a
    reversed one under its own.
    """
    full = names.resolve(idle.remap.source, idle.nodes[0].name)
    rows = zip(own, channels, targets, strict=True)
    lone = [(each, target) for each, channel, target in rows if not _facing(channel, each)]
    if idle.is_reversed:
        wanted = names.resolve(idle.remap.target, idle.nodes[0].name)
        # As it is, the node may get what it is meant to get, unless another one has the other name.
        same = [each for each, source in lone if each.name == wanted and _partner(source, each) is not None]
        return replace(idle, meant=same[0] if len(same) == 1 else None)
    # What the catalogue has was read from the whole source of the node.
    is_slip = _is_slip if idle.sure or idle.known_by == BY_CATALOGUE else _is_same_leaf
    found = [(each, target) for each, target in lone if is_slip(full, each)]
    if idle.helped:
        found = [(each, target) for each, target in lone if _is_of_helped(idle, each)]
    if len(found) != 1 and idle.sure:
        found = [(each, target) for each, target in lone if _partner(target, each) is not None]
    if not found and idle.sure and not idle.to_itself:
        found = [(each, target) for each, target in lone if _is_of_kind(idle.remap, each)]
    if not found and on_purpose:
        found = [(each, target) for each, target in lone if _has_peer(target, each)]
    meant, target = found[0] if len(found) == 1 else (None, None)
    partner = _partner(target, meant) if meant is not None else None
    return replace(idle, meant=meant, partner=partner)


def _reports_names(node: LaunchNode, interface: Interface) -> bool:
    """Whether a run showed, or the source or the catalogue tells, all names that the node uses. One that made nothing
    of its own is a wrapper or a loader of something else, whose names nobody saw."""
    plain = interface.source == "catalogue" and not node.args and not interface.decided
    known = interface.tells_all(*ENDS) or (plain and interface.speaks_of("topics"))
    if interface.declared or not known or node.unknowns:
        return False
    if node.package == "nodelet":
        return False  # those of images subscribe only while somebody reads what they make of it
    return any(not (e.builtin or "made-up answer" in e.evidence.doubts) for e in interface.endpoints)


def _tells_in_part(node: LaunchNode, interface: Interface) -> bool:
    """Whether the source of a node, the catalogue, or a run to its event loop, tells some names that it uses."""
    spins = interface.source == "trace" and interface.outcome.status == "spinning"
    told = interface.source in ("source", "catalogue") or spins
    if interface.declared or not told or node.unknowns or node.package == "nodelet":
        return False
    return any(not (e.builtin or "made-up answer" in e.evidence.doubts) for e in interface.endpoints)


@dataclass(frozen=True, slots=True)
class _Names:
    """What a node uses, by full names before remapping. `around` has them with all namespaces above them."""

    used: frozenset[str]
    around: frozenset[str]


def _used(node: LaunchNode, interface: Interface) -> _Names:
    given = [e.name for e in interface.endpoints if not e.builtin] + [p.name for p in interface.params if not p.builtin]
    used = frozenset(names.resolve(name, node.name) for name in given)
    return _Names(used, frozenset(names.with_namespaces(used)))


def _is_to_itself(remap: Remap, node: LaunchNode) -> bool:
    return names.resolve(remap.source, node.name) == names.resolve(remap.target, node.name)


def _is_reversed(remap: Remap, node: LaunchNode, known: _Names) -> bool:
    """Whether the node makes the name that the remap leads to, and none that the remap is for."""
    target = names.resolve(remap.target, node.name)
    if target not in known.used or _is_to_itself(remap, node):
        return False
    rest = known.used - {target}
    return _has_no_effect(remap, node, _Names(rest, frozenset(names.with_namespaces(rest))))


def _has_no_effect(remap: Remap, node: LaunchNode, known: _Names) -> bool:
    """Whether neither the node nor a library could mean the name.

    Libraries make names below the one that they are given (an action's five topics, the transports of an image,
    dynamic_reconfigure's, a node handle's), and beside it (`camera_info`); one that applies remaps itself hands over
    the target.
    """
    if not names.is_legal(remap.source) or any(old.target != remap.target for old in remap.replaces):
        return False
    full, target = names.resolve(remap.source, node.name), names.resolve(remap.target, node.name)
    if is_transform(full) or full.endswith("/camera_info") or full in known.around or target in known.around:
        return False
    if full == target:
        return True
    # A node may resolve a name before it makes others below that.
    moved = (names.resolve(other.target, node.name) for other in node.remaps if other is not remap)
    if any(full.startswith(f"{each}/") for each in moved):
        return False
    above = full.rpartition("/")[0]
    while above:
        if above in known.used:
            return False
        above = above.rpartition("/")[0]
    return True


def _is_slip(full: str, connection: Connection) -> bool:
    """Whether the names are a typo apart, or only their namespaces differ: a missing `~`, a slash too many."""
    alike = likeness(full, connection.name)
    return (alike is not None and alike[0] == "typo") or _is_same_leaf(full, connection)


def _is_of_helped(idle: IdleRemap, connection: Connection) -> bool:
    """Whether the remap of a spawner names that end of its controller, by its full name or as the controller has it."""
    source, node = idle.remap.source, connection.node.name
    return node in idle.helped and connection.name in (
        names.resolve(source, idle.nodes[0].name),
        names.resolve(source, node),
    )


def _is_same_leaf(full: str, connection: Connection) -> bool:
    return names.leaf(full) == names.leaf(connection.name)


def _is_of_kind(remap: Remap, connection: Connection) -> bool:
    """Whether the remap's name is a word of what the end carries, and its target ends as the name of the end: `cloud`
    to `ouster/points`, of an end `velodyne_points` that takes a `PointCloud2`."""
    type_ = names.leaf(connection.endpoint.type or "").lower()
    word, (*_, last) = names.leaf(remap.source).lower(), words_in(names.leaf(remap.target)) or ("",)
    if min(len(word), len(last)) < _LETTERS:
        return False
    return word in type_ and words_in(connection.name)[-1:] == (last,)


def _partner(channel: Channel | None, connection: Connection) -> Connection | None:
    """The first end of another node in `channel` that `connection` could talk to."""
    if channel is None:
        return None
    for other in _facing(channel, connection):
        same = connection.endpoint.type not in (None, "*") and connection.endpoint.type == other.endpoint.type
        if same and other.node is not connection.node and not other.endpoint.builtin:
            return other
    return None


def _has_peer(channel: Channel | None, connection: Connection) -> bool:
    """Whether another node does the same in `channel`, with the same type."""
    type_, role = connection.endpoint.type, connection.endpoint.role
    others = (*channel.providers, *channel.consumers) if channel is not None and type_ not in (None, "*") else ()
    return any(
        (each.endpoint.type, each.endpoint.role) == (type_, role) and each.node is not connection.node
        for each in others
    )


def _facing(channel: Channel, connection: Connection) -> tuple[Connection, ...]:
    """The ends of the channel that one like `connection` talks to."""
    return channel.consumers if connection.endpoint.role in ("publisher", "service") else channel.providers
