"""The one of many that is written otherwise: nodes of one executable, and includes of one file.

What many places do alike is a rule that nobody wrote down, and the one that does otherwise is likely to be a slip
(Engler et al., "Bugs as deviant behavior", SOSP 2001). Many come of a block that is copied, one of whose names is not
changed (Li et al., "CP-Miner", OSDI 2004).
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from typing import Literal, NamedTuple

from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.meanings import own_params
from preflight_analysis.evaluation.tree import Include, LaunchNode, Param
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context
from preflight_analysis.model.parameters import by_namespace

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
    it gives to what, as texts, and where."""

    name: str
    place: Location
    values: tuple[tuple[What, str, str, Location], ...]


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


class _Given(NamedTuple):
    """A value of a sibling, and the pattern of names by which it is written."""

    pattern: str
    text: str
    place: Location


@derived
def deviating_nodes(context: Context) -> tuple[Deviation, ...]:
    """Those of nodes that have package and executable, or plugin, in common."""
    own, tree = context.tree.ros.own_parameters, context.tree
    below = {} if own else by_namespace(context)
    found: list[Deviation] = []
    for program, nodes in context.grouped(_program, "", tree.nodes).items():
        if program is not None and LEAST <= len(nodes) <= _MOST:
            given = tuple([node.params if own else below.get(node.name, ()) for node in nodes])
            found += context.one(_of_nodes, program, nodes, given)
    return tuple(found)


@derived
def deviating_includes(context: Context) -> tuple[Deviation, ...]:
    """Those of includes of one file."""
    found: list[Deviation] = []
    for path, includes in context.grouped(_path, "", context.tree.includes).items():
        if path is not None and LEAST <= len(includes) <= _MOST:
            found += context.one(_of_includes, path, includes)
    return tuple(found)


def _program(node: LaunchNode) -> tuple[str, str, str] | None:
    return (node.package, node.executable, node.plugin or "") if node.package and not node.unknowns else None


def _path(include: Include) -> str | None:
    return include.path


def _of_nodes(nodes: tuple[LaunchNode, ...], given: tuple[Sequence[Param], ...]) -> tuple[Deviation, ...]:
    siblings = []
    for node, params in zip(nodes, given, strict=True):
        values: list[tuple[What, str, str, Location]] = [
            ("parameter", name, str(param.value), param.place) for name, param in own_params(node, params)
        ]
        values += [("remap", remap.source, remap.target, remap.target_location) for remap in node.remaps]
        siblings.append(Sibling(node.name, node.location, tuple(values)))
    return _deviations(siblings)


def _of_includes(includes: tuple[Include, ...]) -> tuple[Deviation, ...]:
    """They are called by the first argument that is another one for each."""
    given = [{name: value for name, value in each.args.items() if value is not None} for each in includes]
    names = [name for name in given[0] if len({each.get(name, "") for each in given} - {""}) == len(given)]
    return _deviations(
        [
            Sibling(
                values[names[0]] if names else "",
                each.file_location,
                tuple(("argument", name, value, each.file_location) for name, value in values.items()),
            )
            for each, values in zip(includes, given, strict=True)
        ]
    )


def _deviations(siblings: Sequence[Sibling]) -> tuple[Deviation, ...]:
    """None of those that one place makes: a loop, or one file that is included several times."""
    if len({each.place for each in siblings}) < len(siblings):
        return ()
    own = _own_parts([each.name for each in siblings])
    by_name: dict[tuple[What, str], dict[int, _Given]] = {}
    for at, sibling in enumerate(siblings):
        for what, name, text, place in sibling.values:
            # Names of topics have those of nodes in them, names of parameters and arguments have not.
            common = _pattern(name, own[at]) if what == "remap" else name
            by_name.setdefault((what, common), {})[at] = _Given(_pattern(text, own[at]), text, place)
    found: dict[int, list[Deviation]] = {}
    for (what, name), given in by_name.items():
        ((usual, count),) = Counter(each.pattern for each in given.values()).most_common(1)
        if count != len(siblings) - 1:
            continue
        at = next(at for at in range(len(siblings)) if at not in given or given[at].pattern != usual)
        sibling, odd = siblings[at], given.get(at)
        found.setdefault(at, []).append(
            Deviation(
                sibling.name,
                odd.place if odd is not None else sibling.place,
                len(siblings),
                what,
                name.replace(_OWN, own[at]),
                odd.text if odd is not None else None,
                usual.replace(_OWN, own[at]),
                _named_by(odd.text, usual, own, at) if odd is not None else "",
            )
        )
    if len(found) != 1:
        return ()
    ((_, deviations),) = found.items()
    if len(deviations) > _MOST_DEVIATIONS:
        return ()
    # Who has nothing of what the others have may be another kind of node.
    is_alike = len(by_name) > len(deviations)
    return tuple(each for each in deviations if each.other or (each.value is None and is_alike))


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
