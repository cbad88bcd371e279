"""From the text of an attribute to a value, with roslaunch's own idea of each type.

The rules are those of `<param type>` in the roslaunch XML specification, in the detail that roslaunch 1.15 gives
them; the differential tests have the surprising cases (`1_000` and `1e3` are strings).
"""

from __future__ import annotations

from preflight_analysis.evaluation.yaml_params import YamlError, load_yaml
from preflight_analysis.launch.schema_ros1 import TAGS

TYPES = TAGS["param"].attributes["type"].choices


class BadValueError(ValueError):
    """The text is not of the type; the message says what was expected."""


def to_bool(text: str) -> bool:
    """`if`, `unless` and `type="bool"`: true, false, 1 or 0, in any case, blanks around allowed."""
    word = text.lower().strip()
    if word in ("true", "1"):
        return True
    if word in ("false", "0"):
        return False
    raise BadValueError("true, false, 1 or 0")


def to_flag(text: str) -> bool:
    """Attributes such as `respawn`: only `true` or `false`, in any case."""
    word = text.lower()
    if word not in ("true", "false"):
        raise BadValueError("true or false")
    return word == "true"


def convert(text: str, type_name: str) -> object:
    """The value of a `<param>`. Raises `BadValueError`."""
    kind = type_name.lower()
    try:
        if kind == "auto":
            return _auto(text)
        if kind in ("str", "string"):
            return text
        if kind == "int":
            return int(text)
        if kind == "double":
            return float(text)
        if kind in ("bool", "boolean"):
            return to_bool(text)
    except BadValueError:
        raise
    except ValueError as error:
        raise BadValueError({"int": "an integer", "double": "a number"}[kind]) from error
    if kind == "yaml":
        try:
            return load_yaml(text).value
        except YamlError as error:
            raise BadValueError(f"YAML ({error.message})") from error
    raise BadValueError("one of the types " + ", ".join(TYPES))


def _auto(text: str) -> object:
    try:
        if "." in text:
            return float(text)
        if "_" not in text:
            return int(text)
    except ValueError:
        pass
    return text.lower() == "true" if text.lower() in ("true", "false") else text
