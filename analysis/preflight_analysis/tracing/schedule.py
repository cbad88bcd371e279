"""Many runs, a few at a time."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Hashable, Sequence
from typing import TYPE_CHECKING, TypeVar

from preflight_analysis.tracing.interface import Interface
from preflight_analysis.tracing.request import TraceRequest

if TYPE_CHECKING:
    from preflight_analysis.tracing.trace import Tracer

_Job = TypeVar("_Job")
_Result = TypeVar("_Result")


def likeness(request: TraceRequest) -> Hashable:
    """The same for nodes that may well turn out to do the same: in other namespaces, with other parameters."""
    plugin = request.component.plugin if request.component is not None else None  # a library may have several
    return request.package, request.executable, plugin, request.args, request.env, request.cwd


def processors() -> int:
    """How many processors this process may use; where the system cannot say that (macOS), how many there are."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def most_at_once() -> int:
    """How many runs keep the processors busy: most of a run's time is waiting, for the middleware or for quiet."""
    return processors() + 2


def trace_all(
    tracer: Tracer,
    requests: Sequence[TraceRequest],
    *,
    workers: int = 2,
    on_begin: Callable[[int], None] = lambda index: None,
    on_done: Callable[[int, Interface], None],
    cancel: threading.Event,
) -> None:
    """Trace `requests` as `run_all` runs jobs. Once `cancel` is set the runs under way are killed and the rest are told
    as not run. Of like nodes one is run first: the others find its trace in the cache,
    unless they do depend on what is different."""
    alike = likeness if tracer.cache is not None else None
    run_all(
        lambda request: tracer.trace(request, cancel),
        requests,
        workers=workers,
        alike=alike,
        on_begin=on_begin,
        on_done=on_done,
    )


def run_all(
    run: Callable[[_Job], _Result],
    jobs: Sequence[_Job],
    *,
    workers: int = 2,
    alike: Callable[[_Job], Hashable] | None = None,
    on_begin: Callable[[int], None] = lambda index: None,
    on_done: Callable[[int, _Result], None],
) -> None:
    """Run `jobs` in their order and return when all are done; equal ones are run once, and the first of those that are
    `alike` before the others.

    `on_begin(index)` is called for a job that starts, `on_done(index, result)` for each job, one call at a time, from
    the worker threads. Raises what `on_done` raised, after the others are done.
    """
    groups: list[list[int]] = []
    for index, job in enumerate(jobs):
        same = next((group for group in groups if jobs[group[0]] == job), None)
        if same is None:
            groups.append([index])
        else:
            same.append(index)
    waiting = _Queue([(group, group[0] if alike is None else alike(jobs[group[0]])) for group in groups])
    telling = threading.Lock()
    failures: list[Exception] = []

    def work() -> None:
        while (taken := waiting.take()) is not None:
            group, kind = taken
            try:
                with telling:
                    on_begin(group[0])
                result = run(jobs[group[0]])
            finally:
                waiting.ended(kind)
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


_Group = tuple[list[int], Hashable]


class _Queue:
    """Groups of jobs with their kinds, in order, but none while the first of its kind is under way."""

    def __init__(self, groups: Sequence[_Group]) -> None:
        self._waiting = list(groups)
        self._begun: set[Hashable] = set()
        self._first: set[Hashable] = set()
        self._changed = threading.Condition()

    def take(self) -> _Group | None:
        """The next one, waiting for it if need be; None if there is none any more."""
        with self._changed:
            while self._waiting:
                at = next((at for at, (_, kind) in enumerate(self._waiting) if kind not in self._first), None)
                if at is not None:
                    group, kind = self._waiting.pop(at)
                    if kind not in self._begun:
                        self._begun.add(kind)
                        self._first.add(kind)
                    return group, kind
                self._changed.wait()
            return None

    def ended(self, kind: Hashable) -> None:
        """One of that kind is done."""
        with self._changed:
            self._first.discard(kind)
            self._changed.notify_all()
