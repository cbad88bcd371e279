"""The parameter server's tree: a namespace is a dictionary of what is below it (rosmaster's ParamDictionary)."""

from __future__ import annotations

from typing import Any, Iterator


def _steps(name: str) -> list[str]:
    return [step for step in name.split("/") if step]


class ParamTree:
    """Parameters by full name. `get` of a namespace gives all below it."""

    def __init__(self) -> None:
        self._root: dict[str, Any] = {}

    def set(self, name: str, value: Any) -> None:
        """Set, replacing what was below `name`; a value in the way becomes a namespace. `/` takes dictionaries only."""
        steps = _steps(name)
        if not steps:
            if not isinstance(value, dict):
                raise TypeError("cannot set root of parameter tree to non-dictionary")
            self._root = value
            return
        at = self._root
        for step in steps[:-1]:
            below = at.get(step)
            if not isinstance(below, dict):
                below = at[step] = {}
            at = below
        at[steps[-1]] = value

    def get(self, name: str) -> Any:
        """The value or dictionary at `name`. Raises `KeyError`."""
        at: Any = self._root
        for step in _steps(name):
            if not isinstance(at, dict):
                raise KeyError(name)
            at = at[step]
        return at

    def has(self, name: str) -> bool:
        """Whether a value or namespace is there."""
        try:
            self.get(name)
        except KeyError:
            return False
        return True

    def delete(self, name: str) -> None:
        """Remove it. Raises `KeyError`, for the root too."""
        steps = _steps(name)
        if not steps:
            raise KeyError(name)
        above = self.get("/".join(steps[:-1]))
        if not isinstance(above, dict):
            raise KeyError(name)
        del above[steps[-1]]

    def names(self) -> list[str]:
        """Full names of all values; an empty namespace counts as one."""

        def below(prefix: str, at: dict[str, Any]) -> Iterator[str]:
            for key, value in at.items():
                name = f"{prefix}/{key}"
                if isinstance(value, dict) and value:
                    yield from below(name, value)
                else:
                    yield name

        return list(below("", self._root))

    def search(self, caller: str, key: str) -> str:
        """The nearest `key` from `caller`'s own namespace upwards, "" if there is none.

        Only the first step of `key` has to exist, as in rosmaster: the rest may not be set yet.
        """
        if key.startswith("/"):
            return key if self.has(key) else ""
        steps = _steps(key)
        if not steps:
            return ""
        levels = _steps(caller)
        for depth in range(len(levels), -1, -1):
            space = "".join("/" + level for level in levels[:depth])
            if self.has(f"{space}/{steps[0]}"):
                return f"{space}/{key}"
        return ""
