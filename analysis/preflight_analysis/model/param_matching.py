"""What a launch sets on the parameter server, against what its nodes ask for."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from collections.abc import Set as AbstractSet
from itertools import chain
from typing import NamedTuple

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.graph.model import ParamRead
from preflight_analysis.model.context import Context
from preflight_analysis.model.parameters import by_namespace, namespaces_around
from preflight_analysis.tracing.interface import Interface

_ASKING = ("get", "has")
_LOOKING = ("list", "search")


NOBODY = ""
"""In place of the name of a node."""


@dataclass(frozen=True, slots=True, eq=False)
class Asked:
    """What one node asks for."""

    names: tuple[str, ...]
    """Of parameters, those among them that it sets or deletes."""
    around: tuple[str, ...]
    """The namespaces that these are in."""
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

    unset_of_nodes: tuple[tuple[ParamRead, ...], ...]
    """The reads in which each node is the first to request a name that nothing sets, nor anything below it."""
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
    names_asked = dict.fromkeys(chain.from_iterable([each.names for each in asked]))
    if "/" in names_asked:
        return None
    nodes = context.each(_name, graph.tree.nodes)
    opaque = {name for name, each, is_known in zip(nodes, asked, known, strict=True) if each.lists or not is_known}
    searches = [read for each in asked for read in each.searches]
    searched = frozenset([read.use.name.strip("~/").partition("/")[0] for read in searches])
    made = {name for each in asked for name in each.made}
    around = chain.from_iterable([each.around for each in asked])
    asked_in = context.grouped(_namespace, "asked", tuple(dict.fromkeys((*names_asked, *around))))
    groups = by_namespace(context)
    columns = groups.values(), [asked_in.get(space, ()) for space in groups]
    unread = zip(groups, context.each_row(_unread, columns, searched), strict=True)
    holders = _Holders({*nodes}, names_asked)
    found = ((holders.of(space), params) for space, params in unread if params)
    held = [Held(holder, params) for holder, params in found if holder is not None]
    return Matched(
        tuple(_unset(context, asked, made)),
        opaque,
        _sought(context, searches, made),
        any(each.lists for each in asked),
        tuple(each for each in held if each.holder != NOBODY and each.holder not in opaque),
        tuple(chain.from_iterable(each.unread for each in held if each.holder == NOBODY)),
    )


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
    all_names = (*(read.name.rstrip("/") or "/" for read in asking), *made)
    return Asked(
        all_names,
        tuple(names.with_namespaces(all_names).difference(all_names)),
        requested,
        made,
        tuple(read for read in others if read.use.access == "search"),
        any(read.use.access == "list" for read in others),
    )


def _name(node: LaunchNode) -> str:
    return node.name


def _namespace(name: str) -> str:
    return name.rpartition("/")[0]


def _unread(params: tuple[Param, ...], asked: tuple[str, ...], searched: frozenset[str]) -> tuple[Param, ...]:
    """The parameters of one namespace that nobody asks for, nor for anything below them, nor searches for a name in
    them."""
    taken = frozenset(asked)
    return tuple(
        [p for p in params if p.name not in taken and (not searched or searched.isdisjoint(p.name.split("/")))]
    )


class _Holders:
    """Of namespaces the full name of the node whose the parameters in them are, `NOBODY`; None where somebody asks for
    them as a whole."""

    def __init__(self, nodes: AbstractSet[str], asked: Mapping[str, None]) -> None:
        self._nodes = nodes
        self._asked = asked
        self._found: dict[str, str | None] = {"": NOBODY}

    def of(self, space: str) -> str | None:
        """That of one; thousands have few around them."""
        if space in self._found:
            return self._found[space]
        above = self.of(_namespace(space))
        holder = None if above is None or space in self._asked else space if space in self._nodes else above
        self._found[space] = holder
        return holder


def _unset(context: Context, asked: Sequence[Asked], made: AbstractSet[str]) -> Iterator[tuple[ParamRead, ...]]:
    requested = chain.from_iterable([each.requested for each in asked])
    left = {*requested}.difference(context.tree.params, namespaces_around(context), made)
    for each in asked:
        new = [] if left.isdisjoint(each.requested) else [name for name in each.requested if name in left]
        left.difference_update(new)
        yield tuple([each.requested[name] for name in new])


def _sought(context: Context, searches: Sequence[ParamRead], made: AbstractSet[str]) -> tuple[ParamRead, ...]:
    if not searches:
        return ()
    there = {names.leaf(name) for name in chain(context.tree.params, made)}
    sought = {sought_leaf(read): read for read in reversed(searches)}
    return tuple(read for leaf, read in reversed(sought.items()) if leaf not in there)
