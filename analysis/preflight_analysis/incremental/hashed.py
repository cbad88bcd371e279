"""Keys that are long, and looked up again and again."""

from __future__ import annotations

from collections.abc import Hashable


class Hashed:
    """As its value, whose hash is found once: Python does not keep that of a tuple."""

    __slots__ = ("_hash", "value")

    def __init__(self, value: Hashable) -> None:
        self.value = value
        self._hash = hash(value)

    def __hash__(self) -> int:
        return self._hash

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Hashed):
            return NotImplemented
        return self is other or (self._hash == other._hash and self.value == other.value)
