"""`<for>` and `<for_each>` of a launch newer than 3.7: the variables of each round."""

from __future__ import annotations

from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.types import loaded
from preflight_analysis.launch.model import Action
from preflight_analysis.launch.problems import BadValue

MAX_ROUNDS = 1_000


def rounds(performer: Performer, action: Action) -> list[dict[str, str]]:
    """What `$(index)` and `$(for-var)` stand for in each round, none where that is not known or wrong, which is
    noted."""
    value = action.value("len" if action.kind == "for" else "values")
    if value is None:
        return []
    result = performer.value(value)
    if not result.known:
        performer.context.cannot_follow(performer.place.origin(value.span)[-1])
        return []
    found = _indices(action, result.text) if action.kind == "for" else _sets(result.text)
    if found is None:
        attribute = "len" if action.kind == "for" else "values"
        expected = "an integer" if action.kind == "for" else "YAML maps with semicolons between"
        bad = BadValue(action.kind, attribute, result.text, expected)
        performer.state.problem(bad, performer.place.origin(value.span))
        return []
    return found[:MAX_ROUNDS]


def _indices(action: Action, text: str) -> list[dict[str, str]] | None:
    name = action.value("name")
    try:
        count = min(int(text), MAX_ROUNDS)
    except ValueError:
        return None
    return [{name.text if name is not None else "": str(index)} for index in range(count)]


def _sets(text: str) -> list[dict[str, str]] | None:
    found: list[dict[str, str]] = []
    for each in filter(None, text.strip().split(";")):
        try:
            values = loaded(each.strip())
        except CONSTRUCTION_ERRORS:
            return None
        if isinstance(values, dict):
            found.append({str(name): str(value) for name, value in values.items()})
        elif values is not None:
            return None
    return found
