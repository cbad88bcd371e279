"""Memoizes what depends on one launch file alone: it is kept with that file."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import TypeVar

from preflight_analysis.launch.model import LaunchFile

T = TypeVar("T")


def memoize_by_file(function: Callable[[LaunchFile], T]) -> Callable[[LaunchFile], T]:
    """Remember the results of a pure function of a launch file as long as there is that file."""

    @wraps(function)
    def call(launch_file: LaunchFile) -> T:
        return launch_file.once(function)

    return call
