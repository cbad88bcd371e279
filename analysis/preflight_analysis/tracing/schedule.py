"""Many runs, a few at a time."""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable, Sequence
from typing import TypeVar

from preflight_analysis.tracing.interface import Interface
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.trace import Tracer

_Job = TypeVar("_Job")
_Result = TypeVar("_Result")


def trace_all(
    tracer: Tracer,
    requests: Sequence[TraceRequest],
    *,
    workers: int = 2,
    on_done: Callable[[int, Interface], None],
    cancel: threading.Event,
) -> None:
    """Trace `requests` as `run_all` runs jobs."""
    run_all(tracer.trace, requests, workers=workers, on_done=on_done, cancel=cancel)


def run_all(
    run: Callable[[_Job, threading.Event], _Result],
    jobs: Sequence[_Job],
    *,
    workers: int = 2,
    on_done: Callable[[int, _Result], None],
    cancel: threading.Event,
) -> None:
    """Run `jobs` in their order and return when all are done; equal ones are run once.

    `on_done(index, result)` is called for each job, one call at a time, from the worker threads. Once `cancel` is set
    the runs under way are killed and the rest are told as not run. Raises what `on_done` raised, after the others are
    done.
    """
    groups: list[list[int]] = []
    for index, job in enumerate(jobs):
        same = next((group for group in groups if jobs[group[0]] == job), None)
        if same is None:
            groups.append([index])
        else:
            same.append(index)
    waiting: queue.SimpleQueue[list[int]] = queue.SimpleQueue()
    for group in groups:
        waiting.put(group)
    telling = threading.Lock()
    failures: list[Exception] = []

    def work() -> None:
        while True:
            try:
                group = waiting.get_nowait()
            except queue.Empty:
                return
            result = run(jobs[group[0]], cancel)
            with telling:
                for index in group:
                    try:
                        on_done(index, result)
                    except Exception as error:
                        failures.append(error)

    # A run dies with the thread that started it (PR_SET_PDEATHSIG), so the threads last as long as their runs.
    threads = [threading.Thread(target=work, name=f"trace-{n}") for n in range(min(workers, len(groups)))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    if failures:
        raise failures[0]
