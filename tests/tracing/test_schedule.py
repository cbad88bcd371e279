"""Many traces: in order, two at a time, equal ones once, cancelled together."""

from __future__ import annotations

import threading
from pathlib import Path

import pytest
from preflight_analysis.tracing.interface import Interface, Outcome
from preflight_analysis.tracing.request import Component, TraceRequest
from preflight_analysis.tracing.schedule import likeness, run_all, trace_all
from preflight_analysis.tracing.trace import Tracer
from support.tracing_harness import environment, request


class Recorder(Tracer):
    """A tracer that runs nothing. The first traces last until so many are `together`."""

    def __init__(self, together: int = 1) -> None:
        super().__init__(environment(), None)
        self.together = together
        self.gathered = threading.Event()
        self.order: list[str] = []
        self.running = self.most = 0
        self.lock = threading.Lock()

    def trace(self, request: TraceRequest, cancel: threading.Event) -> Interface:
        with self.lock:
            self.order.append(request.node)
            self.running += 1
            self.most = max(self.most, self.running)
            if self.most >= self.together:
                self.gathered.set()
        assert self.gathered.wait(60), "they were not run together"
        status = "not-run" if cancel.is_set() else "spinning"
        with self.lock:
            self.running -= 1
        return Interface("trace", Outcome("spinning" if status == "spinning" else "not-run"), notes=(request.node,))


def requests(*nodes: str) -> list[TraceRequest]:
    return [request(Path("/x"), node, params={"/p": [1]}) for node in nodes]


def test_in_order_two_at_a_time_and_equal_ones_once() -> None:
    tracer, done = Recorder(together=2), {}
    asked = requests("/a", "/b", "/a", "/c", "/b", "/d")
    trace_all(tracer, asked, on_done=done.__setitem__, cancel=threading.Event())
    assert sorted(tracer.order) == ["/a", "/b", "/c", "/d"]
    assert set(tracer.order[:2]) == {"/a", "/b"}
    assert tracer.most == 2
    assert [done[n].notes for n in range(6)] == [(r.node,) for r in asked]


def test_the_first_of_like_jobs_comes_before_the_others() -> None:
    """Whatever the order in which runs end; the worker that would wait takes something else."""
    under_way: list[str] = []
    order: list[str] = []
    lock, others = threading.Lock(), threading.Event()

    def run(job: str) -> None:
        with lock:
            assert all(job[0] != other[0] or (job[0] + "1") not in (job, other) for other in under_way)
            under_way.append(job)
            order.append(job)
        if job == "a1":
            assert others.wait(60), "the other kinds did not go on"
        if job == "c1":
            others.set()
        with lock:
            under_way.remove(job)

    jobs = ["a1", "a2", "a3", "b1", "b2", "c1", "a4"]
    run_all(run, jobs, alike=lambda job: job[0], on_done=lambda *_: None)
    assert sorted(order[:4]) == ["a1", "b1", "b2", "c1"]
    assert order.index("b1") < order.index("b2")
    assert sorted(order[4:]) == ["a2", "a3", "a4"]


def test_components_of_one_library_do_not_wait_for_each_other() -> None:
    one, same, other = (
        TraceRequest(f"/{name}", "p", "/lib/libp.so", generation=2, component=Component(f"p::{plugin}", "/bin/c"))
        for name, plugin in (("a", "Talker"), ("b", "Talker"), ("c", "Listener"))
    )
    assert likeness(one) == likeness(same) != likeness(other)


def test_cancelling_ends_them_all() -> None:
    cancel, done = threading.Event(), {}
    cancel.set()
    trace_all(Recorder(), requests("/a", "/b", "/c"), on_done=done.__setitem__, cancel=cancel)
    assert [done[n].outcome.status for n in range(3)] == ["not-run"] * 3


def test_a_listener_that_raises_does_not_stop_the_others() -> None:
    told = []

    def tell(index: int, _interface: Interface) -> None:
        told.append(index)
        raise ValueError(index)

    with pytest.raises(ValueError):
        trace_all(Recorder(), requests("/a", "/b", "/c"), on_done=tell, cancel=threading.Event())
    assert sorted(told) == [0, 1, 2]


def test_nothing_to_do() -> None:
    tracer, done = Recorder(), {}
    trace_all(tracer, [], on_done=done.__setitem__, cancel=threading.Event())
    assert (tracer.order, done) == ([], {})
