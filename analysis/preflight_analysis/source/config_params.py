"""The parameters of a dynamic_reconfigure server, as the `.cfg` file of its package lists them.

Such a file is a Python program that generates code; it is read, not run: calls of `add` with a
name that is written out.
"""

from __future__ import annotations

import ast
import os
from collections.abc import Callable, Sequence
from typing import Any

from preflight_analysis.dataclass import dataclass
from preflight_analysis.source.python_text import parse

_MAX_PARAMS = 300


@dataclass(frozen=True, slots=True)
class ConfigParam:
    """One parameter: its default (None if that is not written out), and where it is declared."""

    name: str
    default: Any
    file: str
    line: int


Config = Callable[[str, str], Sequence[ConfigParam]]
"""The parameters of `<name>Config` of a package: package, name."""


def config_params(share: str, name: str, text: Callable[[str], str | None]) -> tuple[ConfigParam, ...]:
    """The parameters of the class `<name>Config` that is generated from a file of the package in the folder `share`."""
    path = os.path.join(share, "cfg", f"{name}.cfg")
    content = text(path)
    tree = parse(content) if content is not None else None
    found: list[ConfigParam] = []
    for node in ast.walk(tree) if tree is not None else ():
        if not (isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "add"):
            continue
        given = {keyword.arg: keyword.value for keyword in node.keywords}
        first = node.args[0] if node.args else given.get("name")
        default = node.args[4] if len(node.args) > 4 else given.get("default")
        if isinstance(first, ast.Constant) and isinstance(first.value, str) and len(found) < _MAX_PARAMS:
            found.append(ConfigParam(first.value, _literal(default), path, node.lineno))
    return tuple(sorted(found, key=lambda param: param.line))


def _literal(node: ast.expr | None) -> Any:
    try:
        value = ast.literal_eval(node) if node is not None else None
    except (ValueError, TypeError, SyntaxError, MemoryError, RecursionError):
        return None
    return value if isinstance(value, (str, int, float, bool)) else None
