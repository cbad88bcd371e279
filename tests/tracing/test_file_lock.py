"""What another process is just running is not run a second time."""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
import time
from pathlib import Path

import pytest
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.file_lock import file_lock
from preflight_analysis.tracing.trace import Tracer
from support.tracing_harness import environment, request, write_node
from support.waiting import until

pytestmark = pytest.mark.ros

GENEROUS = 60.0


def test_one_after_the_other(tmp_path: Path) -> None:
    path, inside, most = tmp_path / "locks" / "a.lock", [], []

    def work() -> None:
        with file_lock(path, threading.Event(), GENEROUS):
            inside.append(1)
            time.sleep(0.02)  # time for others to come in if they could
            most.append(len(inside))
            inside.pop()

    threads = [threading.Thread(target=work) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert most == [1] * 8
    assert list(path.parent.iterdir()) == []


def test_nobody_waits_for_ever(tmp_path: Path) -> None:
    path, cancel = tmp_path / "a.lock", threading.Event()
    cancel.set()
    entered = []
    with file_lock(path, threading.Event(), GENEROUS):
        with file_lock(path, cancel, GENEROUS):
            entered.append("cancelled")
        with file_lock(path, threading.Event(), 0):
            entered.append("late")
        assert path.exists(), "those who did not have it leave it alone"
    assert entered == ["cancelled", "late"]


def _hold(path: str) -> None:
    with file_lock(Path(path), threading.Event(), GENEROUS):
        Path(path).with_name("held").touch()
        threading.Event().wait(GENEROUS)


def test_a_process_that_died_in_its_turn_keeps_nobody(tmp_path: Path) -> None:
    path = tmp_path / "a.lock"
    process = multiprocessing.get_context("spawn").Process(target=_hold, args=(str(path),))
    process.start()
    until((tmp_path / "held").exists)
    assert process.pid is not None
    os.kill(process.pid, signal.SIGKILL)
    process.join(GENEROUS)
    assert path.exists()
    with file_lock(path, threading.Event(), GENEROUS):
        pass
    assert not path.exists(), "it was had, and not only waited for"


def test_where_nothing_can_be_written_there_are_no_turns(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    entered = []
    with file_lock(tmp_path / "file" / "a.lock", threading.Event(), GENEROUS):
        entered.append(1)
    assert entered == [1]
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_two_tracers_of_one_cache_run_a_node_once(tmp_path: Path) -> None:
    body = "import rospy, time\nrospy.init_node('n')\ntime.sleep(0.5)\nrospy.spin()"
    script = write_node(tmp_path, body)
    cache = tmp_path / "cache"
    found = []

    def trace() -> None:
        tracer = Tracer(environment(tmp_path), TraceCache(cache))
        found.append(tracer.trace(request(script), threading.Event()))

    threads = [threading.Thread(target=trace) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(GENEROUS)
    assert [interface.outcome.status for interface in found] == ["spinning"] * 3
    assert sorted(interface.cached for interface in found) == [False, True, True]
