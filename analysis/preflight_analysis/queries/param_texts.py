"""Values of parameters as Markdown."""

from __future__ import annotations

from preflight_analysis.evaluation.tree import CommandValue, ParamValue
from preflight_analysis.findings.markdown import code, escaped
from preflight_analysis.tracing.interface import ParamUse

_LENGTH = 200


def value_text(value: ParamValue) -> str:
    """The value of a parameter or an argument on one line; a text without a character as `''`, to be seen."""
    if isinstance(value, CommandValue):
        return f"output of {code(value.command)}" + (f" ({escaped(value.reason)})" if value.reason else "")
    if isinstance(value, bytes):
        return f"{len(value)} bytes"
    if value is None:
        return "unresolved"
    text = " ".join(str(value).split()) or "''"
    return code(f"{text[:_LENGTH]}…" if len(text) > _LENGTH else text)


def type_text(value: ParamValue) -> str:
    """The type of a value, as ROS 2 calls it."""
    if isinstance(value, (list, tuple)):
        kinds = {type_text(each) for each in value}
        return f"{kinds.pop()} array" if len(kinds) == 1 else "array"
    return {bool: "bool", int: "integer", float: "double", str: "string"}.get(type(value), "")


def default_text(use: ParamUse) -> str:
    """How a node declares a parameter: `double, default 10.0, 0.1 to 20.0, read-only`."""
    parts = [use.type or (type_text(use.default) if use.has_default and not use.dynamic else "")]
    if use.dynamic:
        parts.append("any type")
    if use.has_default:
        parts.append(f"default {value_text(use.default)}")
    elif use.mandatory:
        parts.append("no default")
    if use.range is not None:
        parts.append(str(use.range))
    if use.read_only:
        parts.append("read-only")
    return ", ".join(part for part in parts if part)
