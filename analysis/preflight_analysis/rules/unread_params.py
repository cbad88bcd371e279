"""Parameters that are set and that nobody reads, and what they were probably meant for."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from collections.abc import Set as AbstractSet
from dataclasses import dataclass
from itertools import chain

from rapidfuzz.distance import OSA

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.graph.model import Graph, ParamRead
from preflight_analysis.rules.nearest import likeness, nearest
from preflight_analysis.rules.parameters import grouped, namespace_of, namespaces_around
from preflight_analysis.rules.rule import Context
from preflight_analysis.rules.well_known import is_for_tools
from preflight_analysis.tracing.interface import Interface

_ASKING = ("get", "has")


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
    unasked = [param for name, param in context.tree.params.items() if name not in reads.covered]
    if reads.searched:
        unasked = [*filter(None, kept.each(_unless_searched, unasked, reads.searched))]
    if "/" in reads.names or not unasked:
        return ()
    private, holders, orphans = _by_holder(context, graph, reads, unasked)
    by_reader = kept.grouped(_reader, "param reads", graph.param_reads)
    asked = chain.from_iterable(by_reader.get(holder, ()) for holder in dict.fromkeys(map(id, holders)))
    unset = kept.grouped(_reader, "unset", [read for read in asked if reads.is_unset(read)])
    of_holders = kept.each_row(_of_holder, (private, holders, [unset.get(id(holder), ()) for holder in holders]))
    of_nobody: tuple[Unread, ...] = ()
    if orphans and not reads.listed:
        # Of thousands of reads few have anything in common with those.
        leaves, spaces = {names.leaf(param.name) for param in orphans}, {*map(namespace_of, orphans)}
        parts = zip(graph.param_reads, kept.each(_parts, graph.param_reads), strict=True)
        near = [read for read, (namespace, leaf) in parts if leaf in leaves or namespace in spaces]
        of_told = tuple(read for read in near if reads.is_unset(read) and read.node.name not in reads.opaque)
        alone = graph.tree.complete and not reads.opaque
        of_nobody = kept.get(_of_nobody, None, tuple(orphans), of_told, reads.sought, alone)
    return (*chain.from_iterable(of_holders), *of_nobody)


def _by_holder(
    context: Context, graph: Graph, reads: _Reads, params: Iterable[Param]
) -> tuple[list[tuple[Param, ...]], list[LaunchNode], list[Param]]:
    """The parameters that no node asks for, by namespace, with the nodes whose they are; and those of no node. Of nodes
    of which it is not known what they read there are none, nor of namespaces that somebody asks for as a whole."""
    kept = context.kept
    groups = kept.grouped(namespace_of, "unasked", params)
    pairs = zip(groups, kept.each(_around, groups), strict=True)
    is_free = reads.names.isdisjoint
    nodes = {node.name: node for node in graph.tree.nodes}
    private: list[tuple[Param, ...]] = []
    holders: list[LaunchNode] = []
    orphans: list[Param] = []
    for namespace, around in [pair for pair in pairs if is_free(pair[1])]:
        holder = next((nodes[name] for name in around if name in nodes), None)
        if holder is None:
            orphans += groups[namespace]
        elif holder.name not in reads.opaque:
            private.append(groups[namespace])
            holders.append(holder)
    return private, holders, orphans


def reports_params(interface: Interface) -> bool:
    """Whether all is known that the node reads. An annotation without a single parameter does not speak of them."""
    return interface.known_in_full and (not interface.declared or bool(interface.params))


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
    taken: AbstractSet[str]
    """The names that something sets, and the namespaces with such names."""
    first: Mapping[str, ParamRead]
    """Who is the first to ask for a name, for its own sake."""
    opaque: AbstractSet[str]
    """Full names of the nodes of which it is not known what they read."""
    sought: tuple[ParamRead, ...]
    """What nodes search for in their namespaces and nobody sets in any, each last name once."""
    listed: bool
    """Whether a node asks for the names of all parameters: it may read any of them."""

    def is_unset(self, read: ParamRead) -> bool:
        """Whether nothing sets what is asked for there, and nobody asked for it before."""
        return read.name not in self.taken and self.first.get(read.name) is read


def _collect(context: Context, graph: Graph, told: Iterable[bool]) -> _Reads:
    """`told` says of each node whether it is known what it reads."""
    kept, params = context.kept, graph.tree.params
    lists: list[ParamRead] = []
    searches: list[ParamRead] = []
    made: set[str] = set()
    for read in filter(None, kept.each(_unless_asking, graph.param_reads)):
        if read.use.access == "list":
            lists.append(read)
        elif read.use.access == "search":
            searches.append(read)
        else:
            made.add(read.name)
    asked = {*filter(None, kept.each(_asked_name, graph.param_reads))}
    found = asked | made
    above = names.with_namespaces(
        {*filter(None, kept.each(_namespace_asked, graph.param_reads)), *(name.rpartition("/")[0] for name in made)}
    )
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
        params.keys() | context.once(namespaces_around) | made,
        dict(reversed([*filter(None, kept.each(_named_request, graph.param_reads))])),
        {
            *(node.name for node, is_told in zip(graph.tree.nodes, told, strict=True) if not is_told),
            *(read.node.name for read in lists),
        },
        tuple(sought.values()),
        bool(lists),
    )


def _unless_asking(read: ParamRead) -> ParamRead | None:
    return None if read.use.access in _ASKING else read


def _asked_name(read: ParamRead) -> str | None:
    return read.name.rstrip("/") or "/" if read.use.access in _ASKING else None


def _namespace_asked(read: ParamRead) -> str | None:
    name = _asked_name(read)
    return name.rpartition("/")[0] if name is not None else None


def _named_request(read: ParamRead) -> tuple[str, ParamRead] | None:
    """A read that a node's own code makes, with its name."""
    return (read.name, read) if read.use.access in _ASKING and not read.use.builtin else None


def _parts(read: ParamRead) -> tuple[str, str]:
    """Its namespace and its last name."""
    namespace, _, leaf = read.name.rpartition("/")
    return namespace, leaf


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
