"""The parameter server of a launch as a source analysis asks it."""

from __future__ import annotations

from bisect import bisect_left, insort
from collections.abc import Callable, Iterable, Mapping, Set
from functools import cached_property
from itertools import count
from typing import Any

from preflight_analysis.source.python_values import UNKNOWN, Later, is_plain

_MAX_BELOW = 200
_NUMBERS = count()


class LaunchParams:
    """What the launch sets, by full name. Other nodes may set more."""

    def __init__(self, values: Mapping[str, Any], follows: int = -1, differing: frozenset[str] = frozenset()) -> None:
        self.values = values
        self.number = next(_NUMBERS)
        """Differs from that of all others of this process."""
        self._follows = follows
        self._differing = differing

    def changed(self, gone: Iterable[str], come: Mapping[str, Any]) -> LaunchParams:
        """Those without the names that are gone, and with those that come."""
        gone = set(gone)
        values = dict(self.values)
        for name in gone:
            values.pop(name, None)
        values.update(come)
        differing = {
            "/".join(parts[:end]) + slash
            for name in gone | come.keys()
            if (parts := name.split("/"))
            for end in range(len(parts) + 1)
            for slash in ("", "/")
        }
        new = LaunchParams(values, self.number, frozenset(differing))
        if "_sorted" in self.__dict__:
            new._sorted = self._sorted_with(self.values.keys() & gone - values.keys(), come.keys() - self.values.keys())
        return new

    def _sorted_with(self, gone: Set[str], come: Set[str]) -> list[str]:
        if not gone and not come:
            return self._sorted
        found = self._sorted.copy()
        for name in gone:
            del found[bisect_left(found, name)]
        for name in come:
            insort(found, name)
        return found

    def alike(self, number: int, asked: Iterable[str]) -> bool:
        """Whether it is known that the parameters of that number have the same for all these names."""
        if number == self.number:
            return True
        return number == self._follows and self._differing.isdisjoint(asked)

    @cached_property
    def _sorted(self) -> list[str]:
        return sorted(self.values)

    def look(self, name: str) -> Any:
        """The value of a parameter, for a namespace that of all in it; UNKNOWN if it is not set or not known."""
        if name in self.values:
            value = self.values[name]
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
            inner[leaf] = self.values[full] if is_plain(self.values[full]) else UNKNOWN
        return below or UNKNOWN


class KnownParams:
    """What a node may know of the parameter server: `ask` is asked as `LaunchParams.look`; `own` are those that the
    node's arguments set, by full name."""

    def __init__(self, ask: Callable[[str], Any], own: Mapping[str, Any]) -> None:
        self._ask = ask
        self._own = own

    def look(self, name: str) -> Any:
        """As `LaunchParams.look`, but for what the node sets itself as it starts."""
        if name in self._own:
            return self._own[name]
        found = self._ask(f"{name.rstrip('/')}/" if name.endswith("//") else name)
        # A program changes what it was given; what the launch sets stays what it is.
        return _copied(found)

    def later(self, name: str, default: Any) -> Any:
        """The same with a default where that is UNKNOWN. It is asked for where something depends on it."""

        def ask() -> Any:
            found = self.look(name)
            return default if found is UNKNOWN else found

        return Later(ask) if default is UNKNOWN or is_plain(default) else ask()


def _copied(value: Any) -> Any:
    if isinstance(value, list):
        return [*map(_copied, value)]
    return {key: _copied(each) for key, each in value.items()} if isinstance(value, dict) else value
