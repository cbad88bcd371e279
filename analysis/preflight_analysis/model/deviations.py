"""The one of many that is written otherwise: nodes of one executable, and includes of one file.

What many places do alike is a rule that nobody wrote down, and the one that does otherwise is likely to be a slip
(Engler et al., "Bugs as deviant behavior", SOSP 2001). Many come of a block that is copied, one of whose names is not
changed (Li et al., "CP-Miner", OSDI 2004).
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Literal, NamedTuple

from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.moveit import moveit_params
from preflight_analysis.evaluation.tree import Include, LaunchNode, LaunchTree
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context

LEAST = 4
"""Siblings that there have to be: three agree."""
_MOST_DEVIATIONS = 2
"""Whatever differs in more is meant to be another one."""
_PARTS = re.compile(r"\d+|[A-Za-z]+")
_LETTER = re.compile(r"[A-Za-z]")
_OWN = "\0"
What = Literal["parameter", "remap", "argument"]


class Value(NamedTuple):
    """What a sibling gives something, as text, and where."""

    text: str
    place: Location


class Sibling(NamedTuple):
    """One of several that are written alike. `name` is what it is called, or what it alone is given."""

    name: str
    place: Location
    values: Mapping[tuple[What, str], Value]


class Deviation(NamedTuple):
    """That one of so many `siblings` has another value, or none, where all others have one by one pattern; `expected`
    is what that gives for it, and `other` is the part of another one's name that its value has."""

    sibling: Sibling
    siblings: int
    what: What
    name: str
    value: Value | None
    expected: str
    other: str = ""


@derived
def deviating_nodes(context: Context) -> tuple[Deviation, ...]:
    """Those of nodes that have package and executable, or plugin, in common."""
    groups: dict[tuple[str, str, str], list[LaunchNode]] = {}
    for node in context.tree.nodes:
        if node.package and not node.unknowns:
            groups.setdefault((node.package, node.executable, node.plugin or ""), []).append(node)
    return tuple(
        deviation
        for nodes in groups.values()
        if len(nodes) >= LEAST
        for deviation in _deviations([_of_node(context.tree, node) for node in nodes])
    )


@derived
def deviating_includes(context: Context) -> tuple[Deviation, ...]:
    """Those of includes of one file."""
    groups: dict[str, list[Include]] = {}
    for include in context.tree.includes:
        if include.path is not None:
            groups.setdefault(include.path, []).append(include)
    return tuple(
        deviation
        for includes in groups.values()
        if len(includes) >= LEAST
        for deviation in _deviations(_of_includes(includes))
    )


def _of_node(tree: LaunchTree, node: LaunchNode) -> Sibling:
    values: dict[tuple[What, str], Value] = {}
    for name, param in moveit_params(tree, node).items():
        values["parameter", name] = Value(str(param.value), param.place)
    for remap in node.remaps:
        values["remap", remap.source] = Value(remap.target, remap.target_location)
    return Sibling(node.name, node.location, values)


def _of_includes(includes: Sequence[Include]) -> list[Sibling]:
    """They are called by the first argument that is another one for each."""
    given = [{name: value for name, value in each.args.items() if value is not None} for each in includes]
    names = [name for name in given[0] if len({each.get(name, "") for each in given} - {""}) == len(given)]
    return [
        Sibling(
            values[names[0]] if names else "",
            each.file_location,
            {("argument", name): Value(value, each.file_location) for name, value in values.items()},
        )
        for each, values in zip(includes, given, strict=True)
    ]


def _deviations(siblings: Sequence[Sibling]) -> Iterator[Deviation]:
    """None of those that one place makes: a loop, or one file that is included several times."""
    if len({each.place for each in siblings}) < len(siblings):
        return
    own = _own_parts([each.name for each in siblings])
    found: dict[int, list[Deviation]] = {}
    by_pattern: dict[tuple[What, str], dict[int, Value]] = {}
    for at, sibling in enumerate(siblings):
        for (what, name), value in sibling.values.items():
            by_pattern.setdefault((what, _pattern(name, own[at])), {})[at] = value
    for (what, name), values in by_pattern.items():
        patterns = {at: _pattern(value.text, own[at]) for at, value in values.items()}
        ((usual, count),) = Counter(patterns.values()).most_common(1)
        if count != len(siblings) - 1:
            continue
        at = next(at for at in range(len(siblings)) if patterns.get(at) != usual)
        odd, expected = values.get(at), usual.replace(_OWN, own[at])
        other = _named_by(odd.text, usual, own, at) if odd is not None else ""
        deviation = Deviation(siblings[at], len(siblings), what, name.replace(_OWN, own[at]), odd, expected, other)
        found.setdefault(at, []).append(deviation)
    if len(found) != 1:
        return
    ((at, deviations),) = found.items()
    if len(deviations) > _MOST_DEVIATIONS:
        return
    # Who has nothing of what the others have may be another kind of node.
    is_alike = len(by_pattern) > len(deviations)
    yield from (each for each in deviations if each.other or (each.value is None and is_alike))


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
