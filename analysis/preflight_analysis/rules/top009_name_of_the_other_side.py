"""TOP009: of two remaps or parameters, one for each side, both have the name of one side."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, pairwise
from typing import NamedTuple

from preflight_analysis.documents.span import Location, Origin
from preflight_analysis.evaluation.tree import LaunchNode, Param, Remap
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import words_in
from preflight_analysis.model.parameters import groups_of_params
from preflight_analysis.model.problems import include_chain
from preflight_analysis.rules.further_reading import NAMES, TOPIC_NAMES
from preflight_analysis.rules.rule import Rule

_SIDES = (("left", "right"), ("front", "rear"), ("front", "back"), ("upper", "lower"), ("top", "bottom"))
_OTHER_SIDE = {(one, other) for pair in _SIDES for one, other in (pair, pair[::-1])}
_LONGEST = 200
"""Characters of a value that may be a name."""


class _Named(NamedTuple):
    """A name that a node is given: for which of its own, and where that is written."""

    own: str
    given: str
    place: Location
    origin: Origin


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    reported: set[Location] = set()
    yield from _findings(rule, chain.from_iterable(context.each(_copies_of, context.tree.nodes)), reported)
    if not context.tree.ros.own_parameters:
        found = context.each(_copies_among, groups_of_params(context))
        yield from _findings(rule, chain.from_iterable(found), reported)


def _findings(rule: Rule, found: Iterable[tuple[_Named, _Named]], reported: set[Location]) -> Iterator[Finding]:
    for first, second in found:
        if second.place in reported:
            continue
        reported.add(second.place)
        yield rule.claim(
            f"'{second.own}' has the name of the other side: '{second.given}', which '{first.own}' has too",
            second.place,
            subject=Subject("name", second.own),
            related=(Related(f"'{first.own}' has it here", first.place), *include_chain(second.origin)),
        )


def _copies_of(node: LaunchNode) -> tuple[tuple[_Named, _Named], ...]:
    remaps = _copies(map(_of_remap, node.remaps))
    return (*remaps, *_copies_among(node.params))


def _copies_among(params: tuple[Param, ...]) -> tuple[tuple[_Named, _Named], ...]:
    return _copies(map(_of_param, params))


def _of_remap(remap: Remap) -> _Named:
    return _Named(remap.source, remap.target, remap.target_location, remap.origin)


def _of_param(param: Param) -> _Named:
    given = param.value if isinstance(param.value, str) else ""
    return _Named(param.name, given, param.place, param.origin)


def _copies(names: Iterable[_Named]) -> tuple[tuple[_Named, _Named], ...]:
    """The pairs with one value: the one that it is of, and the one that it is not of."""
    by_value: dict[str, list[_Named]] = {}
    for each in names:
        if each.given and len(each.given) <= _LONGEST:
            by_value.setdefault(each.given, []).append(each)
    return tuple(
        (first, second)
        for given, alike in by_value.items()
        if len(alike) == len(_SIDES[0])
        for first, second in (alike, alike[::-1])
        if _is_of_first(words_in(first.own), words_in(second.own), words_in(given))
    )


def _is_of_first(own: Sequence[str], other: Sequence[str], given: Sequence[str]) -> bool:
    """Whether names are the same but for a side or a number, of which the value has the first one alone."""
    different = [at for at, (one, two) in enumerate(zip(own, other, strict=False)) if one != two]
    if len(own) != len(other) or len(different) != 1:
        return False
    at = different[0]
    mine, theirs = own[at], other[at]
    if mine.isdigit() and theirs.isdigit():
        numbers = {number for stem, number in pairwise(given) if at and stem == own[at - 1]}
        return mine in numbers and theirs not in numbers
    return (mine, theirs) in _OTHER_SIDE and mine in given and theirs not in given


RULE = Rule(
    id="TOP009",
    name="name-of-the-other-side",
    effect="misbehaves",
    kind="duplicate",
    always=(Reason.DEPENDS,),
    what="Checks for two remaps or parameters of one node that differ in a side (`left`, `right`) or a number. Both "
    "have the same value, which names the first side only.",
    why="The line was copied and its value was not changed. The node gets the data of one side twice.",
    example='<remap from="left/image" to="/stereo/left/image_raw"/>\n'
    '<remap from="right/image" to="/stereo/left/image_raw"/>',
    instead='<remap from="left/image" to="/stereo/left/image_raw"/>\n'
    '<remap from="right/image" to="/stereo/right/image_raw"/>',
    references=(NAMES, TOPIC_NAMES),
    check=_check,
    every_root=True,
)
