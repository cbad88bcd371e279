"""A running system once it is settled: nodes take a moment to start, and discovery takes one too."""

from __future__ import annotations

import time
from collections.abc import Callable

from preflight_analysis.live.model import CannotObserveError, Observation
from preflight_analysis.live.watcher import LOOK_SECONDS, Observer

_POLL_SECONDS = 0.25


def settled(
    watched: Observer,
    *,
    timeout: float,
    settle: float,
    enough: Callable[[Observation], bool] = lambda _: True,
) -> Observation:
    """The system once it has `enough` and did not change for `settle` seconds, else as it is after `timeout` seconds.
    Raises `CannotObserveError` where it does not answer by then."""
    began = since = time.monotonic()
    last: Observation | None = None
    while True:
        try:
            seen = watched.observe(max(began + timeout - time.monotonic(), LOOK_SECONDS))
        except CannotObserveError as error:
            if error.final or time.monotonic() - began >= timeout:
                raise
            last = None
        else:
            now = time.monotonic()
            if seen != last:
                last, since = seen, now
            if now - began >= timeout or (now - since >= settle and enough(seen)):
                return seen
        time.sleep(_POLL_SECONDS)
