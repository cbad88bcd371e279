"""What a launch sets on the parameter server, against what its nodes ask for."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from collections.abc import Set as AbstractSet
from itertools import chain, repeat
from typing import NamedTuple

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.meanings import namespace_of
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.graph.model import ParamRead
from preflight_analysis.model.context import Context
from preflight_analysis.model.parameters import around_each, by_namespace, groups_of_params, namespaces_around
from preflight_analysis.tracing.interface import Interface

_ASKING = ("get", "has")
_LOOKING = ("list", "search")


NOBODY = ""
"""In place of the name of a node."""


@dataclass(frozen=True, slots=True, eq=False)
class Asked:
    """What one node asks for."""

    names: frozenset[str]
    """Of parameters, those among them that it sets or deletes."""
    taken: Mapping[str, frozenset[str]]
    """These and the namespaces that they are in, by the namespaces of all of them."""
    requested: Mapping[str, ParamRead]
    """The first read of each that its own code asks for, by the name that it gives."""
    made: frozenset[str]
    """What it sets or deletes."""
    searches: tuple[ParamRead, ...]
    lists: bool
    """Whether it asks for the names of all parameters: it may read any of them."""


class Held(NamedTuple):
    """What is unread of the parameters of a node in one namespace."""

    holder: str
    unread: tuple[Param, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Matched:
    """What a launch sets, and what its nodes ask for."""

    asked: tuple[Asked, ...]
    """Of each node."""
    asking: Mapping[str, tuple[Asked, ...]]
    """Those that ask for something in a namespace, or below it."""
    made: AbstractSet[str]
    """What nodes set or delete."""
    opaque: AbstractSet[str]
    """Full names of the nodes of which it is not known what they read."""
    sought: tuple[ParamRead, ...]
    """What nodes search for in their namespaces and nobody sets in any, each last part once."""
    lists: bool
    """Whether some node asks for the names of all parameters."""
    private: tuple[Held, ...]
    """Of nodes of which it is known what they read."""
    orphans: tuple[Param, ...]
    """What is unread in the namespaces of no node."""


def matched(context: Context) -> Matched | None:
    """None before the runs, where of no node it is known what it reads, and where one reads all that is set."""
    graph = context.graph
    known = context.each(reports_params, graph.interfaces) if graph is not None else ()
    if graph is None or not any(known):
        return None
    asked = context.each(_asked_by, graph.reads_of_nodes)
    names_asked = frozenset[str]().union(*[each.names for each in asked])
    if "/" in names_asked:
        return None
    asking = context.indexed(_spaces, "", asked)
    nodes = context.each(_name, graph.tree.nodes)
    opaque = {name for name, each, is_known in zip(nodes, asked, known, strict=True) if each.lists or not is_known}
    searches = [read for each in asked for read in each.searches]
    searched = frozenset([read.use.name.strip("~/").partition("/")[0] for read in searches])
    made = {name for each in asked for name in each.made}
    groups = by_namespace(context)
    columns = groups_of_params(context), [*map(asking.get, groups, repeat(()))]
    unread = context.each_row(_unread, columns, searched)
    # Who asks for a namespace as a whole asks for all that is in it.
    whole = frozenset(filter(names_asked.__contains__, namespaces_around(context)))
    homes = {*nodes}
    held = [
        Held(next((space for space in around if space in homes), NOBODY), params)
        for around, params in zip(around_each(context), unread, strict=True)
        if params and whole.isdisjoint(around)
    ]
    return Matched(
        asked,
        asking,
        made,
        opaque,
        _sought(context, searches, made),
        any(each.lists for each in asked),
        tuple(each for each in held if each.holder != NOBODY and each.holder not in opaque),
        tuple(chain.from_iterable(each.unread for each in held if each.holder == NOBODY)),
    )


def unset_of(context: Context, found: Matched, at: int) -> tuple[ParamRead, ...]:
    """The reads in which a node, by its number, is the first to request a name that nothing sets, nor anything below
    it."""
    mine = found.asked[at]
    unset = _unset(context, found, mine.requested)
    rows = ((name, found.asking[_namespace(name)]) for name in unset)
    return tuple(
        mine.requested[name]
        for name, asking in rows
        if asking[0] is mine or next(each for each in asking if name in each.requested) is mine
    )


def unset_among(context: Context, found: Matched, leaves: frozenset[str], spaces: frozenset[str]) -> list[ParamRead]:
    """The same of all nodes of which it is known what they read, as far as their last parts or their namespaces are
    among these."""
    first: dict[str, tuple[LaunchNode, ParamRead]] = {}
    for node, reads in zip(context.tree.nodes, context.each(_among, found.asked, leaves, spaces), strict=True):
        for name, read in reads:
            first.setdefault(name, (node, read))
    unset = [first[name] for name in _unset(context, found, first)]
    return [read for node, read in unset if node.name not in found.opaque]


def _among(asked: Asked, leaves: frozenset[str], spaces: frozenset[str]) -> tuple[tuple[str, ParamRead], ...]:
    pairs = ((name.rpartition("/"), name, read) for name, read in asked.requested.items())
    return tuple((name, read) for (space, _, leaf), name, read in pairs if leaf in leaves or space in spaces)


def _unset(context: Context, found: Matched, some: Iterable[str]) -> list[str]:
    """Those of the names that nothing sets, nor anything below them."""
    params, around = context.tree.params, namespaces_around(context)
    return [name for name in some if name not in params and name not in around and name not in found.made]


def reports_params(interface: Interface) -> bool:
    """Whether all is known that the node reads. An annotation without a single parameter does not speak of them."""
    return interface.tells_all("parameters") and (not interface.declared or bool(interface.params))


def sought_leaf(read: ParamRead) -> str:
    """The last part of the name that is searched for."""
    return names.leaf(read.use.name.lstrip("~"))


def _asked_by(reads: tuple[ParamRead, ...]) -> Asked:
    asking = [read for read in reads if read.use.access in _ASKING]
    others = [read for read in reads if read.use.access not in _ASKING]
    requested: dict[str, ParamRead] = {}
    for read in asking:
        if not read.use.builtin:
            requested.setdefault(read.name.rstrip("/") or "/", read)
    made = frozenset(read.name for read in others if read.use.access not in _LOOKING)
    all_names = made.union(read.name.rstrip("/") or "/" for read in asking)
    taken: dict[str, list[str]] = {}
    for name in names.with_namespaces(all_names):
        taken.setdefault(_namespace(name), []).append(name)
    return Asked(
        all_names,
        {space: frozenset(some) for space, some in taken.items()},
        requested,
        made,
        tuple(read for read in others if read.use.access == "search"),
        any(read.use.access == "list" for read in others),
    )


def _name(node: LaunchNode) -> str:
    return node.name


def _namespace(name: str) -> str:
    return name.rpartition("/")[0]


def _spaces(asked: Asked) -> tuple[str, ...]:
    return tuple(asked.taken)


def _unread(params: tuple[Param, ...], asking: tuple[Asked, ...], searched: frozenset[str]) -> tuple[Param, ...]:
    """The parameters of one namespace that nobody asks for, nor for anything below them, nor searches for a name in
    them."""
    space = namespace_of(params[0])
    taken = frozenset[str]().union(*[each.taken[space] for each in asking])
    return tuple(
        [p for p in params if p.name not in taken and (not searched or searched.isdisjoint(p.name.split("/")))]
    )


def _sought(context: Context, searches: Sequence[ParamRead], made: AbstractSet[str]) -> tuple[ParamRead, ...]:
    if not searches:
        return ()
    there = {names.leaf(name) for name in chain(context.tree.params, made)}
    sought = {sought_leaf(read): read for read in reversed(searches)}
    return tuple(read for leaf, read in reversed(sought.items()) if leaf not in there)
