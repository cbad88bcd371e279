"""What a rule finds out of a launch file alone is found out once for each text, not on every key."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache, wraps
from typing import TypeVar

from preflight_analysis.launch.model import LaunchFile

T = TypeVar("T")
_FILES = 2048
"""More than a launch includes; what it has beyond that is computed again."""


class _ByText:
    """A launch file that equals another one of the same path and text: comparing its actions would take too long."""

    __slots__ = ("launch_file",)

    def __init__(self, launch_file: LaunchFile) -> None:
        self.launch_file = launch_file

    def __hash__(self) -> int:
        return hash((self.launch_file.path, self.launch_file.document.digest))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, _ByText):
            return NotImplemented
        mine, theirs = self.launch_file, other.launch_file
        return mine.path == theirs.path and mine.document.digest == theirs.document.digest


def per_file(function: Callable[[LaunchFile], T]) -> Callable[[LaunchFile], T]:
    """Remember the results of a pure function of a launch file."""

    @lru_cache(maxsize=_FILES)
    def remembered(key: _ByText) -> T:
        return function(key.launch_file)

    @wraps(function)
    def call(launch_file: LaunchFile) -> T:
        return remembered(_ByText(launch_file))

    return call
