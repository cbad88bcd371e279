"""Waiting for something that another process or thread does."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Awaitable, Callable
from typing import TypeVar

T = TypeVar("T")
PATIENCE = 60.0
"""Seconds. A test that passes never waits that long, however busy the machine is."""


def until(condition: Callable[[], T | None], seconds: float = PATIENCE, why: str = "") -> T:
    """Ask again and again until the answer is something true, and return it. `AssertionError` if it never is."""
    deadline = time.monotonic() + seconds
    while not (found := condition()):
        assert time.monotonic() < deadline, why or f"waited {seconds:g} s; last answer: {found!r}"
        time.sleep(0.02)  # between two questions
    return found


async def answered(ask: Callable[[], Awaitable[T]], is_so: Callable[[T], bool], seconds: float = PATIENCE) -> T:
    """Ask again and again until the answer is as wanted, and return it. `AssertionError` if it never is."""
    deadline = time.monotonic() + seconds
    while not is_so(found := await ask()):
        assert time.monotonic() < deadline, f"waited {seconds:g} s; last answer: {found!r}"
        await asyncio.sleep(0.05)  # between two questions
    return found
