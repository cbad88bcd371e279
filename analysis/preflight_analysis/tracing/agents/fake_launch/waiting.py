"""A launch file that sleeps, for a device or a program to be ready, finds that the time has passed at once."""

from __future__ import annotations

import sys
import time
from typing import Any, Callable

from .base import is_own

_SHORTEST = 0.005
"""Seconds that it sleeps after all: what it started gets on."""
_MOST = 300.0
"""Seconds that are skipped in all."""
_NANOSECONDS = 1_000_000_000


class _Clock:
    skipped = 0.0
    """Seconds by which all clocks are ahead."""


def install() -> None:
    """From now on clocks go on by what would be slept."""
    sleep = time.sleep

    def slept(seconds: Any) -> None:
        is_number = isinstance(seconds, (int, float))
        if is_number and _SHORTEST < seconds <= _MOST - _Clock.skipped and is_own(sys._getframe(1)):
            _Clock.skipped += seconds - _SHORTEST
            seconds = _SHORTEST
        sleep(seconds)

    time.sleep = slept
    for name in ("time", "monotonic", "perf_counter"):
        setattr(time, name, _ahead(getattr(time, name)))
        setattr(time, f"{name}_ns", _ahead_ns(getattr(time, f"{name}_ns")))


def _ahead(clock: Callable[[], float]) -> Callable[[], float]:
    return lambda: clock() + _Clock.skipped


def _ahead_ns(clock: Callable[[], int]) -> Callable[[], int]:
    return lambda: clock() + int(_Clock.skipped * _NANOSECONDS)
