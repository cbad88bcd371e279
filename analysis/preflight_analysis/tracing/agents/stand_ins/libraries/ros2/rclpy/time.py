"""Points in time, in nanoseconds."""

from __future__ import annotations

import functools
import importlib
from typing import Any

from .duration import Duration


@functools.total_ordering
class Time:
    """A point in time."""

    def __init__(self, *, seconds: Any = 0, nanoseconds: Any = 0, clock_type: Any = 2) -> None:
        self.nanoseconds = int(float(seconds) * 1_000_000_000) + int(nanoseconds)
        if self.nanoseconds < 0:
            raise ValueError("Seconds value must not be negative")
        self.clock_type = clock_type

    def seconds_nanoseconds(self) -> tuple[int, int]:
        return divmod(self.nanoseconds, 1_000_000_000)

    def __repr__(self) -> str:
        return f"Time(nanoseconds={self.nanoseconds})"

    def __add__(self, other: Any) -> Any:
        return Time(nanoseconds=self.nanoseconds + other.nanoseconds, clock_type=self.clock_type)

    __radd__ = __add__

    def __sub__(self, other: Any) -> Any:
        if isinstance(other, Time):
            return Duration(nanoseconds=self.nanoseconds - other.nanoseconds)
        return Time(nanoseconds=self.nanoseconds - other.nanoseconds, clock_type=self.clock_type)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Time) and self.nanoseconds == other.nanoseconds

    def __lt__(self, other: Any) -> bool:
        return bool(self.nanoseconds < other.nanoseconds)

    __hash__ = None  # type: ignore[assignment]

    def to_msg(self) -> Any:
        seconds, nanoseconds = self.seconds_nanoseconds()
        return importlib.import_module("builtin_interfaces.msg").Time(sec=seconds, nanosec=nanoseconds)

    @classmethod
    def from_msg(cls, msg: Any, clock_type: Any = 1) -> Any:
        return cls(seconds=msg.sec, nanoseconds=msg.nanosec, clock_type=clock_type)
