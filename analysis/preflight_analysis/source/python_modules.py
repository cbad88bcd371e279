"""What the interpreter of Python asks of modules: their text where it follows them, else what their calls do."""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol

from preflight_analysis.source.branches import Branches


class Calls(Protocol):
    """What calls of modules that are not followed do."""

    def call(self, path: str, args: Sequence[Any], kwargs: Mapping[str, Any], file: str, line: int) -> Any:
        """The value of `path(*args, **kwargs)` at this place, UNKNOWN if that cannot be told."""

    def cut_short(self) -> None:
        """What follows is not gone through: there may be more than was told."""

    def given(self, value: Any) -> None:
        """An object that is not known gets a value, and may use it."""

    def begin(self, branches: Branches) -> None:
        """The program begins; `branches` tells what may well not be done."""

    def value(self, path: str) -> Any:
        """The value of an attribute such as `sys.argv`; `Imported(path)` if nothing else is known."""


Load = Callable[[str, int, str], "tuple[str, ast.Module] | None"]
"""A module by its dotted name, the number of leading dots and the file that imports it: its path and tree."""
