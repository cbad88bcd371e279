"""The parameters that a node of rclpy declares."""

from __future__ import annotations

import json
import sys
from typing import Any, Callable

from . import channel
from .rclpy_names import caller, full_name
from .rclpy_nodes import from_overrides
from .weaving import bound_arguments, quiet

_MAX_DEFAULT = 4_000


def _plain(value: Any) -> Any:
    """A default value in JSON's types."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    return repr(value)


def _default(value: Any) -> tuple[Any, bool]:
    """What a parameter is declared with, and whether that is a value: a bare type is none."""
    if value is None or type(value).__name__ == "Type":
        return None, False
    plain = _plain(value)
    return (plain if len(json.dumps(plain)) < _MAX_DEFAULT else None), True


def _described(given: Any, descriptor: Any, *, of_any_type: bool) -> dict[str, Any]:
    """The type that a parameter is declared with, by its default or as such, and what its descriptor allows."""
    if given is None or of_any_type or getattr(descriptor, "dynamic_typing", False) is True:
        return {"dynamic": True, "read_only": bool(getattr(descriptor, "read_only", False))}
    kinds = sys.modules["rclpy.parameter"].Parameter.Type  # of those that rclpy.node imports
    kind = given if isinstance(given, kinds) else kinds.from_parameter_value(given)
    constraints = {
        "type": kind.name.lower().replace("_", " "),
        "read_only": bool(getattr(descriptor, "read_only", False)),
    }
    # rclpy looks at the range of the parameter's own type alone.
    ranges = getattr(
        descriptor, {"integer": "integer_range", "double": "floating_point_range"}.get(constraints["type"], ""), ()
    )
    for each in list(ranges)[:1]:
        constraints["range"] = [each.from_value, each.to_value, each.step]
    return constraints


@quiet
def _report_params(arguments: dict[str, Any]) -> None:
    file, line, internal = caller()
    of_any_type = from_overrides.get(id(arguments.get("self"))) is not None
    namespace = arguments.get("namespace")
    prefix = f"{namespace}." if namespace else ""
    for each in arguments.get("parameters") or ():
        described = each if isinstance(each, (list, tuple)) else (each,)
        given = described[1] if len(described) > 1 else None
        default, has_default = _default(given)
        channel.send(
            "param",
            access="get",
            name=f"~{prefix}{described[0]}",
            default=default,
            has_default=has_default and not internal,
            optional=True,
            **_described(given, described[2] if len(described) > 2 else None, of_any_type=of_any_type),
            node=full_name(arguments["self"]),
            file=None if internal else file,
            line=None if internal else line,
            builtin=internal,
        )


def declares(original: Callable[..., Any]) -> Callable[..., Any]:
    """`declare_parameters`, through which all declarations go."""

    def declared(*args: Any, **kwargs: Any) -> Any:
        # A list that the node may hand over as a generator.
        arguments = bound_arguments(original, args, kwargs)
        if "parameters" in arguments:
            arguments["parameters"] = list(arguments["parameters"])
        _report_params(arguments)
        return original(**arguments)

    return declared
