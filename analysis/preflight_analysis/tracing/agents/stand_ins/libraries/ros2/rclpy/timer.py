"""Timers, which call nobody."""

from __future__ import annotations

import time
from typing import Any

from .exceptions import ROSInterruptException


class TimerInfo:
    """When a timer was due."""


class Timer:
    """A period and a callback."""

    def __init__(self, callback: Any, period_ns: int, clock: Any) -> None:
        self.callback, self.timer_period_ns, self.clock = callback, period_ns, clock
        self._cancelled = False

    def is_ready(self) -> bool:
        return False

    def is_canceled(self) -> bool:
        return self._cancelled

    def cancel(self) -> None:
        self._cancelled = True

    def reset(self) -> None:
        self._cancelled = False

    def time_since_last_call(self) -> int:
        return 0

    def time_until_next_call(self) -> Any:
        return self.timer_period_ns

    def destroy(self) -> None:
        self._cancelled = True


class Rate:
    """Sleeps for a period; the real one needs an executor in another thread."""

    def __init__(self, period_ns: int, context: Any) -> None:
        self._seconds, self._context = period_ns / 1e9, context

    def sleep(self) -> None:
        if not self._context.ok():
            raise ROSInterruptException()
        time.sleep(self._seconds)

    def destroy(self) -> None:
        pass
