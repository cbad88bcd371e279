"""Clocks: that of the system, whatever the kind."""

from __future__ import annotations

import enum
import time as system
from typing import Any

from .duration import Duration
from .time import Time


class ClockType(enum.IntEnum):
    """Kinds of clocks."""

    UNINITIALIZED = 0
    ROS_TIME = 1
    SYSTEM_TIME = 2
    STEADY_TIME = 3


class ClockChange(enum.IntEnum):
    """How a clock jumped."""

    ROS_TIME_NO_CHANGE = 1
    ROS_TIME_ACTIVATED = 2
    ROS_TIME_DEACTIVATED = 3
    SYSTEM_TIME_NO_CHANGE = 4


class TimeJump:
    """A jump of a clock."""

    def __init__(self, clock_change: ClockChange, delta: Duration) -> None:
        self.clock_change, self.delta = clock_change, delta


class JumpHandle:
    """What is called when a clock jumps."""

    def __init__(self, *, clock: Any, threshold: Any, pre_callback: Any, post_callback: Any) -> None:
        """They never do."""

    def unregister(self) -> None:
        """Leave the clock alone."""


class JumpThreshold:
    """Which jumps are told of."""

    def __init__(self, *, min_forward: Any, min_backward: Any, on_clock_change: bool = True) -> None:
        self.min_forward, self.min_backward, self.on_clock_change = min_forward, min_backward, on_clock_change


class Clock:
    """Tells the time."""

    def __init__(self, *, clock_type: Any = ClockType.SYSTEM_TIME) -> None:
        self.clock_type = clock_type
        self.ros_time_is_active = False

    def now(self) -> Any:
        simulated = self.clock_type == ClockType.ROS_TIME and self.ros_time_is_active
        return Time(nanoseconds=0 if simulated else system.time_ns(), clock_type=self.clock_type)

    def create_jump_callback(self, threshold: Any, *, pre_callback: Any = None, post_callback: Any = None) -> Any:
        return JumpHandle(clock=self, threshold=threshold, pre_callback=pre_callback, post_callback=post_callback)

    def sleep_until(self, until: Any, context: Any = None) -> bool:
        return self.sleep_for(until - self.now())

    def sleep_for(self, rel_time: Duration, context: Any = None) -> bool:
        system.sleep(max(0.0, rel_time.nanoseconds / 1e9))
        return True


class ROSClock(Clock):
    """The one that may be simulated."""

    def __init__(self) -> None:
        super().__init__(clock_type=ClockType.ROS_TIME)

    def set_ros_time_override(self, time: Any) -> None:
        pass
