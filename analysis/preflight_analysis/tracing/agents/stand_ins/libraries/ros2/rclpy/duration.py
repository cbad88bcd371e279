"""Lengths of time, in nanoseconds."""

from __future__ import annotations

import functools
import importlib
from typing import Any


@functools.total_ordering
class Duration:
    """A length of time."""

    def __init__(self, *, seconds: Any = 0, nanoseconds: Any = 0) -> None:
        self.nanoseconds = int(float(seconds) * 1_000_000_000) + int(nanoseconds)

    def __repr__(self) -> str:
        return f"Duration(nanoseconds={self.nanoseconds})"

    def __add__(self, other: Any) -> Any:
        return type(self)(nanoseconds=self.nanoseconds + other.nanoseconds)

    def __sub__(self, other: Any) -> Any:
        return type(self)(nanoseconds=self.nanoseconds - other.nanoseconds)

    def __mul__(self, factor: Any) -> Any:
        return type(self)(nanoseconds=int(self.nanoseconds * factor))

    __rmul__ = __mul__

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Duration) and self.nanoseconds == other.nanoseconds

    def __lt__(self, other: Any) -> bool:
        return bool(self.nanoseconds < other.nanoseconds)

    __hash__ = None  # type: ignore[assignment]

    def to_msg(self) -> Any:
        seconds, nanoseconds = divmod(self.nanoseconds, 1_000_000_000)
        return importlib.import_module("builtin_interfaces.msg").Duration(sec=seconds, nanosec=nanoseconds)

    @classmethod
    def from_msg(cls, msg: Any) -> Any:
        return cls(seconds=msg.sec, nanoseconds=msg.nanosec)


class _Infinite(Duration):
    pass


Infinite = _Infinite(nanoseconds=9_223_372_036_854_775_807)
