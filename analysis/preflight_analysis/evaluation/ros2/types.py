"""Types of parameter values, as `launch.utilities.type_utils` coerces texts to them."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Any

from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS, load_plain

ITEMS: Mapping[str, type] = {"list_of_str": str, "list_of_bool": bool, "list_of_float": float, "list_of_int": int}
"""Of what the types of lists are lists."""
_SCALARS: Mapping[str, type] = {"str": str, "bool": bool, "float": float, "int": int}


class NotOfTypeError(ValueError):
    """The text is not of the type; the message says what was expected."""


def coerce(text: str, type_name: str | None, *, or_text: bool = False) -> Any:
    """The value of a text. `type_name` is one of `entity.PARAM_TYPES`, None as `yaml`.

    `or_text`: what cannot be coerced stays a text, since there may be substitutions in it (`can_be_str`). Raises
    `NotOfTypeError`.
    """
    if type_name in (None, "yaml"):
        return _as_yaml(text, or_text)
    assert type_name is not None
    if type_name == "str":
        return text
    if type_name in ("int", "float"):
        try:
            return int(text) if type_name == "int" else float(text)
        except ValueError:
            if or_text:
                return text
            raise NotOfTypeError("an integer" if type_name == "int" else "a number") from None
    if type_name == "bool":
        value = _as_yaml({"1": "true", "0": "false"}.get(text, text), or_text)
        if isinstance(value, bool) or (or_text and isinstance(value, str)):
            return value
        raise NotOfTypeError("true or false")
    item = ITEMS[type_name]
    value = _as_yaml(text, or_text)
    allowed = (str, item) if or_text else (item,)
    if not isinstance(value, list) or not all(isinstance(each, allowed) for each in value):
        raise NotOfTypeError(f"a list of {item.__name__}")
    return value


def _as_yaml(text: str, or_text: bool) -> Any:
    if not text:
        return text
    try:
        value = loaded(text)
    except CONSTRUCTION_ERRORS as error:
        if or_text:
            return text
        raise NotOfTypeError("YAML") from error
    if not is_valid(value, or_text=or_text):
        raise NotOfTypeError("a bool, a number, a text or a list of one of them")
    return value


def loaded(text: str) -> Any:
    """What YAML makes of a value: the same few ones come again on every key, and PyYAML is slow."""
    return _long(text) if len(text) > _MANY_CHARACTERS else _short(text)


_MANY_CHARACTERS = 1_000
_short = lru_cache(maxsize=4096)(load_plain)
_long = lru_cache(maxsize=16)(load_plain)
"""The description of a robot may be a value: thousands of them would fill the memory."""


def is_valid(value: Any, *, or_text: bool = False) -> bool:
    """Whether a parameter can have the value; `or_text`: texts among the items of a list may become anything."""
    if not isinstance(value, list):
        return isinstance(value, (bool, int, float, str))
    kind = next((type(each) for each in value if type(each) is not str), str)
    if kind not in (bool, int, float, str):
        return False
    return all(isinstance(each, (kind, str) if or_text else kind) for each in value)


def is_of_type(value: Any, type_name: str | None, *, or_text: bool = False) -> bool:
    """Whether it is an instance of the type, which is not the same as what can be made into one: 1 is no float
    (`launch.utilities.type_utils.is_instance_of`)."""
    if type_name in (None, "yaml"):
        return is_valid(value, or_text=or_text)
    assert type_name is not None
    kind = ITEMS.get(type_name) or _SCALARS[type_name]
    allowed = (str, kind) if or_text else (kind,)
    if type_name in _SCALARS:
        return isinstance(value, allowed)
    return isinstance(value, list) and all(isinstance(each, allowed) for each in value)


def coerced_items(texts: list[str], type_name: str | None) -> list[Any]:
    """A list that was written with a separator of its own (`coerce_list`)."""
    item = type_name.removeprefix("list_of_") if type_name in ITEMS and type_name is not None else None
    found = [coerce(text, item, or_text=True) for text in texts]
    if not is_valid(found, or_text=True):
        raise NotOfTypeError("a list of one type")
    return found
