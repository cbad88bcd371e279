"""What a launch sets on the parameter server, against what its nodes ask for, brought up to date name by name."""

from __future__ import annotations

from collections.abc import Mapping
from collections.abc import Set as AbstractSet
from itertools import chain, compress
from operator import attrgetter, is_not
from typing import NamedTuple

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import Param
from preflight_analysis.graph.model import ParamRead
from preflight_analysis.incremental.kept import Before
from preflight_analysis.model.name_tally import NO_NAMES, NameTally

_ASKING = ("get", "has")
_LOOKING = ("list", "search")
_NAME = attrgetter("name")


@dataclass(frozen=True, slots=True, eq=False)
class Asked:
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


_NOTHING = Asked((), {}, (), (), False)


def asked_by(reads: tuple[ParamRead, ...]) -> Asked:
    """What the reads of one node come to."""
    asking = [read for read in reads if read.use.access in _ASKING]
    others = [read for read in reads if read.use.access not in _ASKING]
    requested: dict[str, ParamRead] = {}
    for read in asking:
        if not read.use.builtin:
            requested.setdefault(read.name.rstrip("/") or "/", read)
    return Asked(
        tuple(read.name.rstrip("/") or "/" for read in asking),
        requested,
        tuple(read.name for read in others if read.use.access not in _LOOKING),
        tuple(read for read in others if read.use.access == "search"),
        any(read.use.access == "list" for read in others),
    )


NOBODY = ""
"""In place of the name of a node."""


@dataclass(frozen=True, slots=True, eq=False)
class Space:
    """The parameters of one namespace."""

    unread: tuple[Param, ...]
    """Those that nobody asks for, nor for anything below them, nor searches for a name in them."""
    holder: str | None
    """The full name of the node whose they are, `NOBODY`; None where somebody asks for them as a whole, and where it
    is not known what that node reads."""


class Held(NamedTuple):
    """What is unread of the parameters of a node in one namespace."""

    holder: str
    unread: tuple[Param, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Matched:
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
    spaces: Mapping[str, Space]
    private: tuple[Held, ...]
    """Of nodes of which it is known what they read."""
    orphans: tuple[Param, ...]
    """What is unread in the namespaces of no node."""


_Groups = Mapping[str, tuple[Param, ...]]


def matched(
    before: Before[Matched] | None,
    groups: _Groups,
    asked: tuple[Asked, ...],
    nodes: tuple[str, ...],
    known: tuple[bool, ...],
) -> Matched:
    """`groups` are the parameters by namespace; of each node `asked` is what it asks for, `nodes` its name, `known`
    whether that is all.

    What follows from names that neither came nor went is that of before.
    """
    old_groups: _Groups = {}
    old_asked: tuple[Asked, ...] = (_NOTHING,) * len(asked)
    old_nodes: tuple[str, ...] = ()
    last = Matched(NO_NAMES, NO_NAMES, set(), {}, {}, ((),) * len(asked), set(), set(), {}, (), False, {}, {}, (), ())
    if before is not None and len(before[0][1]) == len(asked):
        (old_groups, old_asked, old_nodes, _), last = before
    # A group is of one namespace: where the same one is at the same place, so is its name.
    aligned = len(groups) == len(old_groups)
    if aligned:
        others = [*map(is_not, groups.values(), old_groups.values())]
        new_groups = [*dict.fromkeys((*compress(groups, others), *compress(old_groups, others)))]
    else:
        new_groups = [space for space, group in groups.items() if old_groups.get(space) is not group]
        new_groups += [space for space in old_groups if space not in groups]
    renamed = [space for space in new_groups if _names(old_groups, space) != _names(groups, space)]
    given, given_news = last.given.changed(
        chain.from_iterable(_names(old_groups, space) for space in renamed),
        chain.from_iterable(_names(groups, space) for space in renamed),
    )
    rows = [at for at, (old, each) in enumerate(zip(old_asked, asked, strict=True)) if old is not each]
    others_asked = [at for at in rows if not _ask_for_the_same(old_asked[at], asked[at])]
    tally, asked_news = last.asked.changed(
        [name for at in others_asked for name in (*old_asked[at].names, *old_asked[at].made)],
        [name for at in others_asked for name in (*asked[at].names, *asked[at].made)],
    )
    made = {name for each in asked for name in each.made}

    askers, unset = dict(last.askers), dict(last.unset)
    requested: set[str] = set()
    for at in others_asked:
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
        if step:
            leaves[names.leaf(name)] = leaves.get(names.leaf(name), 0) + step
    sought: dict[str, ParamRead] = {}
    searches = [read for each in asked for read in each.searches]
    leaves_made = set(map(names.leaf, made)) if searches else set()
    for read in searches:
        leaf = sought_leaf(read)
        if not leaves.get(leaf) and leaf not in leaves_made:
            sought.setdefault(leaf, read)

    opaque = {name for name, each, is_known in zip(nodes, asked, known, strict=True) if each.lists or not is_known}
    searched = {read.use.name.strip("~/").partition("/")[0] for read in searches}
    around = {**last.around, **{space: _around(space) for space in new_groups if space not in last.around}}
    for space in new_groups:
        if space not in groups:
            around.pop(space, None)
    new_names = asked_news | (opaque ^ last.opaque) | {*nodes}.symmetric_difference(old_nodes)
    new_spaces = {*new_groups, *map(_namespace, asked_news)}
    if searched != last.searched:
        new_spaces.update(groups)
    if new_names:
        new_spaces.update(space for space, spaces in around.items() if not new_names.isdisjoint(spaces))
    of_nodes = frozenset(nodes)
    of_new = {
        space: _space(space, groups[space], tally, searched, of_nodes, opaque)
        for space in new_spaces
        if space in groups
    }
    spaces = {space: of_new.get(space) or last.spaces[space] for space in groups}
    replaced = {each.holder for space in new_spaces for each in (last.spaces.get(space), of_new.get(space)) if each}
    private, orphans = last.private, last.orphans
    if not aligned or not replaced <= {None, NOBODY}:
        private = tuple(Held(each.holder, each.unread) for each in spaces.values() if each.holder and each.unread)
    if not aligned or NOBODY in replaced:
        orphans = tuple(chain.from_iterable(each.unread for each in spaces.values() if each.holder == NOBODY))
    return Matched(
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


def _names(groups: _Groups, space: str) -> list[str]:
    return [*map(_NAME, groups.get(space, ()))]


def _ask_for_the_same(one: Asked, other: Asked) -> bool:
    same = one.names == other.names and one.made == other.made
    return same and one.requested.keys() == other.requested.keys()


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
) -> Space:
    names_asked, around_asked = asked.counts, asked.around
    unread = tuple([param for param in params if (name := param.name) not in names_asked and name not in around_asked])
    if searched:
        unread = tuple(param for param in unread if searched.isdisjoint(param.name.split("/")))
    holder: str | None = NOBODY
    while space:
        if space in asked.counts:
            return Space(unread, None)
        if space in nodes and holder == NOBODY:
            holder = space
        space = _namespace(space)
    return Space(unread, None if holder in opaque else holder)


def sought_leaf(read: ParamRead) -> str:
    """The last part of the name that is searched for."""
    return names.leaf(read.use.name.lstrip("~"))
