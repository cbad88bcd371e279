"""The parameters of generate_parameter_library: a YAML file of the package, of which a build makes a C++ struct.

https://github.com/PickNikRobotics/generate_parameter_library: the key at the top is the C++ namespace, what has a
`type` is a parameter, everything else a group of them. A key `__map_...` stands for names that other parameters give.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import isnan
from typing import Any

import yaml

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS, compose
from preflight_analysis.tracing.interface import Range

_MAX_PARAMS = 300
_MAX_DEPTH = 10


@dataclass(frozen=True, slots=True)
class LibraryParam:
    """One parameter by its full name. `type` is as in the file; without a default it has to be set."""

    name: str
    type: str
    default: Any
    has_default: bool
    file: str
    line: int
    read_only: bool = False
    range: Range | None = None


@dataclass(frozen=True, slots=True)
class ParameterLibrary:
    """What one file declares. `complete` is False where there are names that only a run tells."""

    params: tuple[LibraryParam, ...]
    complete: bool


Libraries = Callable[[str, Sequence[str]], "ParameterLibrary | None"]
"""The library of a C++ namespace, which a program may have that includes these headers."""


def read_parameter_library(path: str, text: str) -> tuple[str, ParameterLibrary] | None:
    """The C++ namespace of a file and what it declares; None if it is no such file."""
    try:
        root = compose(text)
    except CONSTRUCTION_ERRORS:
        return None
    if not isinstance(root, yaml.MappingNode) or len(root.value) != 1:
        return None
    key, value = root.value[0]
    found: list[LibraryParam] = []
    complete = _collect(value, (), 0, path, found)
    return str(key.value), ParameterLibrary(tuple(found), complete)


def _collect(node: yaml.Node, names: tuple[str, ...], line: int, path: str, found: list[LibraryParam]) -> bool:
    """Add the parameters of a group whose name stands in a line; whether they are all."""
    if not isinstance(node, yaml.MappingNode) or len(names) > _MAX_DEPTH or len(found) > _MAX_PARAMS:
        return False
    fields = {key.value: (key, value) for key, value in node.value if isinstance(key, yaml.ScalarNode)}
    _, type_ = fields.get("type", (None, None))
    if isinstance(type_, yaml.ScalarNode):
        _, default = fields.get("default_value", (None, None))
        value = _value(default) if default is not None else None
        _, read_only = fields.get("read_only", (None, None))
        _, rules = fields.get("validation", (None, None))
        found.append(
            LibraryParam(
                ".".join(names),
                type_.value,
                value,
                default is not None,
                path,
                line,
                read_only is not None and _value(read_only) is True,
                _range(_value(rules) if rules is not None else None, type_.value),
            )
        )
        return True
    complete = True
    for name, (key, inner) in fields.items():
        here = key.start_mark.line + 1
        known = not name.startswith("__map_") and _collect(inner, (*names, name), here, path, found)
        complete = complete and known
    return complete


def _range(rules: Any, type_: str) -> Range | None:
    """The range that the generated code puts into the descriptor, for which it takes `bounds<>` alone."""
    bounds = rules.get("bounds<>") if isinstance(rules, dict) and type_ in ("int", "double") else None
    if (
        not isinstance(bounds, list)
        or len(bounds) != 2
        or not all(type(each) in (int, float) and not isnan(each) for each in bounds)
    ):
        return None
    return Range(*bounds)


def _value(node: yaml.Node) -> Any:
    try:
        return yaml.SafeLoader("").construct_document(node)
    except CONSTRUCTION_ERRORS:
        return None
