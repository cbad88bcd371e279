"""Threads that ask at once get one and the same."""

from __future__ import annotations

import threading
from concurrent.futures import ThreadPoolExecutor

import pytest
from preflight_analysis.tracing import compiled
from preflight_analysis.tracing.once_per_process import once_per_process

THREADS = 8


def test_of_threads_that_ask_at_once_one_makes_it() -> None:
    asking = threading.Barrier(THREADS)
    made = []

    @once_per_process
    def make(kind: str) -> object:
        made.append(kind)
        waited.wait(0.2)  # so that the others come meanwhile
        return object()

    waited = threading.Event()

    def ask(_: int) -> object:
        asking.wait()
        return make("a")

    with ThreadPoolExecutor(THREADS) as pool:
        assert len(set(pool.map(ask, range(THREADS)))) == 1
    assert made == ["a"]
    assert make("b") is not make("a")
    make.cache_clear()
    make("a")
    assert made == ["a", "b", "a"]


def test_what_fails_is_tried_again() -> None:
    asked = []

    @once_per_process
    def make() -> int:
        asked.append(None)
        if len(asked) == 1:
            raise OSError("the first time")
        return 7

    with pytest.raises(OSError, match="first"):
        make()
    assert make() == make() == 7
    assert len(asked) == 2


def test_our_code_is_compiled_by_one_for_all_threads(monkeypatch: pytest.MonkeyPatch) -> None:
    class Slow(compiled.Copies):
        def __init__(self) -> None:
            threading.Event().wait(0.2)
            super().__init__()

    monkeypatch.setattr(compiled, "Copies", Slow)
    compiled.copies.cache_clear()
    try:
        with ThreadPoolExecutor(2) as pool:
            one, other = pool.map(lambda _: compiled.copies(), range(2))
        assert one is other
    finally:
        compiled.copies.cache_clear()
