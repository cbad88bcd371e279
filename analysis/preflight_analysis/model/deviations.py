"""The one of many that is written otherwise: nodes of one executable, and includes of one file.

What many places do alike is a rule that nobody wrote down, and the one that does otherwise is likely to be a slip
(Engler et al., "Bugs as deviant behavior", SOSP 2001). Many come of a block that is copied, one of whose names is not
changed (Li et al., "CP-Miner", OSDI 2004).
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Hashable, Iterator, Sequence
from typing import Literal, NamedTuple, TypeAlias

from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.meanings import own_params
from preflight_analysis.evaluation.tree import Include, LaunchNode, Param
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context
from preflight_analysis.model.parameters import namespace_of

LEAST = 4
"""Siblings that there have to be: three agree."""
_MOST = 100
"""More are written by a program, which makes no slips of this kind, and each edit would compare them all."""
_MOST_DEVIATIONS = 2
"""Whatever differs in more is meant to be another one."""
_PARTS = re.compile(r"\d+|[A-Za-z]+")
_LETTER = re.compile(r"[A-Za-z]")
_OWN = "\0"
What = Literal["parameter", "remap", "argument"]


class Sibling(NamedTuple):
    """One of several that are written alike. `name` is what it is called, or what it alone is given; `values` is what
    it gives to what, as texts."""

    name: str
    place: Location
    values: tuple[tuple[What, str, str], ...]


class Deviation(NamedTuple):
    """That one of so many `siblings` has another value, or none, where all others have one by one pattern; `expected`
    is what that gives for it, and `other` is the part of another one's name that its value has."""

    name_of: str
    place: Location
    siblings: int
    what: What
    name: str
    value: str | None
    expected: str
    other: str = ""


class _Odd(NamedTuple):
    """The same by the number of the sibling, without places."""

    at: int
    what: What
    name: str
    value: str | None
    expected: str
    other: str


_Patterned: TypeAlias = tuple[tuple[What, str, str, str], ...]
"""What a sibling gives: to what, by which pattern of names, by which of values, and the value itself."""


@derived
def deviating_nodes(context: Context) -> tuple[Deviation, ...]:
    """Those of nodes that have package and executable, or plugin, in common."""
    tree = context.tree
    groups: dict[tuple[str, str, str], list[LaunchNode]] = {}
    for node in tree.nodes:
        if node.package and not node.unknowns:
            groups.setdefault((node.package, node.executable, node.plugin or ""), []).append(node)
    groups = {key: nodes for key, nodes in groups.items() if LEAST <= len(nodes) <= _MOST}
    if not groups:
        return ()
    below = {} if tree.ros.own_parameters else context.grouped(namespace_of, "siblings", tree.all_params)
    found: list[Deviation] = []
    for key, nodes in groups.items():
        given = [node.params if tree.ros.own_parameters else below.get(node.name, ()) for node in nodes]
        siblings = [
            Sibling(node.name, node.location, values)
            for node, values in zip(nodes, context.each_row(_values_of, (nodes, given)), strict=True)
        ]
        for each in _deviations(context, key, siblings):
            at = next(at for at, node in enumerate(nodes) if node.location == each.place)
            places = {
                **{("parameter", name): param.place for name, param in own_params(nodes[at], given[at])},
                **{("remap", remap.source): remap.target_location for remap in nodes[at].remaps},
            }
            found.append(each._replace(place=places.get((each.what, each.name), each.place)))
    return tuple(found)


@derived
def deviating_includes(context: Context) -> tuple[Deviation, ...]:
    """Those of includes of one file."""
    groups: dict[str, list[Include]] = {}
    for include in context.tree.includes:
        if include.path is not None:
            groups.setdefault(include.path, []).append(include)
    return tuple(
        each
        for path, includes in groups.items()
        if LEAST <= len(includes) <= _MOST
        for each in _deviations(context, path, _of_includes(includes))
    )


def _values_of(node: LaunchNode, given: Sequence[Param]) -> tuple[tuple[What, str, str], ...]:
    found: list[tuple[What, str, str]] = [
        ("parameter", name, str(param.value)) for name, param in own_params(node, given)
    ]
    found += [("remap", remap.source, remap.target) for remap in node.remaps]
    return tuple(found)


def _of_includes(includes: Sequence[Include]) -> list[Sibling]:
    """They are called by the first argument that is another one for each."""
    given = [{name: value for name, value in each.args.items() if value is not None} for each in includes]
    names = [name for name in given[0] if len({each.get(name, "") for each in given} - {""}) == len(given)]
    return [
        Sibling(
            values[names[0]] if names else "",
            each.file_location,
            tuple(("argument", name, value) for name, value in values.items()),
        )
        for each, values in zip(includes, given, strict=True)
    ]


def _deviations(context: Context, key: Hashable, siblings: Sequence[Sibling]) -> Iterator[Deviation]:
    """None of those that one place makes: a loop, or one file that is included several times."""
    if len({each.place for each in siblings}) < len(siblings):
        return
    own = _own_parts([each.name for each in siblings])
    patterned = context.each_row(_patterned, ([each.values for each in siblings], own))
    for each in context.one(_odd_ones, key, patterned, tuple(own)):
        sibling = siblings[each.at]
        yield Deviation(sibling.name, sibling.place, len(siblings), *each[1:])


def _patterned(values: tuple[tuple[What, str, str], ...], own: str) -> _Patterned:
    """Names of topics have those of nodes in them, names of parameters and arguments have not."""
    return tuple(
        (what, _pattern(name, own) if what == "remap" else name, _pattern(text, own), text)
        for what, name, text in values
    )


def _odd_ones(siblings: tuple[_Patterned, ...], own: tuple[str, ...]) -> tuple[_Odd, ...]:
    by_name: dict[tuple[What, str], dict[int, tuple[str, str]]] = {}
    for at, values in enumerate(siblings):
        for what, name, pattern, text in values:
            by_name.setdefault((what, name), {})[at] = pattern, text
    found: dict[int, list[_Odd]] = {}
    for (what, name), given in by_name.items():
        ((usual, count),) = Counter(pattern for pattern, _ in given.values()).most_common(1)
        if count != len(siblings) - 1:
            continue
        at = next(at for at in range(len(siblings)) if at not in given or given[at][0] != usual)
        value = given[at][1] if at in given else None
        other = _named_by(value, usual, own, at) if value is not None else ""
        odd = _Odd(at, what, name.replace(_OWN, own[at]), value, usual.replace(_OWN, own[at]), other)
        found.setdefault(at, []).append(odd)
    if len(found) != 1:
        return ()
    ((at, odd_ones),) = found.items()
    if len(odd_ones) > _MOST_DEVIATIONS:
        return ()
    # Who has nothing of what the others have may be another kind of node.
    is_alike = len(by_name) > len(odd_ones)
    return tuple(each for each in odd_ones if each.other or (each.value is None and is_alike))


def _own_parts(names: Sequence[str]) -> list[str]:
    """The one part in which each name differs from all others, empty where there is none."""
    parts = [_PARTS.findall(name) for name in names]
    if len({len(each) for each in parts}) == 1:
        columns = [set(column) for column in zip(*parts, strict=True)]
        differing = [at for at, column in enumerate(columns) if len(column) > 1]
        if len(differing) == 1 and len(columns[differing[0]]) == len(names):
            return [each[differing[0]] for each in parts]
    return [""] * len(names)


def _pattern(text: str, own: str) -> str:
    """A text with a mark in the place of the part that its sibling alone has. A number counts beside letters only."""
    if not own or (own.isdecimal() and _LETTER.search(text) is None):
        return text
    return _bounded(own).sub(_OWN, text)


def _bounded(part: str) -> re.Pattern[str]:
    kind = r"\d" if part.isdecimal() else "[A-Za-z]"
    return re.compile(rf"(?<!{kind}){re.escape(part)}(?!{kind})")


def _named_by(text: str, usual: str, own: Sequence[str], at: int) -> str:
    """The part of another sibling that a text has in the place of its own."""
    others = (each for number, each in enumerate(own) if number != at and each)
    return next((each for each in others if usual.replace(_OWN, each) == text), "") if _OWN in usual else ""
