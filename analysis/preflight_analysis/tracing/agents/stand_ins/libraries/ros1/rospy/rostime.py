"""Time, which is the clock's or simulated (http://wiki.ros.org/Clock)."""

from __future__ import annotations

import threading
import time
from typing import Any

import genpy  # type: ignore[import-not-found]


class Duration(genpy.Duration):  # type: ignore[misc]
    """A length of time."""

    __slots__: Any = []


class Time(genpy.Time):  # type: ignore[misc]
    """A point in time."""

    __slots__: Any = []

    @staticmethod
    def now() -> Any:
        return get_rostime()

    @classmethod
    def from_seconds(cls, float_secs: float) -> Any:
        return cls.from_sec(float_secs)

    def _difference(self, nanoseconds: int) -> Any:
        return Duration(0, nanoseconds)


_condition = threading.Condition()
_wallclock = True
_rostime = Time(0, 0)
_initialized = False


def _set_rostime(now: Any) -> None:
    global _rostime  # noqa: PLW0603
    with _condition:
        _rostime = Time(now.secs, now.nsecs)
        _condition.notify_all()


def simulate() -> None:
    """Time begins when somebody publishes it."""
    global _wallclock  # noqa: PLW0603
    _wallclock = False


def switch_to_wallclock() -> None:
    global _wallclock  # noqa: PLW0603
    _wallclock = True


def is_wallclock() -> bool:
    return _wallclock


def get_rostime() -> Any:
    return Time.from_sec(time.time()) if _wallclock else _rostime


def get_time() -> float:
    return float(Time.now().to_sec())


def get_rostime_cond() -> threading.Condition:
    return _condition


def set_rostime_initialized(value: bool) -> None:
    global _initialized  # noqa: PLW0603
    _initialized = value


def is_rostime_initialized() -> bool:
    return _initialized


def wallsleep(duration: Any) -> None:
    seconds = duration.to_sec() if hasattr(duration, "to_sec") else float(duration)
    if seconds > 0:
        time.sleep(seconds)
