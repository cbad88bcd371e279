"""Each parser with inputs that nobody would write, in short; `make fuzz` does it for as long as one likes."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from preflight_analysis.documents.span import Span
from tools import fuzz

from fuzzing import targets
from fuzzing.targets import TARGETS, Target, TooLong, Wrong, bounded

SHORT = settings(
    max_examples=30, derandomize=True, database=None, deadline=None, suppress_health_check=list(HealthCheck)
)


@pytest.mark.slow
@pytest.mark.parametrize("target", TARGETS, ids=lambda target: target.name)
def test_whatever_it_is_given_the_promises_are_kept(target: Target) -> None:
    seeds = target.seeds()
    assert seeds
    for seed in seeds[:: max(1, len(seeds) // 6)]:
        bounded(target.run, seed)

    @SHORT
    @given(targets.inputs(target))
    def some(data: bytes) -> None:
        bounded(target.run, data)

    some()


NASTY: tuple[Any, ...] = (math.nan, -math.inf, -1, 2**70, 2**2000, 0.5, "", "x", "\ud800", None, True, [], {}, [[]])
OF_JSON = ("baseline", "cache-entries", "kept-index", "launch-answers", "ros2-graph", "trace-events")


def _spoilt(value: Any) -> Iterator[Any]:
    """The value with one of its parts, or all of it, of another kind or lacking."""
    yield from NASTY
    if isinstance(value, dict):
        for key, part in value.items():
            yield {other: kept for other, kept in value.items() if other != key}
            yield from ({**value, key: spoilt} for spoilt in _spoilt(part))
    elif isinstance(value, list):
        for at, part in enumerate(value):
            yield from ([*value[:at], spoilt, *value[at + 1 :]] for spoilt in _spoilt(part))


@pytest.mark.slow
@pytest.mark.parametrize("target", [each for each in TARGETS if each.name in OF_JSON], ids=lambda target: target.name)
def test_each_part_of_what_is_read_may_be_of_any_kind(target: Target) -> None:
    whole = [seed for seed in target.seeds() if b"\n" not in seed]
    assert whole
    for seed in whole:
        for spoilt in _spoilt(json.loads(seed)):
            bounded(target.run, json.dumps(spoilt).encode())


def _raises(data: bytes) -> None:
    raise ValueError("x")


def _hangs(data: bytes) -> None:
    while True:
        try:
            sum(range(1000))
        except Exception:
            continue


def _beyond(data: bytes) -> None:
    targets.check_spans([Span(0, 3)], "ab")


def _drives_a_terminal(data: bytes) -> None:
    targets.check_printable("a\x1b[2J")


@pytest.mark.parametrize(
    ("run", "error"), [(_raises, ValueError), (_hangs, TooLong), (_beyond, Wrong), (_drives_a_terminal, Wrong)]
)
def test_a_broken_promise_is_seen(run: Callable[[bytes], None], error: type[BaseException]) -> None:
    with pytest.raises(error):
        bounded(run, b"", seconds=0.2)


def test_what_is_found_is_kept_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(fuzz, "OUT", tmp_path)
    record = fuzz.Record("x", "hypothesis", 1)
    for data in (b"one", b"two"):
        record.run(lambda: _raises(b""), data)
    record.write()
    told: dict[str, Any] = fuzz.read_result("x")
    assert (told["executions"], list(told["found"].values())) == (2, ["ValueError: x"])
    (name,) = told["found"]
    assert (tmp_path / "x" / name).read_bytes() == b"one"
    assert "_raises" in (tmp_path / "x" / f"{name}.txt").read_text()
