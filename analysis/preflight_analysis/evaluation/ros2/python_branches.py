"""The actions of a Python launch file whose conditions are not all known: those of both branches.

An answer (`tracing/agents/fake_launch/serialize.py`) has what the file makes where it takes one branch of each
condition, and `branches` what it makes where it takes the other one of one of them. Together they are one list: what
both make is there as it is, with values that differ as not known; what one of them makes is below a record of the kind
`branch`.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from typing import Any

from preflight_analysis.evaluation.ros2.unknown_text import unknown_text
from preflight_analysis.slips import aligned

BRANCH = "branch"
"""The kind of such a record: `asked` names the condition for a reading, `taken` says in words when it is taken. Without
`taken` it is left out, and has the condition as `if` or `unless`."""
MAX_PAIRS = 100_000_000
"""Actions of two branches that are compared, each with each, at worst."""
_NAMES = ("name", "from")
_OF_ONE = ("i", "only", "p")
"""What a record has that may be otherwise in each branch: the number of an action, as that of `id`, what it depends on,
and where it is written."""


def together(answer: dict[str, Any], branches: object, *, callable: bool) -> dict[str, Any]:
    """An answer with what the other branches make. `callable`: code of the file's own may be called in these, too."""
    found = _together(answer, branches, callable=callable)
    actions = found.get("actions")
    if found is answer or not isinstance(actions, list):
        return answer
    return {**found, "actions": _in_branches(actions, frozenset(_places_of_all(actions)))}


def _together(answer: dict[str, Any], branches: object, *, callable: bool) -> dict[str, Any]:
    """The same, where actions that are made in one of the branches have that as `only`."""
    for branch in branches if isinstance(branches, list) else ():
        if isinstance(branch, dict) and isinstance(branch.get("if"), str):
            other = _together(branch, branch.get("branches"), callable=callable)
            answer = {**answer, **_Both(branch, callable=callable).of(answer, other)}
    return answer


def _in_branches(records: Sequence[Any], certain: frozenset[str]) -> list[Any]:
    """The actions, those that are made in one of the branches below a record of it. `certain` are the places at which
    others are made whatever the conditions are."""
    found: list[Any] = []
    for (only, place), group in groupby(records, lambda each: (_only(each), _place(each) in certain)):
        actions = [
            {**each, "c": _in_branches(_list(each.get("c")), certain)} if _is_record(each) else each for each in group
        ]
        shared = {"shared": ["true"]} if place else {}
        found += [_branch(actions, {"taken": [" and ".join(only)], **shared})] if only else actions
    return found


def _places_of_all(records: Sequence[Any]) -> Iterator[str]:
    """Where actions are made in each branch."""
    for each in records:
        if _is_record(each) and not _only(each) and each["k"] != BRANCH:
            yield _place(each)
            yield from _places_of_all(_list(each.get("c")))


def _place(record: Any) -> str:
    return json.dumps(record.get("p")) if isinstance(record, dict) else ""


def _branch(actions: list[Any], about: dict[str, Any]) -> dict[str, Any]:
    return {"k": BRANCH, "p": actions[0].get("p"), "a": about, "c": actions}


class _Both:
    """Two branches of one condition."""

    def __init__(self, branch: dict[str, Any], *, callable: bool) -> None:
        self._condition, self._holds = " ".join(branch["if"].split()), branch.get("holds") is True
        asked = branch.get("asked") if callable else None
        self._asked = {"asked": [asked]} if isinstance(asked, str) else {}

    def of(self, one: dict[str, Any], other: dict[str, Any]) -> dict[str, Any]:
        """What of an answer is another one than in `one`, as either may be right."""
        changed, others = _texts(one.get("set")), _texts(other.get("set"))
        removed, others_removed = set(_list(one.get("unset"))), set(_list(other.get("unset")))
        differ = _differing(changed, others) | (removed ^ others_removed)
        return {
            "actions": self._actions(_list(one.get("actions")), _list(other.get("actions"))),
            "set": {**changed, **self._unknown_texts(differ)},
            "unset": sorted(removed & others_removed),
            "env": {
                **(env := _texts(one.get("env"))),
                **self._unknown_texts(_differing(env, _texts(other.get("env")))),
            },
        }

    def _unknown_texts(self, names: Iterable[str]) -> dict[str, str]:
        return dict.fromkeys(sorted(names), unknown_text(self._condition))

    def _unknown(self) -> list[Any]:
        return [{"s": BRANCH, "w": [[self._condition]], "n": "", "p": None}]

    def _actions(self, one: list[Any], other: list[Any]) -> list[Any]:
        """Those of both. What is left out of `one` already is where it was."""
        if len(one) * len(other) > MAX_PAIRS or not all(map(_is_record, (*one, *other))):
            return one
        found: list[Any] = []
        before, made = 0, [index for index, each in enumerate(one) if each["k"] != BRANCH]
        for start, end, first, last, is_same in _aligned([one[index] for index in made], other):
            if not is_same:
                found += self._left_out(other[first:last])
            for number, index in enumerate(made[start:end], first):
                found += one[before:index]
                found.append(self._either(one[index], other[number]) if is_same else self._taken(one[index]))
                before = index + 1
        return [*found, *one[before:]]

    def _left_out(self, records: Sequence[Any]) -> Iterator[Any]:
        """What the other branch makes alone: actions, and named parts of one, which may be there or not."""
        actions = [each for each in records if _is_action(each)]
        if actions:
            yield _branch(actions, {"if" if self._holds else "unless": self._unknown(), **self._asked})
        yield from (self._perhaps(each) for each in records if not _is_action(each) and _name(each) is not None)

    def _taken(self, record: dict[str, Any]) -> dict[str, Any]:
        """What the first branch makes alone."""
        if not _is_action(record):
            return self._perhaps(record)
        said = f"{self._condition} is {'false' if self._holds else 'true'}"
        return {**record, "only": list(dict.fromkeys((*_only(record), said)))}

    def _either(self, one: dict[str, Any], other: dict[str, Any]) -> dict[str, Any]:
        """An action, or a part of one, that both make."""
        found = self._taken(one) if _only(other) and not _only(one) else one
        if shape(one) == shape(other):
            return found
        if one["k"] == "param":
            return self._perhaps(one)
        given, others = _attributes(one), _attributes(other)
        names = dict.fromkeys((*given, *others))
        is_same = {n: n == "id" or shape(given.get(n)) == shape(others.get(n)) for n in names}
        values = {n: given[n] if is_same[n] else self._unknown() for n in names if n in given or not is_same[n]}
        return {**found, "a": values, "c": self._actions(_list(one.get("c")), _list(other.get("c")))}

    def _perhaps(self, record: dict[str, Any]) -> dict[str, Any]:
        """A part of an action with its name, and a value that is not known."""
        values = {n: v if n in _NAMES else self._unknown() for n, v in _attributes(record).items() if n != "type"}
        if record["k"] == "param":
            values["form"] = ["yaml"]
        return {**record, "a": values, "c": []}


def _aligned(one: list[Any], other: list[Any]) -> Iterator[tuple[int, int, int, int, bool]]:
    """What of two lists is the same in a row, by its place in each: equal, or made in the same call; and the rest."""
    for start, end, first, last, is_same in aligned([*map(shape, one)], [*map(shape, other)]):
        if is_same:
            yield start, end, first, last, True
            continue
        mine, theirs = map(_identity, one[start:end]), map(_identity, other[first:last])
        for below, above, left, right, is_alike in aligned([*mine], [*theirs]):
            yield start + below, start + above, first + left, first + right, is_alike


def _identity(record: dict[str, Any]) -> str:
    """What is made in which call; of a part its name, of what is left out all of it."""
    if record["k"] == BRANCH:
        return shape(record)
    return json.dumps([record["k"], record.get("n"), record.get("i") if "n" in record else shape(_name(record))])


def _is_record(value: object) -> bool:
    return isinstance(value, dict) and isinstance(value.get("k"), str)


def _is_action(record: dict[str, Any]) -> bool:
    return "n" in record or record["k"] == BRANCH


def _name(record: dict[str, Any]) -> Any:
    attributes = _attributes(record)
    return next((attributes[name] for name in _NAMES if name in attributes), None)


def _only(record: Any) -> list[str]:
    return _list(record.get("only")) if isinstance(record, dict) else []


def _differing(one: dict[str, str], other: dict[str, str]) -> set[str]:
    return {name for name in {*one, *other} if one.get(name) != other.get(name)}


def shape(value: Any) -> str:
    """All that is known of something, whichever branches make it."""
    return json.dumps(_in_any_branch(value), sort_keys=True)


def _in_any_branch(value: Any) -> Any:
    if isinstance(value, list):
        return [_in_any_branch(each) for each in value]
    if not isinstance(value, dict):
        return value
    if isinstance(value.get("x"), str):
        return value["x"]
    found = {name: _in_any_branch(each) for name, each in value.items() if name not in _OF_ONE}
    if found.get("s") == "own" and isinstance(found.get("w"), list):
        found["w"] = found["w"][1:]
    if "n" in found and isinstance(found.get("a"), dict):
        found["a"].pop("id", None)
    return found


def _attributes(record: dict[str, Any]) -> dict[str, Any]:
    found = record.get("a")
    return found if isinstance(found, dict) else {}


def _list(value: object) -> list[Any]:
    return value if isinstance(value, list) else []


def _texts(value: object) -> dict[str, str]:
    return value if isinstance(value, dict) else {}
