"""Parameters that are set and that nobody reads, and what they were probably meant for."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from collections.abc import Set as AbstractSet
from dataclasses import dataclass
from itertools import chain

from rapidfuzz.distance import OSA

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.graph.model import Graph, ParamRead
from preflight_analysis.rules.nearest import likeness, nearest
from preflight_analysis.rules.parameters import each_namespace, grouped, namespace_of, namespaces_around
from preflight_analysis.rules.rule import Context
from preflight_analysis.rules.well_known import is_for_tools
from preflight_analysis.tracing.interface import Interface


@dataclass(frozen=True, slots=True)
class Unread:
    """A parameter that no node reads."""

    param: Param
    holder: LaunchNode | None
    """The node whose private parameter it is."""
    meant: ParamRead | None
    """What it was most likely meant for: a node asks for it, and nothing sets it."""
    alone: bool = True
    """Whether no other read would do as well."""


def unread_params(context: Context) -> tuple[Unread, ...]:
    """Those of which it is known that nobody reads them: every private one, others only where something was meant.

    Ask through `context.once`.
    """
    graph, kept = context.graph, context.kept
    told = kept.each(reports_params, graph.interfaces) if graph is not None else ()
    if graph is None or not any(told):
        return ()
    reads = _collect(context, graph, told)
    unasked = [param for param in context.tree.all_params if param.name not in reads.covered]
    if reads.searched:
        unasked = [*filter(None, kept.each(_unless_searched, unasked, reads.searched))]
    groups = kept.grouped(namespace_of, "unasked", unasked)
    namespaces = [namespace for namespace in dict.fromkeys(context.once(each_namespace)) if namespace in groups]
    nodes = {node.name: node for node in graph.tree.nodes}
    orphans: list[Param] = []
    private: list[tuple[Param, ...]] = []
    holders: list[LaunchNode] = []
    for namespace, around in zip(namespaces, kept.each(_around, namespaces), strict=True):
        holder = next((nodes[name] for name in around if name in nodes), None)
        if (holder is not None and holder.name in reads.opaque) or reads.covers_all(around):
            continue
        if holder is None:
            orphans += groups[namespace]
        else:
            private.append(groups[namespace])
            holders.append(holder)
    unset = kept.grouped(_reader, "unset", reads.unset)
    of_holders = kept.each_row(_of_holder, (private, holders, [unset.get(id(holder), ()) for holder in holders]))
    of_nobody: tuple[Unread, ...] = ()
    if orphans and not reads.listed:
        of_told = tuple(read for read in reads.unset if read.node.name not in reads.opaque)
        alone = graph.tree.complete and not reads.opaque
        of_nobody = kept.get(_of_nobody, None, tuple(orphans), of_told, reads.sought, alone)
    return (*chain.from_iterable(of_holders), *of_nobody)


def reports_params(interface: Interface) -> bool:
    """Whether all is known that the node reads. An annotation without a single parameter does not speak of them."""
    return interface.told and (not interface.declared or bool(interface.params))


def fits(value: object, read: ParamRead) -> bool:
    """Whether a parameter's value is of the kind that the read expects, as far as its default tells."""
    default = read.use.default
    if not read.use.has_default or default is None:
        return True
    if isinstance(value, bool) or isinstance(default, bool):
        return isinstance(value, bool) and isinstance(default, bool)
    if isinstance(value, (int, float)) and isinstance(default, (int, float)):
        return True
    return type(value) is type(default)


@dataclass(frozen=True, slots=True)
class _Reads:
    """What all nodes read."""

    names: AbstractSet[str]
    covered: AbstractSet[str]
    """The names, and every name above one: reading `/a/b` reads part of the value of `/a`."""
    searched: frozenset[str]
    unset: tuple[ParamRead, ...]
    """Of each name that some node reads and nothing sets the first who reads it."""
    opaque: AbstractSet[str]
    """Full names of the nodes of which it is not known what they read."""
    sought: tuple[ParamRead, ...]
    """What nodes search for in their namespaces and nobody sets in any, each last name once."""
    listed: bool
    """Whether a node asks for the names of all parameters: it may read any of them."""

    def covers_all(self, namespaces: Collection[str]) -> bool:
        """Whether somebody asks for one of these namespaces as a whole, and so for all in it."""
        return "/" in self.names or not self.names.isdisjoint(namespaces)


def _collect(context: Context, graph: Graph, told: Iterable[bool]) -> _Reads:
    """`told` says of each node whether it is known what it reads."""
    kept, params = context.kept, graph.tree.params
    reads = kept.grouped(_kind, "param reads", graph.param_reads)
    lists, searches, asks, makes = (reads.get(kind, ()) for kind in ("list", "search", "ask", "make"))
    made = {read.name for read in makes}
    asked = (*asks, *reads.get("builtin", ()))
    found = made.union(kept.each(_asked_name, asked))
    above = names.with_namespaces({*kept.each(_namespace_asked, asked), *(name.rpartition("/")[0] for name in made)})
    taken = params.keys() | context.once(namespaces_around) | made
    unset: dict[str, ParamRead] = {}
    for read in asks:
        if read.name not in taken:
            unset.setdefault(read.name, read)
    sought: dict[str, ParamRead] = {}
    for read in searches:
        sought.setdefault(_sought_leaf(read), read)
    if sought:
        for leaf in {*kept.each(_leaf, graph.tree.all_params), *map(names.leaf, made)}.intersection(sought):
            del sought[leaf]
    return _Reads(
        found,
        found | above,
        frozenset(read.use.name.strip("~/").partition("/")[0] for read in searches),
        tuple(unset.values()),
        {
            *(node.name for node, is_told in zip(graph.tree.nodes, told, strict=True) if not is_told),
            *(read.node.name for read in lists),
        },
        tuple(sought.values()),
        bool(lists),
    )


def _kind(read: ParamRead) -> str:
    if read.use.access in ("get", "has"):
        return "builtin" if read.use.builtin else "ask"
    return read.use.access if read.use.access in ("list", "search") else "make"


def _asked_name(read: ParamRead) -> str:
    return read.name.rstrip("/") or "/"


def _namespace_asked(read: ParamRead) -> str:
    return _asked_name(read).rpartition("/")[0]


def _sought_leaf(read: ParamRead) -> str:
    return names.leaf(read.use.name.lstrip("~"))


def _reader(read: ParamRead) -> int:
    return id(read.node)


def _leaf(param: Param) -> str:
    return names.leaf(param.name)


def _unless_searched(param: Param, searched: frozenset[str]) -> Param | None:
    return param if searched.isdisjoint(param.name.split("/")) else None


def _around(namespace: str) -> tuple[str, ...]:
    """It and those that hold it, the innermost first, without the root: `/a/b` and `/a` of `/a/b`."""
    return tuple(_namespaces(f"{namespace}/"))


def _namespaces(name: str) -> Iterator[str]:
    """The namespaces that hold a name, the innermost first: `/a/b` and `/a` of `/a/b/c`."""
    while name := name.rpartition("/")[0]:
        yield name


def _of_holder(params: Iterable[Param], holder: LaunchNode, unset: tuple[ParamRead, ...]) -> tuple[Unread, ...]:
    """Of parameters of one node that nobody reads. `unset` is what it reads and nothing sets."""
    return tuple(
        Unread(param, holder, _meant_of_holder(param, holder, unset))
        for param in params
        if not is_for_tools(param.name)
    )


def _meant_of_holder(param: Param, holder: LaunchNode, unset: tuple[ParamRead, ...]) -> ParamRead | None:
    near = _nearest_read(param, holder, [read for read in unset if read.name.startswith(holder.name + "/")])
    if near is not None:
        return near
    # The node asks for it under this very name, but not as its own: `mode` or `/driver/mode` instead of `~mode`.
    leaf, relative = names.leaf(param.name), param.name[len(holder.name) :]
    elsewhere = [read for read in unset if names.leaf(read.name) == leaf and read.name.endswith(relative)]
    found = [read for read in elsewhere if _would_change(param, read)]
    return found[0] if len(found) == 1 else None


def _of_nobody(
    params: tuple[Param, ...], unset: tuple[ParamRead, ...], sought: tuple[ParamRead, ...], alone: bool
) -> tuple[Unread, ...]:
    """Of parameters that nobody reads and that are of no node those that were meant for something. `alone`: there is
    nothing in the launch that is not known."""
    orphans = [param for param in params if not is_for_tools(param.name)]
    found = [
        Unread(param, None, read) for param, read in _sought(orphans, {_sought_leaf(read): read for read in sought})
    ]
    orphans = _others(orphans, found)
    found += [Unread(param, None, read) for param, read in _misplaced(orphans, unset)]
    if alone:
        by_leaf: dict[str, list[ParamRead]] = {}
        for read in unset:
            by_leaf.setdefault(names.leaf(read.name), []).append(read)
        for param in _others(orphans, found):
            shifted = _shifted_reads(param, by_leaf)
            if shifted:
                found.append(Unread(param, None, shifted[0], len(shifted) == 1))
    return tuple(found)


def _others(params: Iterable[Param], found: Iterable[Unread]) -> list[Param]:
    names_found = {each.param.name for each in found}
    return [param for param in params if param.name not in names_found]


def _would_change(param: Param, read: ParamRead) -> bool:
    """Whether the read would get another value, of a kind that it expects."""
    return fits(param.value, read) and not (read.use.has_default and read.use.default == param.value)


def _sought(params: Iterable[Param], sought: dict[str, ParamRead]) -> Iterator[tuple[Param, ParamRead]]:
    """Parameters whose last name is a typo of one that a node searches for."""
    for param in params if sought else ():
        near = nearest(names.leaf(param.name), sought)
        if near is not None and likeness(names.leaf(param.name), near) is not None:
            yield param, sought[near]


def _shifted_reads(param: Param, by_leaf: dict[str, list[ParamRead]]) -> list[ParamRead]:
    """The reads that differ from the parameter by namespaces too many or too few at one point.

    `/rate` for `/talker/rate`; `/base/rate` for `/robot/base/rate` and the other way round. A lone last name is no
    evidence for a parameter that stands too deep.
    """
    found = []
    parts = param.name.split("/")
    for read in by_leaf.get(parts[-1], ()):
        others = read.name.split("/")
        short, long = sorted((parts, others), key=len)
        same = next((i for i, (a, b) in enumerate(zip(short, long, strict=False)) if a != b), len(short))
        tail = len(short) - same
        if tail < 1 or len(short) == len(long) or short[same:] != long[-tail:]:
            continue
        if (tail >= 2 or short is parts) and _would_change(param, read):
            found.append(read)
    return found


def _nearest_read(param: Param, holder: LaunchNode, reads: Iterable[ParamRead]) -> ParamRead | None:
    """The read that the parameter was most likely meant for: a typo apart, or of the same words and a fitting type."""
    relative = param.name[len(holder.name) + 1 :]
    ranked: list[tuple[int, int, str, ParamRead]] = []
    for read in reads:
        other = read.name[len(holder.name) + 1 :]
        alike = likeness(relative, other)
        if alike is None and nearest(relative, [other]) is not None and relative.count("/") == other.count("/"):
            alike = ("typo", int(OSA.distance(relative, other)))
        if alike is None or (alike[0] == "words" and not fits(param.value, read)):
            continue
        ranked.append((0 if alike[0] == "typo" else 1, alike[1], read.name, read))
    return min(ranked, key=lambda entry: entry[:3])[3] if ranked else None


def _misplaced(params: Iterable[Param], unset: Iterable[ParamRead]) -> Iterator[tuple[Param, ParamRead]]:
    """Parameters that nobody reads, each with a read of the same leaf name in another namespace that nothing sets.

    A leaf name alone (`rate`, `frame_id`) is no evidence: either two or more of a namespace's names agree, and most, or
    the namespaces' own names are alike, or it is a typo of a name in the same namespace.
    """
    by_namespace: dict[str, dict[str, ParamRead]] = {}
    for read in unset:
        namespace, _, leaf = read.name.rpartition("/")
        by_namespace.setdefault(namespace, {})[leaf] = read
    for namespace, group in grouped(params).items():
        leaves = {names.leaf(param.name): param for param in group}
        for leaf, param in leaves.items():
            near = nearest(leaf, by_namespace.get(namespace, ()))
            if near is not None and likeness(leaf, near) is not None:
                yield param, by_namespace[namespace][near]
        best: tuple[int, str] | None = None
        for other, there in by_namespace.items():
            if other == namespace:
                continue
            common = leaves.keys() & there.keys()
            # A file has sections for nodes that are started elsewhere: they share names with others, but not most.
            same = len(common) >= 2 and 2 * len(common) >= len(leaves)
            if (same or (common and _alike_namespaces(namespace, other))) and any(
                _would_change(leaves[leaf], there[leaf]) for leaf in common
            ):
                rank = (-len(common), other)
                best = rank if best is None or rank < best else best
        if best is not None:
            there = by_namespace[best[1]]
            yield from ((param, there[leaf]) for leaf, param in leaves.items() if leaf in there)


def _alike_namespaces(namespace: str, other: str) -> bool:
    return bool(namespace.strip("/")) and bool(other.strip("/")) and likeness(namespace, other) is not None
