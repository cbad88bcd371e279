"""The parameter server of a launch as a source analysis asks it, with a note of what was asked."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Mapping
from functools import cached_property
from typing import Any

from preflight_analysis.source.python_values import UNKNOWN, is_plain

_MAX_BELOW = 200


class LaunchParams:
    """What the launch sets, by full name. Other nodes may set more."""

    def __init__(self, values: Mapping[str, Any]) -> None:
        self._values = values

    @cached_property
    def _sorted(self) -> list[str]:
        return sorted(self._values)

    def look(self, name: str) -> Any:
        """The value of a parameter, for a namespace that of all in it; UNKNOWN if it is not set or not known."""
        if name in self._values:
            value = self._values[name]
            return value if is_plain(value) else UNKNOWN
        prefix = name.rstrip("/") + "/"
        start = bisect_left(self._sorted, prefix)
        below: dict[str, Any] = {}
        for full in self._sorted[start : start + _MAX_BELOW]:
            if not full.startswith(prefix):
                break
            *spaces, leaf = full[len(prefix) :].split("/")
            inner = below
            for space in spaces:
                inner = inner.setdefault(space, {})
            inner[leaf] = self._values[full] if is_plain(self._values[full]) else UNKNOWN
        return below or UNKNOWN


class KnownParams:
    """`LaunchParams` that notes what was asked and what the answer was. `own` are those that the node's arguments set,
    by full name."""

    def __init__(self, params: LaunchParams, own: Mapping[str, Any]) -> None:
        self._params = params
        self._own = own
        self.asked: dict[str, Any] = {}

    def look(self, name: str) -> Any:
        """As `LaunchParams.look`, but for what the node sets itself as it starts."""
        if name in self._own:
            return self._own[name]
        if name not in self.asked:
            self.asked[name] = self._params.look(name)
        return self.asked[name]
