"""Parameters that are set and that nobody reads, and what they were probably meant for."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass

from rapidfuzz.distance import OSA

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.graph.model import ParamRead
from preflight_analysis.rules.nearest import likeness, nearest
from preflight_analysis.rules.parameters import grouped
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
    graph = context.graph
    if graph is None or not any(context.kept.each(reports_params, graph.interfaces)):
        return ()
    tree = graph.tree
    return context.kept.get(
        _unread,
        None,
        tree.nodes,
        graph.interfaces,
        graph.param_reads,
        tree.all_params,
        context.tree.all_params,
        tree.complete,
    )


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
    """What all nodes read. `unset` are the names that some node reads and nothing sets, with who reads them."""

    names: frozenset[str]
    prefixes: frozenset[str]
    """Every name above one that is read: reading `/a/b` reads part of the value of `/a`."""
    searched: frozenset[str]
    unset: dict[str, ParamRead]
    opaque: frozenset[str]
    """Full names of the nodes of which it is not known what they read."""
    sought: dict[str, ParamRead]
    """By last name what nodes search for in their namespaces and nobody sets in any."""
    listed: bool
    """Whether a node asks for the names of all parameters: it may read any of them."""

    def covers(self, name: str) -> bool:
        """Whether somebody asks for the parameter, or for something below it."""
        return name in self.names or name in self.prefixes or not self.searched.isdisjoint(name.split("/"))

    def covers_all(self, namespaces: Iterable[str]) -> bool:
        """Whether somebody asks for one of these namespaces as a whole, and so for all in it."""
        return "/" in self.names or not self.names.isdisjoint(namespaces)


def _unread(
    nodes: tuple[LaunchNode, ...],
    interfaces: tuple[Interface, ...],
    param_reads: tuple[ParamRead, ...],
    params: tuple[Param, ...],
    looked_at: tuple[Param, ...],
    complete: bool,
) -> tuple[Unread, ...]:
    """Those of the parameters that are `looked_at`. `params` are all that are set, `complete` says whether they are."""
    groups = grouped(looked_at)
    opaque = {node.name for node, each in zip(nodes, interfaces, strict=True) if not reports_params(each)}
    reads = _collect(param_reads, {param.name for param in params}, groups, opaque)
    return tuple(_unread_of(groups, reads, {node.name: node for node in nodes}, complete))


def _unread_of(
    groups: Mapping[str, list[Param]], reads: _Reads, nodes: Mapping[str, LaunchNode], complete: bool
) -> Iterator[Unread]:
    orphans: list[Param] = []
    by_leaf: dict[str, list[ParamRead]] = {}
    for read in reads.unset.values():
        if read.node.name not in reads.opaque:
            by_leaf.setdefault(names.leaf(read.name), []).append(read)
    for namespace, params in groups.items():
        around = list(_namespaces(f"{namespace}/"))
        holder = next((nodes[name] for name in around if name in nodes), None)
        if (holder is not None and holder.name in reads.opaque) or reads.covers_all(around):
            continue
        unread = [p for p in params if not reads.covers(p.name) and not is_for_tools(p.name)]
        if holder is None:
            orphans += unread
        else:
            yield from (Unread(p, holder, _meant_of_holder(p, holder, reads, by_leaf)) for p in unread)
    if reads.listed:
        return
    reported: set[str] = set()
    for param, read in _sought(orphans, reads.sought):
        reported.add(param.name)
        yield Unread(param, None, read)
    for param, read in _misplaced([param for param in orphans if param.name not in reported], reads):
        reported.add(param.name)
        yield Unread(param, None, read)
    if complete and not reads.opaque:
        for param in orphans:
            found = _shifted_reads(param, by_leaf) if param.name not in reported else ()
            if found:
                yield Unread(param, None, found[0], len(found) == 1)


def _collect(
    param_reads: Iterable[ParamRead], params: Collection[str], namespaces: Iterable[str], opaque: set[str]
) -> _Reads:
    """`params` are the names of those that are set, `opaque` those of nodes of which it is not known what they read."""
    read_names: set[str] = set()
    searched: set[str] = set()
    asked: dict[str, ParamRead] = {}
    sought: dict[str, ParamRead] = {}
    filled = names.with_namespaces(namespaces)
    made: set[str] = set()
    listed = False
    for read in param_reads:
        if read.use.access == "list":
            opaque.add(read.node.name)
            listed = True
        elif read.use.access == "search":
            searched.add(read.use.name.strip("~/").partition("/")[0])
            sought.setdefault(names.leaf(read.use.name.lstrip("~")), read)
        elif read.use.access in ("get", "has"):
            read_names.add(read.name.rstrip("/") or "/")
            if not read.use.builtin and read.name not in params and read.name not in filled:
                asked.setdefault(read.name, read)
        else:
            read_names.add(read.name)
            made.add(read.name)
    unset = {name: read for name, read in asked.items() if name not in made}
    for name in {names.leaf(name) for name in params} | {names.leaf(name) for name in made}:
        sought.pop(name, None)
    prefixes = frozenset(names.with_namespaces(name.rpartition("/")[0] for name in read_names))
    return _Reads(frozenset(read_names), prefixes, frozenset(searched), unset, frozenset(opaque), sought, listed)


def _namespaces(name: str) -> Iterator[str]:
    """The namespaces that hold a name, the innermost first: `/a/b` and `/a` of `/a/b/c`."""
    while name := name.rpartition("/")[0]:
        yield name


def _meant_of_holder(
    param: Param, holder: LaunchNode, reads: _Reads, by_leaf: dict[str, list[ParamRead]]
) -> ParamRead | None:
    mine = [r for r in reads.unset.values() if r.node is holder and r.name.startswith(holder.name + "/")]
    near = _nearest_read(param, holder, mine)
    if near is not None:
        return near
    relative = param.name[len(holder.name) :]
    # The node asks for it under this very name, but not as its own: `mode` or `/driver/mode` instead of `~mode`.
    elsewhere = [r for r in by_leaf.get(names.leaf(param.name), ()) if r.node is holder and r.name.endswith(relative)]
    found = [read for read in elsewhere if _would_change(param, read)]
    return found[0] if len(found) == 1 else None


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


def _misplaced(params: Iterable[Param], reads: _Reads) -> Iterator[tuple[Param, ParamRead]]:
    """Parameters that nobody reads, each with a read of the same leaf name in another namespace that nothing sets.

    A leaf name alone (`rate`, `frame_id`) is no evidence: either two or more of a namespace's names agree, and most, or
    the namespaces' own names are alike, or it is a typo of a name in the same namespace.
    """
    by_namespace: dict[str, dict[str, ParamRead]] = {}
    for name, read in reads.unset.items():
        if read.node.name not in reads.opaque:
            namespace, _, leaf = name.rpartition("/")
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
