"""Parameters of nodes in Python launch files, as `launch_ros.utilities.evaluate_parameters` makes them of what was
given: plain values stay, substitutions are read as YAML, lists have items of one type."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from copy import copy
from functools import lru_cache
from typing import Any

from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS, load_plain
from preflight_analysis.evaluation.ros2.params import note_lacks
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.types import NotOfTypeError, coerce, is_of_type
from preflight_analysis.evaluation.tree import Param
from preflight_analysis.launch.model import Action, Value
from preflight_analysis.launch.problems import BadValue

EXPECTED = "a bool, a number, a text or a non-empty list of one of them"
_SCALARS = (bool, int, float, str)
_SHORT = 100
"""Characters of a text whose value is remembered: most nodes of a launch are given the same ones."""
_loaded = lru_cache(maxsize=1000)(load_plain)


class _UnknownError(Exception):
    """A substitution in the value is not known; why is noted."""


def dict_params(performer: Performer, action: Action, node: str) -> list[Param]:
    """The parameters of one dictionary, in order."""
    return named_params(performer, (child for child in action.children if child.kind == "param"), node)


def named_params(performer: Performer, actions: Iterable[Action], node: str) -> list[Param]:
    """Those of which a name and a value are given, which is YAML where it is a text."""
    found = []
    for action in actions:
        name_value = action.value("name")
        if name_value is None:
            continue
        name = performer.value(name_value)
        known, value = python_value(performer, action)
        if known and name.known:
            location = performer.place.location(name_value.span)
            note_lacks(performer.state, name.text, value, location)
            found.append(Param(name.text, value, performer.place.origin(action.head_span), node, location))
    return found


def python_value(performer: Performer, action: Action) -> tuple[bool, Any]:
    """Whether the value of a parameter is known, and it."""
    try:
        return True, _value(performer, action)
    except _UnknownError:
        return False, None
    except NotOfTypeError as problem:
        value = action.value("value")
        span = value.span if value is not None else action.head_span
        name, written = (_text(performer, action, each) for each in ("name", "value"))
        bad = BadValue("parameters", name, written, str(problem))
        performer.state.problem(bad, performer.place.origin(span))
        return False, None


def _text(performer: Performer, action: Action, name: str) -> str:
    value = action.value(name)
    return performer.value(value).text if value is not None else ""


def _value(performer: Performer, action: Action) -> Any:
    form, value, type_value = action.value("form"), action.value("value"), action.value("type")
    type_name = type_value.text if type_value is not None else None
    if form is not None and form.text == "items":
        items = [_item(performer, child, type_name) for child in action.children if child.kind == "item"]
        if type_name is None:
            return _uniform(items)
        if not is_of_type(items, type_name):
            raise NotOfTypeError("a list of one type")
        return items
    if type_name is None:
        return _given(performer, value, _yaml)
    return _given(performer, value, lambda text: coerce(text, type_name))


def _item(performer: Performer, action: Action, type_name: str | None) -> Any:
    value = action.value("value")
    if type_name is None:
        return _given(performer, value, _load)
    return _given(performer, value, lambda text: coerce(text, type_name.removeprefix("list_of_")))


def _given(performer: Performer, value: Value | None, read: Callable[[str], Any]) -> Any:
    """A value that Python gave as it is, or what is read in the text of one with substitutions."""
    if value is None:
        raise _UnknownError
    if value.typed is not None:
        return value.typed.value
    result = performer.value(value)
    if not result.known:
        raise _UnknownError
    return read(result.text)


def _yaml(text: str) -> Any:
    value = _load(text or "''")
    if isinstance(value, list):
        return _uniform(value)
    if not isinstance(value, _SCALARS):
        raise NotOfTypeError(EXPECTED + "; a text that is none of it as YAML needs ParameterValue(..., value_type=str)")
    return value


def _load(text: str) -> Any:
    try:
        return copy(_loaded(text)) if len(text) <= _SHORT else load_plain(text)
    except CONSTRUCTION_ERRORS:
        raise NotOfTypeError("YAML; if it is a text: ParameterValue(..., value_type=str)") from None


def _uniform(items: list[Any]) -> list[Any]:
    kind = type(items[0]) if items else None
    if kind not in _SCALARS or not all(isinstance(each, kind) for each in items):
        raise NotOfTypeError(EXPECTED)
    return items
