"""How the time of something grows with the size of what it is given: near to linear, or worse.

Processor time of the thread is measured, several times where it matters, and the least counts: other programs can only
add to it. The count is doubled until a run takes long enough to be measured. What grows as n log n takes not much more
than four times as long for four times the size, what is quadratic takes sixteen times.
"""

from __future__ import annotations

import gc
import time
from collections.abc import Callable, Mapping
from typing import TypeVar

START = 500
"""The first count."""
ENOUGH = 0.2
"""Seconds of a run after which the count is not doubled any more."""
MEASURABLE = 0.08
"""Seconds below which a time says nothing."""
ALLOWED = 9.0
"""How many times as long four times the size may take."""
REPEATS = 3

T = TypeVar("T")


class Clock:
    """Measures the parts of one run: `clock("parsing", lambda: parse(text))` gives what the function gives."""

    def __init__(self) -> None:
        self.stages: dict[str, float] = {}

    def __call__(self, name: str, work: Callable[[], T]) -> T:
        begin = time.thread_time()
        result = work()
        self.stages[name] = self.stages.get(name, 0.0) + time.thread_time() - begin
        return result


def steep(run: Callable[[int, Clock], object], most: int) -> list[str]:
    """The parts of `run(count, clock)` that grow too fast, in words; `most` is the largest count."""
    counts = [START]
    times = [_measured(run, START)]
    while counts[-1] * 2 <= most and (len(counts) < 3 or sum(times[-1].values()) < ENOUGH):
        counts.append(counts[-1] * 2)
        times.append(_measured(run, counts[-1]))
    for _ in range(REPEATS - 1):
        if not _suspects(times):
            return []
        for at in (-3, -1):
            again = _measured(run, counts[at])
            times[at] = {name: min(seconds, again[name]) for name, seconds in times[at].items()}
    return [
        f"{name}: {times[-3][name]:.2f} s for {counts[-3]}, {times[-1][name]:.2f} s for {counts[-1]}"
        for name in _suspects(times)
    ]


def _suspects(times: list[Mapping[str, float]]) -> list[str]:
    if len(times) < 3:
        return []
    before, after = times[-3], times[-1]
    return [
        name
        for name, seconds in after.items()
        if seconds > MEASURABLE and seconds > ALLOWED * max(before[name], MEASURABLE / 10)
    ]


def _measured(run: Callable[[int, Clock], object], count: int) -> Mapping[str, float]:
    clock = Clock()
    gc.collect()
    gc.disable()
    try:
        run(count, clock)
    finally:
        gc.enable()
    return clock.stages
