"""Parameters that are set and that nobody reads, and what they were probably meant for."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from collections.abc import Set as AbstractSet
from itertools import chain, compress
from operator import is_not
from typing import NamedTuple

from rapidfuzz.distance import OSA

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.graph.model import ParamRead
from preflight_analysis.incremental.kept import Before
from preflight_analysis.rules.name_tally import NO_NAMES, NameTally
from preflight_analysis.rules.nearest import likeness, nearest
from preflight_analysis.rules.parameters import grouped, namespace_of
from preflight_analysis.rules.rule import Context
from preflight_analysis.rules.well_known import is_for_tools
from preflight_analysis.tracing.interface import Interface

_ASKING = ("get", "has")
_LOOKING = ("list", "search")


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
    known = kept.each(reports_params, graph.interfaces) if graph is not None else ()
    if graph is None or not any(known):
        return ()
    nodes = graph.tree.nodes
    found = kept.patched(
        _matched,
        "",
        kept.grouped(namespace_of, "unread", context.tree.all_params),
        kept.each(_asked_by, graph.reads_of_nodes),
        kept.each(_name, nodes),
        known,
    )
    if "/" in found.asked.counts:
        return ()
    places = {node.name: at for at, node in enumerate(nodes)}
    private = [(places[each.holder], each.unread) for each in found.private]
    holders = [nodes[at] for at, _ in private]
    unset = [found.unset_of_nodes[at] for at, _ in private]
    of_holders = kept.each_row(_of_holder, ([params for _, params in private], holders, unset))
    of_nobody: tuple[Unread, ...] = ()
    orphans = found.orphans
    if orphans and not found.lists:
        # Of thousands of reads few have anything in common with those.
        near = kept.each(_unless_far, found.unset_of_nodes, *kept.get(_leaves_and_spaces, "", orphans))
        of_known = tuple(chain.from_iterable(compress(near, (node.name not in found.opaque for node in nodes))))
        alone = graph.tree.complete and not found.opaque
        of_nobody = kept.get(_of_nobody, None, orphans, of_known, found.sought, alone)
    return (*chain.from_iterable(of_holders), *of_nobody)


def _name(node: LaunchNode) -> str:
    return node.name


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
class _Asked:
    """What one node asks for."""

    names: tuple[str, ...]
    """Of parameters, once for each read."""
    requested: Mapping[str, ParamRead]
    """The first read of each that its own code asks for, by the name that it gives."""
    made: tuple[str, ...]
    """What it sets or deletes."""
    searches: tuple[ParamRead, ...]
    lists: bool
    """Whether it asks for the names of all parameters: it may read any of them."""


_NOTHING = _Asked((), {}, (), (), False)


def _asked_by(reads: tuple[ParamRead, ...]) -> _Asked:
    asking = [read for read in reads if read.use.access in _ASKING]
    others = [read for read in reads if read.use.access not in _ASKING]
    requested: dict[str, ParamRead] = {}
    for read in asking:
        if not read.use.builtin:
            requested.setdefault(read.name.rstrip("/") or "/", read)
    return _Asked(
        tuple(read.name.rstrip("/") or "/" for read in asking),
        requested,
        tuple(read.name for read in others if read.use.access not in _LOOKING),
        tuple(read for read in others if read.use.access == "search"),
        any(read.use.access == "list" for read in others),
    )


_NOBODY = ""


@dataclass(frozen=True, slots=True, eq=False)
class _Space:
    """The parameters of one namespace."""

    unread: tuple[Param, ...]
    """Those that nobody asks for, nor for anything below them, nor searches for a name in them."""
    holder: str | None
    """The full name of the node whose they are, `_NOBODY`; None where somebody asks for them as a whole, and where it
    is not known what that node reads."""


class _Held(NamedTuple):
    """What is unread of the parameters of a node in one namespace."""

    holder: str
    unread: tuple[Param, ...]


@dataclass(frozen=True, slots=True, eq=False)
class _Matched:
    """What a launch sets, and what its nodes ask for."""

    given: NameTally
    """The names that are set."""
    asked: NameTally
    """The names that are asked for, or made by nodes."""
    made: AbstractSet[str]
    askers: Mapping[str, tuple[int, ...]]
    """Which nodes, by their place, request a name."""
    unset: Mapping[str, int]
    """The names that are requested and nothing sets, nor anything below them, with the first node that requests it."""
    unset_of_nodes: tuple[tuple[ParamRead, ...], ...]
    """The reads in which each node is the first to request such a name."""
    opaque: AbstractSet[str]
    """Full names of the nodes of which it is not known what they read."""
    searched: AbstractSet[str]
    """The first parts of the names that are searched for."""
    leaves: Mapping[str, int]
    """The last parts of the names that are set, with how many of these there are."""
    sought: tuple[ParamRead, ...]
    """What nodes search for in their namespaces and nobody sets in any, each last part once."""
    lists: bool
    """Whether some node asks for the names of all parameters."""
    around: Mapping[str, frozenset[str]]
    """The namespaces, each with itself and those around it, without the root."""
    spaces: Mapping[str, _Space]
    private: tuple[_Held, ...]
    """Of nodes of which it is known what they read."""
    orphans: tuple[Param, ...]
    """What is unread in the namespaces of no node."""


_Groups = Mapping[str, tuple[Param, ...]]


def _matched(
    before: Before[_Matched] | None,
    groups: _Groups,
    asked: tuple[_Asked, ...],
    nodes: tuple[str, ...],
    known: tuple[bool, ...],
) -> _Matched:
    """`groups` are the parameters by namespace; of each node `asked` is what it asks for, `nodes` its name, `known`
    whether that is all.

    What follows from names that neither came nor went is that of before.
    """
    old_groups: _Groups = {}
    old_asked: tuple[_Asked, ...] = (_NOTHING,) * len(asked)
    old_nodes: tuple[str, ...] = ()
    last = _Matched(NO_NAMES, NO_NAMES, set(), {}, {}, ((),) * len(asked), set(), set(), {}, (), False, {}, {}, (), ())
    if before is not None and len(before[0][1]) == len(asked):
        (old_groups, old_asked, old_nodes, _), last = before
    same_spaces = [*groups] == [*old_groups]
    if same_spaces:
        new_groups = [*compress(groups, map(is_not, groups.values(), old_groups.values()))]
    else:
        new_groups = [space for space, group in groups.items() if old_groups.get(space) is not group]
        new_groups += [space for space in old_groups if space not in groups]
    given, given_news = last.given.changed(_names(old_groups, new_groups), _names(groups, new_groups))
    rows = [at for at, (old, each) in enumerate(zip(old_asked, asked, strict=True)) if old is not each]
    tally, asked_news = last.asked.changed(
        [name for at in rows for name in (*old_asked[at].names, *old_asked[at].made)],
        [name for at in rows for name in (*asked[at].names, *asked[at].made)],
    )
    made = {name for each in asked for name in each.made}

    askers, unset = dict(last.askers), dict(last.unset)
    requested: set[str] = set()
    for at in rows:
        requested |= _replace_asker(askers, at, old_asked[at].requested.keys(), asked[at].requested.keys())
    touched = {*rows}
    for name in requested | given_news | (made ^ last.made):
        was, who = unset.pop(name, None), askers.get(name)
        if who is not None and name not in given and name not in made:
            unset[name] = who[0]
        touched.update(at for at in (was, unset.get(name)) if at is not None)
    unset_of_nodes = list(last.unset_of_nodes)
    for at in touched:
        unset_of_nodes[at] = tuple(read for name, read in asked[at].requested.items() if unset.get(name) == at)

    leaves = dict(last.leaves)
    for name in given_news:
        step = (name in given.counts) - (name in last.given.counts)
        leaves[names.leaf(name)] = leaves.get(names.leaf(name), 0) + step
    sought: dict[str, ParamRead] = {}
    searches = [read for each in asked for read in each.searches]
    leaves_made = set(map(names.leaf, made)) if searches else set()
    for read in searches:
        leaf = _sought_leaf(read)
        if not leaves.get(leaf) and leaf not in leaves_made:
            sought.setdefault(leaf, read)

    opaque = {name for name, each, is_known in zip(nodes, asked, known, strict=True) if each.lists or not is_known}
    searched = {read.use.name.strip("~/").partition("/")[0] for read in searches}
    around = last.around if same_spaces else {space: last.around.get(space) or _around(space) for space in groups}
    new_names = asked_news | (opaque ^ last.opaque) | {*nodes}.symmetric_difference(old_nodes)
    new_spaces = {*groups} if searched != last.searched else {*new_groups, *map(_namespace, asked_news)}
    if new_names:
        new_spaces.update(space for space, spaces in around.items() if not new_names.isdisjoint(spaces))
    of_nodes = frozenset(nodes)
    of_new = {
        space: _space(space, groups[space], tally, searched, of_nodes, opaque)
        for space in new_spaces
        if space in groups
    }
    spaces = {**last.spaces, **of_new} if same_spaces else {}
    spaces = spaces or {space: of_new.get(space) or last.spaces[space] for space in groups}
    replaced = {each.holder for space in new_spaces for each in (last.spaces.get(space), of_new.get(space)) if each}
    private, orphans = last.private, last.orphans
    if not same_spaces or not replaced <= {None, _NOBODY}:
        private = tuple(_Held(each.holder, each.unread) for each in spaces.values() if each.holder and each.unread)
    if not same_spaces or _NOBODY in replaced:
        orphans = tuple(chain.from_iterable(each.unread for each in spaces.values() if each.holder == _NOBODY))
    return _Matched(
        given,
        tally,
        made,
        askers,
        unset,
        tuple(unset_of_nodes),
        opaque,
        searched,
        leaves,
        tuple(sought.values()),
        any(each.lists for each in asked),
        around,
        spaces,
        private,
        orphans,
    )


def _names(groups: _Groups, spaces: Iterable[str]) -> Iterator[str]:
    return (param.name for space in spaces for param in groups.get(space, ()))


def _replace_asker(
    askers: dict[str, tuple[int, ...]], at: int, old: AbstractSet[str], new: AbstractSet[str]
) -> set[str]:
    """The names that a node requests are others now; which of them those are."""
    for name in old - new:
        others = tuple(each for each in askers[name] if each != at)
        if others:
            askers[name] = others
        else:
            del askers[name]
    for name in new - old:
        askers[name] = tuple(sorted((*askers.get(name, ()), at)))
    return {*(old ^ new)}


def _around(space: str) -> frozenset[str]:
    return frozenset(names.with_namespaces((space,)))


def _namespace(name: str) -> str:
    return name.rpartition("/")[0]


def _space(
    space: str,
    params: tuple[Param, ...],
    asked: NameTally,
    searched: AbstractSet[str],
    nodes: AbstractSet[str],
    opaque: AbstractSet[str],
) -> _Space:
    unread = tuple(param for param in params if param.name not in asked)
    if searched:
        unread = tuple(param for param in unread if searched.isdisjoint(param.name.split("/")))
    holder: str | None = _NOBODY
    while space:
        if space in asked.counts:
            return _Space(unread, None)
        if space in nodes and holder == _NOBODY:
            holder = space
        space = _namespace(space)
    return _Space(unread, None if holder in opaque else holder)


def _unless_far(reads: tuple[ParamRead, ...], leaves: frozenset[str], spaces: frozenset[str]) -> tuple[ParamRead, ...]:
    """Those of one node that have a last part or a namespace in common with others."""
    found = []
    for read in reads:
        namespace, _, leaf = read.name.rpartition("/")
        if leaf in leaves or namespace in spaces:
            found.append(read)
    return tuple(found)


def _leaves_and_spaces(params: tuple[Param, ...]) -> tuple[frozenset[str], frozenset[str]]:
    return frozenset(names.leaf(param.name) for param in params), frozenset(map(namespace_of, params))


def _sought_leaf(read: ParamRead) -> str:
    return names.leaf(read.use.name.lstrip("~"))


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
