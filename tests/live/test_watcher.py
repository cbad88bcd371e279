"""When `watch` says that it is attached to a new run of the master."""

from __future__ import annotations

import pytest
from preflight_analysis.live.model import CannotObserveError, Expected, ExpectedNode, LiveNode, Observation
from preflight_analysis.live.watcher import Attached, State, Watcher


class _Master:
    """Answers with the ids of runs, one a look: "" where the master has none (yet), None where it is not there."""

    place = "the master"

    def __init__(self, *runs: str | None) -> None:
        self._runs = iter(runs)

    def observe(self, within: float = 0.0) -> Observation:
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


class _Robot:
    """Has the nodes of the names given, a text a look."""

    place = "the robot"

    def __init__(self, *looks: str) -> None:
        self._looks = iter(looks)

    def observe(self, within: float = 0.0) -> Observation:
        return Observation(1, {f"/{name}": LiveNode(f"/{name}") for name in next(self._looks)}, (), run="x")

    def close(self) -> None:
        """Nothing is held."""


def _missing(*looks: str) -> list[tuple[str, str]]:
    """What is told to be missing at each look, a second apart, with a settle of 2; and which states say so."""
    names = ("a", "b", "c")
    expected = Expected(1, tuple(ExpectedNode(f"/{n}", (), complete=True, place=None) for n in names))
    now = iter(range(len(looks)))
    watcher = Watcher(_Robot(*looks), lambda: expected, settle=2, clock=lambda: float(next(now)))
    told: list[tuple[str, str]] = []
    state = ("", "")
    for _ in looks:
        for event in watcher.look():
            if isinstance(event, State):
                issues = "".join(i.node[1:] for i in event.comparison.issues if i.kind == "missing")
                state = issues, "".join(n[1:] for n, s in event.comparison.nodes.items() if s == "missing")
        told.append(state)
    return told


def test_a_node_that_stays_away_is_missing_after_a_while() -> None:
    assert _missing("ab", "ab", "ab", "abc") == [("", ""), ("", ""), ("c", "c"), ("", "")]


def test_while_nodes_turn_up_none_is_missing() -> None:
    assert _missing("", "", "a", "a", "ab", "ab", "ab") == [("", "")] * 6 + [("c", "c")]


def test_a_node_that_comes_and_goes_keeps_nothing_from_being_missing() -> None:
    assert _missing("ab", "a", "ab", "a", "ab")[2:] == [("c", "c"), ("c", "c"), ("c", "c")]
