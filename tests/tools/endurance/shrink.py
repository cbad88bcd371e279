"""Shorter sequences of steps that still fail: whole blocks are left out, smaller and smaller ones."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import TypeVar

T = TypeVar("T")


def shrunk(steps: Sequence[T], fails: Callable[[Sequence[T]], bool], seconds: float) -> list[T]:
    """A part of `steps` that fails too, as short as it was found within the time. `steps` fail."""
    deadline = time.monotonic() + seconds
    found = list(steps)
    size = max(len(found) // 2, 1)
    while time.monotonic() < deadline:
        start = 0
        smaller = False
        while start < len(found) and time.monotonic() < deadline:
            tried = found[:start] + found[start + size :]
            if tried and fails(tried):
                found, smaller = tried, True
            else:
                start += size
        if size == 1 and not smaller:
            break
        size = max(size // 2, 1)
    return found
