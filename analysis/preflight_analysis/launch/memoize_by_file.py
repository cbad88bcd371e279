"""Memoizes what depends on one launch file alone, by the identity of that file."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import TypeVar

from preflight_analysis.launch.model import LaunchFile

T = TypeVar("T")
_FILES = 4096
"""More than a workspace has; beyond it everything is forgotten."""


def memoize_by_file(function: Callable[[LaunchFile], T]) -> Callable[[LaunchFile], T]:
    """Remember the results of a pure function of a launch file, the last one of each path.

    By identity: a text that did not change is not parsed again, and a Python file is not the same in each run.
    """
    remembered: dict[str, tuple[LaunchFile, T]] = {}

    @wraps(function)
    def call(launch_file: LaunchFile) -> T:
        known = remembered.get(launch_file.path)
        if known is not None and known[0] is launch_file:
            return known[1]
        result = function(launch_file)
        if len(remembered) >= _FILES:
            remembered.clear()
        remembered[launch_file.path] = launch_file, result
        return result

    return call
