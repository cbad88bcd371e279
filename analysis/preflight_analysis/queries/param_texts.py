"""Values of parameters as Markdown."""

from __future__ import annotations

from preflight_analysis.evaluation.tree import CommandValue, ParamValue
from preflight_analysis.tracing.interface import ParamUse

_LENGTH = 200


def value_text(value: ParamValue) -> str:
    """The value of a parameter on one line."""
    if isinstance(value, CommandValue):
        return f"what `{value.command}` prints" + (f" ({value.reason})" if value.reason else "")
    if isinstance(value, bytes):
        return f"{len(value)} bytes"
    if value is None:
        return "not known"
    text = " ".join(str(value).split())
    return f"`{text[:_LENGTH]}…`" if len(text) > _LENGTH else f"`{text}`"


def type_text(value: ParamValue) -> str:
    """The type of a value, as ROS 2 calls it."""
    if isinstance(value, (list, tuple)):
        kinds = {type_text(each) for each in value}
        return f"{kinds.pop()} array" if len(kinds) == 1 else "array"
    return {bool: "bool", int: "integer", float: "double", str: "string"}.get(type(value), "")


def default_text(use: ParamUse) -> str:
    """How a node declares a parameter: `double, default 10.0`."""
    if not use.has_default:
        return "no default" if use.mandatory else ""
    kind = type_text(use.default)
    return f"{kind}, default {value_text(use.default)}" if kind else f"default {value_text(use.default)}"
