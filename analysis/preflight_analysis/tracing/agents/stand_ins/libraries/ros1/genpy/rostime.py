"""Times and durations, in whole seconds and nanoseconds (http://wiki.ros.org/rospy/Overview/Time)."""

from __future__ import annotations

import functools
from typing import Any

_BILLION = 1_000_000_000


@functools.total_ordering
class TVal:
    """What both have in common."""

    __slots__ = ["nsecs", "secs"]

    def __init__(self, secs: Any = 0, nsecs: Any = 0) -> None:
        if isinstance(secs, float):
            if nsecs:
                raise ValueError("if secs is a float, nsecs cannot be set")
            nanoseconds = int(secs * _BILLION)
        else:
            nanoseconds = int(secs) * _BILLION + int(nsecs)
        self.secs, self.nsecs = divmod(nanoseconds, _BILLION)

    @classmethod
    def from_sec(cls, float_secs: Any) -> Any:
        return cls(*divmod(int(float(float_secs) * _BILLION), _BILLION))

    def is_zero(self) -> bool:
        return not self

    def set(self, secs: int, nsecs: int) -> None:
        self.secs, self.nsecs = secs, nsecs

    def canon(self) -> None:
        self.secs, self.nsecs = divmod(self.to_nsec(), _BILLION)

    def to_sec(self) -> float:
        return float(self.secs) + self.nsecs / _BILLION

    def to_nsec(self) -> int:
        return int(self.secs) * _BILLION + int(self.nsecs)

    def __bool__(self) -> bool:
        return self.to_nsec() != 0

    def __hash__(self) -> int:
        return hash((type(self).__name__, self.secs, self.nsecs))

    def __str__(self) -> str:
        return str(self.to_nsec())

    def __repr__(self) -> str:
        return f"{type(self).__name__}[{self.to_nsec()}]"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, TVal) and self.to_nsec() == other.to_nsec()

    def __lt__(self, other: Any) -> bool:
        return self.to_nsec() < _nanoseconds(other)

    def _with(self, nanoseconds: int) -> Any:
        return type(self)(0, nanoseconds)


def _nanoseconds(value: Any) -> int:
    return value.to_nsec() if isinstance(value, TVal) else int(float(value) * _BILLION)


class Time(TVal):
    """A point in time."""

    __slots__: Any = []

    def to_time(self) -> float:
        return self.to_sec()

    def __add__(self, other: Any) -> Any:
        return self._with(self.to_nsec() + other.to_nsec()) if isinstance(other, Duration) else NotImplemented

    __radd__ = __add__

    def __sub__(self, other: Any) -> Any:
        if isinstance(other, Time):
            return self._difference(self.to_nsec() - other.to_nsec())
        return self._with(self.to_nsec() - other.to_nsec()) if isinstance(other, Duration) else NotImplemented

    def _difference(self, nanoseconds: int) -> Any:
        return Duration(0, nanoseconds)


class Duration(TVal):
    """A length of time; it may be negative."""

    __slots__: Any = []

    def __neg__(self) -> Any:
        return self._with(-self.to_nsec())

    def __abs__(self) -> Any:
        return self._with(abs(self.to_nsec()))

    def __add__(self, other: Any) -> Any:
        if isinstance(other, Time):
            return other + self
        return self._with(self.to_nsec() + other.to_nsec()) if isinstance(other, Duration) else NotImplemented

    def __sub__(self, other: Any) -> Any:
        return self._with(self.to_nsec() - other.to_nsec()) if isinstance(other, Duration) else NotImplemented

    def __mul__(self, factor: Any) -> Any:
        return self._with(int(self.to_nsec() * factor))

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Any:
        if isinstance(other, Duration):
            return self.to_nsec() / other.to_nsec()
        return self._with(int(self.to_nsec() / other))

    def __floordiv__(self, other: Any) -> Any:
        if isinstance(other, Duration):
            return self.to_nsec() // other.to_nsec()
        return self.from_sec(self.to_sec() // other)

    def __mod__(self, other: Any) -> Any:
        return self._with(self.to_nsec() % _nanoseconds(other))
