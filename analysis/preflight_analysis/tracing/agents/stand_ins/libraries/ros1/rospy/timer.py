"""Sleeping, and calls at a rate (http://wiki.ros.org/rospy/Overview/Time)."""

from __future__ import annotations

import threading
import time
from typing import Any

from . import core, rostime
from .exceptions import ROSInterruptException


class Rate:
    """Sleeps so that a loop turns so often in a second."""

    def __init__(self, hz: Any, reset: bool = False) -> None:
        self.last_time = rostime.get_rostime()
        self.sleep_dur = rostime.Duration(0, int(1e9 / hz))

    def remaining(self) -> Any:
        """How long the next sleep is."""
        return self._remaining(rostime.get_rostime())

    def _remaining(self, now: Any) -> Any:
        self.last_time = min(self.last_time, now)
        return self.sleep_dur - (now - self.last_time)

    def sleep(self) -> None:
        now = rostime.get_rostime()
        sleep(self._remaining(now))
        self.last_time = self.last_time + self.sleep_dur
        if now - self.last_time > self.sleep_dur * 2:
            self.last_time = now


def sleep(duration: Any) -> None:
    """Sleep in ROS time. Raises `ROSInterruptException` when the node is shut down meanwhile."""
    if rostime.is_wallclock():
        rostime.wallsleep(duration)
        return
    condition = rostime.get_rostime_cond()
    length = duration if hasattr(duration, "to_sec") else rostime.Duration.from_sec(duration)
    while rostime.get_rostime().is_zero() and not core.is_shutdown():
        with condition:
            condition.wait(0.3)
    end = rostime.get_rostime() + length
    while rostime.get_rostime() < end and not core.is_shutdown():
        with condition:
            condition.wait(0.5)
    if core.is_shutdown():
        raise ROSInterruptException("ROS shutdown request")


class TimerEvent:
    """What a timer's callback is given."""

    def __init__(
        self, last_expected: Any, last_real: Any, current_expected: Any, current_real: Any, last_duration: Any
    ) -> None:
        self.last_expected, self.last_real = last_expected, last_real
        self.current_expected, self.current_real = current_expected, current_real
        self.last_duration = last_duration


class Timer(threading.Thread):
    """Calls something at a rate."""

    def __init__(self, period: Any, callback: Any, oneshot: bool = False, reset: bool = False) -> None:
        super().__init__()
        self._period, self._callback, self._oneshot = period, callback, oneshot
        self._shutdown = False
        self.daemon = True
        self.start()

    def shutdown(self) -> None:
        """No more calls."""
        self._shutdown = True

    def run(self) -> None:
        rate = Rate(1.0 / self._period.to_sec())
        expected = rostime.get_rostime() + self._period
        last: tuple[Any, Any, Any] = (None, None, None)
        while not core.is_shutdown() and not self._shutdown:
            try:
                rate.sleep()
            except ROSInterruptException:
                break
            if self._shutdown:
                break
            now, start = rostime.get_rostime(), time.time()
            self._callback(TimerEvent(last[0], last[1], expected, now, last[2]))
            if self._oneshot:
                break
            last = (expected, now, time.time() - start)
            expected = expected + self._period
