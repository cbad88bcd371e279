"""Parameters that are set and that nobody reads, and what they were probably meant for."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import chain

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.meanings import namespace_of
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.graph.model import ParamRead
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import likeness, nearest, share_words
from preflight_analysis.model.param_matching import matched, sought_leaf, unset_among, unset_of
from preflight_analysis.model.parameters import grouped, groups_of_params
from preflight_analysis.model.well_known import is_for_tools
from preflight_analysis.slips import edits

_PLUGIN = re.compile(r"""<plugin\b[^<>]{0,500}?\bname\s*=\s*["']([^"'<>]+)["']""")
_CLASS = re.compile(r"\w+(?:/|::)\w+")


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


@derived
def unread_params(context: Context) -> tuple[Unread, ...]:
    """Those of which it is known that nobody reads them: every private one, others only where something was meant."""
    graph, found = context.graph, matched(context)
    if graph is None or found is None:
        return ()
    nodes = graph.tree.nodes
    places = {node.name: at for at, node in enumerate(nodes)}
    of_holders: list[Unread] = []
    for name, params in found.private:
        at = places[name]
        of_holders += context.one(_of_holder, params[0].name, params, nodes[at], unset_of(context, found, at))
    of_nobody: tuple[Unread, ...] = ()
    orphans = found.orphans
    if orphans:
        plugins: frozenset[str] = frozenset().union(*context.each(_plugins_in, groups_of_params(context)))
        orphans = tuple(param for param in orphans if plugins.isdisjoint(param.name.split("/"))) if plugins else orphans
    if orphans and not found.lists:
        # Of thousands of reads few have anything in common with those.
        leaves = frozenset([names.leaf(param.name) for param in orphans])
        near = tuple(unset_among(context, found, leaves, frozenset(map(namespace_of, orphans))))
        alone = graph.tree.complete and not found.opaque
        of_nobody = context.one(_of_nobody, None, orphans, near, found.sought, alone)
    return (*of_holders, *of_nobody)


def _plugins_in(params: tuple[Param, ...]) -> frozenset[str]:
    """The names of the plugins in the descriptions of robots: a simulator loads these, and they read parameters below
    their names."""
    texts = (param.value for param in params if isinstance(param.value, str) and "<plugin" in param.value)
    return frozenset(chain.from_iterable(map(_PLUGIN.findall, texts)))


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


def _of_holder(params: Iterable[Param], holder: LaunchNode, unset: tuple[ParamRead, ...]) -> tuple[Unread, ...]:
    """Of parameters of one node that nobody reads. `unset` is what it reads and nothing sets."""
    found = [
        Unread(param, holder, _meant_of_holder(param, holder, unset))
        for param in params
        if not is_for_tools(param.name)
    ]
    lost = [each for each in found if each.meant is None]
    if len(lost) == 1:
        left = _only_one_left(lost[0].param, unset)
        return tuple(replace(each, meant=left) if each is lost[0] else each for each in found)
    return tuple(found)


def _only_one_left(param: Param, unset: tuple[ParamRead, ...]) -> ParamRead | None:
    """Of a node's only parameter that it does not read the only one in the same namespace that it reads without anybody
    setting it, where the names have a word in common: `~load_threshold`, `~position_threshold`."""
    namespace = namespace_of(param)
    reads = [read for read in unset if read.use.access == "get" and read.name.rpartition("/")[0] == namespace]
    if len(reads) != 1 or not share_words(names.leaf(reads[0].name), names.leaf(param.name)):
        return None
    return reads[0] if reads[0].use.has_default and would_change(param, reads[0]) else None


def _meant_of_holder(param: Param, holder: LaunchNode, unset: tuple[ParamRead, ...]) -> ParamRead | None:
    near = _nearest_read(param, holder, [read for read in unset if read.name.startswith(holder.name + "/")])
    if near is not None:
        return near
    # The node asks for it under this very name, but not as its own: `mode` or `/driver/mode` instead of `~mode`.
    leaf, relative = names.leaf(param.name), param.name[len(holder.name) :]
    elsewhere = [read for read in unset if names.leaf(read.name) == leaf and read.name.endswith(relative)]
    # That the default is what the launch file says hides it only until somebody gives another value.
    found = [read for read in elsewhere if fits(param.value, read)]
    return found[0] if len(found) == 1 else None


def _of_nobody(
    params: tuple[Param, ...], unset: tuple[ParamRead, ...], sought: tuple[ParamRead, ...], alone: bool
) -> tuple[Unread, ...]:
    """Of parameters that nobody reads and that are of no node those that were meant for something. `alone`: there is
    nothing in the launch that is not known."""
    orphans = [param for param in params if not is_for_tools(param.name)]
    found = [
        Unread(param, None, read) for param, read in _sought(orphans, {sought_leaf(read): read for read in sought})
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


def would_change(param: Param, read: ParamRead) -> bool:
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
        if (tail >= 2 or short is parts) and would_change(param, read):
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
            alike = ("typo", edits(relative, other))
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
    groups = grouped(params)
    plugins = {namespace for namespace, group in groups.items() if any(map(_names_a_class, group))}
    for namespace, group in groups.items():
        leaves = {names.leaf(param.name): param for param in group}
        for leaf, param in leaves.items():
            near = nearest(leaf, by_namespace.get(namespace, ()))
            if near is not None and likeness(leaf, near) is not None:
                yield param, by_namespace[namespace][near]
        # Whoever loads the plugin reads them: joints have the same names in every section that is about them.
        if plugins and any(f"{namespace}/".startswith(f"{each}/") for each in plugins):
            continue
        best: tuple[int, str] | None = None
        for other, there in by_namespace.items():
            if other == namespace:
                continue
            common = leaves.keys() & there.keys()
            # A file has sections for nodes that are started elsewhere: they share names with others, but not most.
            same = len(common) >= 2 and 2 * len(common) >= len(leaves)
            if (same or (common and _alike_namespaces(namespace, other))) and any(
                would_change(leaves[leaf], there[leaf]) for leaf in common
            ):
                rank = (-len(common), other)
                best = rank if best is None or rank < best else best
        if best is not None:
            there = by_namespace[best[1]]
            yield from ((param, there[leaf]) for leaf, param in leaves.items() if leaf in there)


def _names_a_class(param: Param) -> bool:
    """Whether it is the `type: package/Class` of a controller or another plugin, whose section is around it."""
    value = param.value
    return names.leaf(param.name) == "type" and isinstance(value, str) and _CLASS.fullmatch(value) is not None


def _alike_namespaces(namespace: str, other: str) -> bool:
    return bool(namespace.strip("/")) and bool(other.strip("/")) and likeness(namespace, other) is not None
