"""Parameters that are set and that nobody reads, and what they were probably meant for."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from collections.abc import Set as AbstractSet
from itertools import chain, compress
from operator import is_not, not_
from typing import NamedTuple, TypeVar

from rapidfuzz.distance import OSA

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.graph.model import ParamRead
from preflight_analysis.incremental.kept import Before
from preflight_analysis.rules.nearest import likeness, nearest
from preflight_analysis.rules.parameters import each_namespace, grouped, namespace_of
from preflight_analysis.rules.rule import Context
from preflight_analysis.rules.well_known import is_for_tools
from preflight_analysis.tracing.interface import Interface

_ASKING = ("get", "has")
T = TypeVar("T")


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
    params, nodes = context.tree.all_params, graph.tree.nodes
    launch = kept.patched(_set_names, "", params, tuple(context.once(each_namespace)))
    uses = tuple(kept.each(_use, graph.param_reads))
    reads = kept.patched(_collect, "", uses, nodes, tuple(told), launch)
    unasked = [*compress(params, kept.get(_are_unasked, "", launch, reads))]
    if "/" in reads.names or not unasked:
        return ()
    in_spaces = tuple(kept.grouped(namespace_of, "unasked", unasked).values())
    around = tuple(kept.each(_around, in_spaces))
    private, orphans = kept.patched(_by_holder, "", in_spaces, around, nodes, reads)
    by_name = {node.name: node for node in nodes}
    holders = [by_name[name] for name, _ in private]
    all_unset = [*compress(graph.param_reads, reads.unset)]
    unset = kept.grouped(_reader, "unset", all_unset)
    groups = [group for _, group in private]
    of_holders = kept.each_row(_of_holder, (groups, holders, [unset.get(id(holder), ()) for holder in holders]))
    of_nobody: tuple[Unread, ...] = ()
    if orphans and not reads.listed:
        # Of thousands of reads few have anything in common with those.
        leaves = frozenset(names.leaf(param.name) for param in orphans)
        near = filter(None, kept.each(_unless_far, all_unset, leaves, frozenset(map(namespace_of, orphans))))
        of_told = tuple(read for read in near if read.node.name not in reads.opaque)
        alone = graph.tree.complete and not reads.opaque
        of_nobody = kept.get(_of_nobody, None, orphans, of_told, reads.sought, alone)
    return (*chain.from_iterable(of_holders), *of_nobody)


_Placed = tuple[list[tuple[str, tuple[Param, ...]]], tuple[Param, ...]]


def _by_holder(
    before: Before[_Placed] | None,
    groups: tuple[tuple[Param, ...], ...],
    all_around: tuple[tuple[str, ...], ...],
    nodes: tuple[LaunchNode, ...],
    reads: _Reads,
) -> _Placed:
    """The parameters that no node asks for, with the names of the nodes whose they are; and those of no node. They are
    given by namespace, with the namespaces around each. Of nodes of which it is not known what they read there are
    none, nor of namespaces that somebody asks for as a whole."""
    if before is not None:
        (old_groups, _, old_nodes, old_reads), known = before
        same_groups = len(old_groups) == len(groups) and not any(map(is_not, old_groups, groups))
        if reads is old_reads and same_groups and _have_the_same_names(old_nodes, nodes):
            return known
    of_nodes = {node.name for node in nodes}
    private: list[tuple[str, tuple[Param, ...]]] = []
    orphans: list[Param] = []
    for group, around in zip(groups, all_around, strict=True):
        if reads.names.isdisjoint(around):
            holder = next(filter(of_nodes.__contains__, around), None)
            if holder is None:
                orphans += group
            elif holder not in reads.opaque:
                private.append((holder, group))
    return private, tuple(orphans)


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


@dataclass(frozen=True, slots=True, eq=False)
class _SetNames:
    """The names of all parameters that the launch sets."""

    names: Mapping[str, None]
    """In the order of the parameters."""
    spaces: AbstractSet[str]
    """The namespaces that these are in, and those around them."""


def _set_names(before: Before[_SetNames] | None, params: tuple[Param, ...], spaces: tuple[str, ...]) -> _SetNames:
    """`spaces` has the namespace of each."""
    if before is not None:
        (old_params, _), known = before
        if _have_the_same_names(old_params, params):
            return known
    return _SetNames(dict.fromkeys([param.name for param in params]), names.with_namespaces(spaces))


def _changed(before: Sequence[T], items: Sequence[T]) -> Iterator[tuple[T, T]]:
    """The items that are other objects than those of before at their places, with these, of as many."""
    return compress(zip(before, items, strict=True), map(is_not, before, items))


def _have_the_same_names(before: Sequence[LaunchNode | Param], items: Sequence[LaunchNode | Param]) -> bool:
    return len(before) == len(items) and all(old.name == item.name for old, item in _changed(before, items))


class _Use(NamedTuple):
    """What one read asks for: a name and its namespace, and the name as it is asked for, where a node's own code does
    so. `other` is the read itself where it asks for no value but does something else."""

    name: str
    namespace: str
    requested: str | None
    other: ParamRead | None = None


def _use(read: ParamRead) -> _Use:
    if read.use.access not in _ASKING:
        return _Use("", "", None, read)
    name = read.name.rstrip("/") or "/"
    return _Use(name, name.rpartition("/")[0], None if read.use.builtin else read.name)


@dataclass(frozen=True, slots=True, eq=False)
class _Reads:
    """What all nodes read. It is the same object while they read the same."""

    names: AbstractSet[str]
    above: AbstractSet[str]
    """Every name above one of those: reading `/a/b` reads part of the value of `/a`."""
    searched: frozenset[str]
    unset: tuple[bool, ...]
    """Of each read whether nothing sets what is asked for there, or anything below it, and nobody asked for it before,
    for its own sake."""
    opaque: AbstractSet[str]
    """Full names of the nodes of which it is not known what they read."""
    sought: tuple[ParamRead, ...]
    """What nodes search for in their namespaces and nobody sets in any, each last name once."""
    listed: bool
    """Whether a node asks for the names of all parameters: it may read any of them."""


def _say_the_same(before: Sequence[_Use], uses: Sequence[_Use]) -> bool:
    return len(before) == len(uses) and all(old.other is None and old == use for old, use in _changed(before, uses))


def _collect(
    before: Before[_Reads] | None,
    uses: tuple[_Use, ...],
    nodes: tuple[LaunchNode, ...],
    told: tuple[bool, ...],
    launch: _SetNames,
) -> _Reads:
    """`uses` are those of all reads, `told` says of each node whether it is known what it reads."""
    if before is not None:
        (old_uses, old_nodes, old_told, old_launch), known = before
        same_nodes = told == old_told and _have_the_same_names(old_nodes, nodes)
        if launch is old_launch and same_nodes and _say_the_same(old_uses, uses):
            return known
    lists: list[ParamRead] = []
    searches: list[ParamRead] = []
    made: set[str] = set()
    asked, spaces, requested, others = zip(*uses, strict=True) if uses else ((), (), (), ())
    for read in filter(None, others):
        if read.use.access == "list":
            lists.append(read)
        elif read.use.access == "search":
            searches.append(read)
        else:
            made.add(read.name)
    first = dict(zip(reversed(requested), range(len(uses) - 1, -1, -1), strict=True))
    unset = {*map(first.get, first.keys() - launch.names.keys() - launch.spaces - made - {None})}
    sought: dict[str, ParamRead] = {}
    for read in searches:
        sought.setdefault(_sought_leaf(read), read)
    if sought:
        for leaf in {names.leaf(name) for name in chain(launch.names, made)}.intersection(sought):
            del sought[leaf]
    return _Reads(
        {*filter(None, asked), *made},
        names.with_namespaces({*spaces, *(name.rpartition("/")[0] for name in made)}),
        frozenset(read.use.name.strip("~/").partition("/")[0] for read in searches),
        tuple(map(unset.__contains__, range(len(uses)))),
        {
            *(node.name for node in compress(nodes, map(not_, told))),
            *(read.node.name for read in lists),
        },
        tuple(sought.values()),
        bool(lists),
    )


def _are_unasked(launch: _SetNames, reads: _Reads) -> tuple[bool, ...]:
    """Of each parameter whether nobody asks for it or for anything below it, nor searches for a name in it."""
    covered = [*map((reads.names | reads.above).__contains__, launch.names)]
    if reads.searched:
        covered = [
            is_covered or not reads.searched.isdisjoint(name.split("/"))
            for is_covered, name in zip(covered, launch.names, strict=True)
        ]
    return tuple(map(not_, covered))


def _unless_far(read: ParamRead, leaves: frozenset[str], spaces: frozenset[str]) -> ParamRead | None:
    namespace, _, leaf = read.name.rpartition("/")
    return read if leaf in leaves or namespace in spaces else None


def _sought_leaf(read: ParamRead) -> str:
    return names.leaf(read.use.name.lstrip("~"))


def _reader(read: ParamRead) -> int:
    return id(read.node)


def _around(group: tuple[Param, ...]) -> tuple[str, ...]:
    """The namespaces that hold the parameters of one, the innermost first, without the root: `/a/b` and `/a` of
    `/a/b/c`."""
    found = [namespace_of(group[0])]
    while found[-1]:
        found.append(found[-1].rpartition("/")[0])
    return tuple(found[:-1])


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
