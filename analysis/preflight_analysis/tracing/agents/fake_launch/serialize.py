"""What was made, as JSON for the host: kind, attributes (pieces of text and substitutions), children, and where.

An action is `{"k": kind, "n": class, "p": [line, column], "a": {name: value}, "c": [children]}`, with `"i"` its number
if the host may ask for its execution. A value is a list of pieces, or `{"v": plain}`. A piece is a text, or
`{"s": command, "w": [words], "n": class, "p": place}`. A text of which is known where it is written is
`{"x": text, "p": place}`, and a plain one has `p` as well: lines and columns of begin and end.
"""

from __future__ import annotations

import contextlib
import itertools
from typing import Any, Iterable, Iterator, Optional

from ..anything import MARKS, AnyBase, Anything, is_unknown, name_of
from .base import (
    RECORDER,
    Action,
    Condition,
    LaunchDescription,
    Substitution,
    TextSubstitution,
    normalize_to_list_of_substitutions,
    overrides,
)
from .conditions import IfCondition, LaunchConfigurationEquals
from .ros_nodes import ComposableNode
from .ros_parameters import ParameterValue
from .ros_substitutions import FindPackage
from .worded import Worded

MAX_ACTIONS = 20_000
MAX_PARTS = 200_000
MAX_DEPTH = 100


class TooMuchError(Exception):
    """More actions, or more of what they are given, than anyone writes."""


class Serializer:
    """Tells one launch description."""

    def __init__(self) -> None:
        self.count = 0
        self._parts = 0
        self._open: list[dict[str, Any]] = []

    def description(self, entities: Iterable[Any]) -> list[dict[str, Any]]:
        """The actions of a launch description."""
        root: dict[str, Any] = {"c": []}
        self._open.append(root)
        self.entities(entities)
        self._open.pop()
        found: list[dict[str, Any]] = root["c"]
        return found

    # What the actions call

    @property
    def kind(self) -> str:
        """That of the action that is told."""
        return str(self._open[-1]["k"])

    @kind.setter
    def kind(self, kind: str) -> None:
        self._open[-1]["k"] = kind

    def entities(self, entities: Iterable[Any]) -> None:
        """Its children."""
        for entity in entities:
            if isinstance(entity, (list, tuple)):
                self.entities(entity)
            elif isinstance(entity, (Anything, AnyBase)):
                self.child("stand_in", what=entity)
            elif entity is not None:
                self.entity(entity)

    def attribute(self, name: str, value: Any) -> None:
        """One value; None is left out."""
        if value is not None:
            self._open[-1]["a"][name] = self._value(value)

    def child(self, kind: str, **attributes: Any) -> None:
        """A child that is no object of the user's."""
        serialized = {name: self._value(value) for name, value in attributes.items() if value is not None}
        self._open[-1]["c"].append({"k": kind, "a": serialized, "c": []})

    @contextlib.contextmanager
    def inside(self, kind: str) -> Iterator[None]:
        """A child that has children."""
        made: dict[str, Any] = {"k": kind, "a": {}, "c": []}
        self._open[-1]["c"].append(made)
        self._open.append(made)
        yield
        self._open.pop()

    def parameter(self, name: Any, value: Any) -> None:
        """A parameter of a node: `form` says how its value is to be read."""
        made: dict[str, Any] = {"k": "param", "a": {"name": self._value(name)}, "c": []}
        self._open[-1]["c"].append(made)
        serialized = made["a"]
        if isinstance(value, ParameterValue):
            self._typed(made, value)
        elif isinstance(value, tuple):
            form, inner = value
            serialized["form"] = [form]
            if form == "yaml":
                serialized["value"] = self.parts(inner)
            elif form == "list":
                serialized["value"] = {"v": inner}
            else:
                self._items(made, inner)
        elif is_unknown(value):
            serialized["form"], serialized["value"] = ["yaml"], self.parts(value)
        else:
            serialized["form"] = ["plain"]
            serialized["value"] = _of_plain(value.decode(errors="replace") if isinstance(value, bytes) else value)

    def _typed(self, made: dict[str, Any], value: ParameterValue) -> None:
        inner, serialized = value.value, made["a"]
        serialized["type"] = [value.preflight_type or "yaml"]
        if _plain(inner) and not is_unknown(inner):
            serialized["form"], serialized["value"] = ["plain"], _of_plain(inner)
        elif is_unknown(inner) or (inner and all(isinstance(each, Substitution) for each in inner)):
            serialized["form"], serialized["value"] = ["typed"], self.parts(inner)
        else:
            serialized["form"] = ["items"]
            self._items(made, inner)

    def _items(self, made: dict[str, Any], items: Iterable[Any]) -> None:
        for each in items:
            # A text as it is stays one, whatever it would be as YAML.
            value = _of_plain(each) if _plain(each) and not is_unknown(each) else self.parts(each)
            made["c"].append({"k": "item", "a": {"value": value}, "c": []})

    # Entities

    def entity(self, entity: Any) -> None:
        """One of the user's objects."""
        self.count += 1
        if self.count > MAX_ACTIONS or len(self._open) > MAX_DEPTH:
            raise TooMuchError
        made: dict[str, Any] = {"k": "unknown", "n": type(entity).__name__, "a": {}, "c": []}
        made["p"], made["i"] = getattr(entity, "preflight_place", None), getattr(entity, "preflight_id", 0)
        self._open[-1]["c"].append(made)
        self._open.append(made)
        try:
            self._serialize_entity(entity)
        except TooMuchError:
            raise
        except Exception as error:
            made["error"] = f"{type(error).__name__}: {error}"
        finally:
            self._open.pop()

    def _serialize_entity(self, entity: Any) -> None:
        if isinstance(entity, Action):
            self.condition(entity.condition)
        elif not isinstance(entity, (LaunchDescription, ComposableNode)):
            raise TypeError(f"'{type(entity).__name__}' is no action")
        if isinstance(entity, Action) and overrides(entity, "execute"):
            self.kind = "opaque"
        else:
            self._told(entity)

    def _told(self, entity: Any) -> None:
        self.kind = entity.preflight_call.kind or "unknown"
        if self.kind != "opaque":
            entity.preflight_serialize(self)

    def plain_entity(self, entity: Any) -> dict[str, Any]:
        """An action that the user's own one is made from, as if it were just that."""
        made: dict[str, Any] = {"k": "unknown", "n": type(entity).__name__, "a": {}, "c": []}
        made["p"], made["i"] = getattr(entity, "preflight_place", None), 0
        self._open.append(made)
        self._told(entity)
        self._open.pop()
        return made

    def condition(self, condition: Optional[Condition]) -> None:
        """`if` or `unless`."""
        if condition is None:
            return
        if isinstance(condition, (Anything, AnyBase)):
            self.attribute("if", condition)
            return
        known = isinstance(condition, (IfCondition, LaunchConfigurationEquals))
        if known and not overrides(condition, "evaluate"):
            self.attribute(condition.attribute, condition.expression)  # type: ignore[attr-defined]
        elif not hasattr(condition, "evaluate"):
            raise AttributeError(f"{type(condition).__name__!r} object has no attribute 'evaluate'")
        else:
            self._open[-1]["a"]["if"] = [_own(condition)]

    # Values

    def _value(self, value: Any) -> Any:
        if _plain(value) and not isinstance(value, str):
            return {"v": value}
        if isinstance(value, dict):
            return {"v": str(value)}
        return self.parts(value)

    def parts(self, value: Any) -> list[Any]:
        """The pieces of a text."""
        return [part for sub in normalize_to_list_of_substitutions(value) for part in self._pieces(sub)]

    def _pieces(self, sub: Any) -> Iterable[Any]:
        """One piece, or those of a text in which something is not known."""
        self._parts += 1
        if self._parts > MAX_PARTS:
            raise TooMuchError
        if type(sub) is not TextSubstitution or not is_unknown(sub.text):
            yield self._part(sub)
            return
        for known, marks in itertools.zip_longest(MARKS.split(sub.text), MARKS.findall(sub.text)):
            if known:
                yield known
            if marks:
                yield {"s": "unknown", "w": [[name_of(marks)]], "n": "", "p": sub.preflight_place}

    def _part(self, sub: Any) -> Any:
        if type(sub) is TextSubstitution:
            place = _written(sub.text)
            return sub.text if place is None else {"x": sub.text, "p": place}
        own = overrides(sub, "perform") or (isinstance(sub, FindPackage) and overrides(sub, "find"))
        if isinstance(sub, Worded) and not own:
            words = [[part for each in word for part in self._pieces(each)] for word in sub.words]
            return {
                "s": sub.preflight_kind or sub.preflight_call.kind,
                "w": words,
                "n": type(sub).__name__,
                "p": sub.preflight_place,
            }
        return _own(sub)


def _own(thing: Any) -> dict[str, Any]:
    """A substitution or condition that the user's code performs."""
    name = type(thing).__name__
    return {"s": "own", "w": [[str(thing.preflight_id)], [name]], "n": name, "p": thing.preflight_place}


def _of_plain(value: Any) -> dict[str, Any]:
    place = _written(value)
    return {"v": value} if place is None else {"v": value, "p": place}


def _written(text: Any) -> Optional[list[int]]:
    """Where a text is written."""
    found = RECORDER.written.get(id(text))
    return None if found is None else found[1]


def _plain(value: Any) -> bool:
    return isinstance(value, (bool, int, float, str))
