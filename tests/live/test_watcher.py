"""When `watch` says that it is attached to a new run of the master."""

from __future__ import annotations

import pytest
from preflight_analysis.live.model import CannotObserveError, Expected, Observation
from preflight_analysis.live.watcher import Attached, Watcher


class _Master:
    """Answers with the ids of runs, one a look: "" where the master has none (yet), None where it is not there."""

    place = "the master"

    def __init__(self, *runs: str | None) -> None:
        self._runs = iter(runs)

    def observe(self) -> Observation:
        run = next(self._runs)
        if run is None:
            raise CannotObserveError("connection refused")
        return Observation(1, {}, (), run=run or None)

    def close(self) -> None:
        """Nothing is held."""


@pytest.mark.parametrize(
    ("runs", "again"),
    [
        (("", "x", "x"), [False]),
        (("x", None, "y"), [False, True]),
        (("x", "", None, "y"), [False, True]),
        (("x", None, "", "y"), [False, True]),
        (("x", "", "y"), [False, True]),
        (("x", None, "x"), [False, False]),
    ],
)
def test_another_run_of_the_master_is_told_once(runs: tuple[str | None, ...], again: list[bool]) -> None:
    watcher = Watcher(_Master(*runs), lambda: Expected(1, (), complete=True))
    events = [event for _ in runs for event in watcher.look()]
    assert [event.again for event in events if isinstance(event, Attached)] == again
