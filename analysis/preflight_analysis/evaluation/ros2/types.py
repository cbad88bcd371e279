"""Types of parameter values, as `launch.utilities.type_utils` coerces texts to them."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import yaml


class NotOfTypeError(ValueError):
    """The text is not of the type; the message says what was expected."""


def coerce(text: str, type_name: str | None, *, or_text: bool = False) -> Any:
    """The value of a text. `type_name` is one of `launch.schema_ros2.PARAM_TYPES`, None as `yaml`.

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
    item = {"list_of_str": str, "list_of_bool": bool, "list_of_float": float, "list_of_int": int}[type_name]
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
    except yaml.YAMLError as error:
        if or_text:
            return text
        raise NotOfTypeError("YAML") from error
    if not is_valid(value, or_text=or_text):
        raise NotOfTypeError("a bool, a number, a text or a list of one of them")
    return value


@lru_cache(maxsize=4096)
def loaded(text: str) -> Any:
    """What YAML makes of a value: the same few ones come again on every key, and PyYAML is slow."""
    return yaml.safe_load(text)


def is_valid(value: Any, *, or_text: bool = False) -> bool:
    """Whether a parameter can have the value; `or_text`: texts among the items of a list may become anything."""
    if isinstance(value, list):
        kinds = {type(each) for each in value}
        if or_text:
            kinds.discard(str)
        return len(kinds) <= 1 and all(isinstance(each, (bool, int, float, str)) for each in value)
    return isinstance(value, (bool, int, float, str))
