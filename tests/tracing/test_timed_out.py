"""A node whose time was up: the reason says what it waits for, as far as anything told."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.tracing import run
from preflight_analysis.tracing.node_recipe import make
from preflight_analysis.tracing.observation import observe
from preflight_analysis.tracing.run import RawRun
from support.tracing_harness import environment, own, request, trace, write_node


def reason(tmp_path: Path, waits: Any, told: tuple[dict[str, Any], ...] = (), **more: Any) -> str:
    """The reason of a run that ended while the node was in `waits`."""
    asked = request(write_node(tmp_path, ""), **more)
    end = {"ev": "end", "status": "timed-out", "waits": waits, "initialised": True, "seconds": 5.0}
    raw = RawRun([*({"node": each} for each in told), {"own": end}], b"", started=0.0)
    found = observe(raw, make(environment(tmp_path), asked), asked).interface.outcome
    assert found.status == "timed-out"
    return found.reason or ""


@pytest.mark.parametrize(
    ("kind", "said"),
    [
        ("service", "it waits for the service there,"),
        ("message", "it waits for a message on there,"),
        ("call", "it waits for the answer of the service there,"),
        ("action", "it waits for the action server there,"),
        ("result", "it waits for the result of the action there,"),
        ("transform", "it waits for the transform there,"),
        ("parameter", "it waits for the parameter there,"),
        ("clock", "it waits for simulated time on there,"),
    ],
)
def test_each_kind_of_wait_is_named(tmp_path: Path, kind: str, said: str) -> None:
    assert reason(tmp_path, [[kind, "there"]]).startswith(said)


@pytest.mark.parametrize("waits", [[], None, [["service"]], [[["service"], "x"]], [["spell", "x"]], [["service", 1]]])
def test_what_cannot_be_understood_is_left_out(tmp_path: Path, waits: Any) -> None:
    assert reason(tmp_path, waits) == "it did not reach its event loop within 5 s"


def test_answers_that_did_not_help_are_told(tmp_path: Path) -> None:
    told = ({"ev": "answered", "kind": "action", "name": "/move"}, {"ev": "answered", "kind": "poll", "name": "/scan"})
    assert reason(tmp_path, [["service", "start"]], told) == (
        "it waits for the service start, and did not reach its event loop within 5 s; before that it waits for the "
        "action server /move, and was told that it is there; it waits for messages on /scan, and was given empty ones"
    )


def test_simulated_time_may_be_what_is_missing(tmp_path: Path) -> None:
    assert "it may wait for simulated time" in reason(tmp_path, [], params={"/use_sim_time": True})
    assert "simulated" not in reason(tmp_path, [], params={"/use_sim_time": False})
    told = ({"ev": "answered", "kind": "clock", "name": "/clock"},)
    assert "it may wait" not in reason(tmp_path, [], told, params={"/use_sim_time": True})


@pytest.mark.ros
def test_a_node_that_goes_on_computing_after_an_answer(tmp_path: Path) -> None:
    body = "import rospy\nrospy.init_node('n')\nrospy.wait_for_service('start')\nwhile True: pass\n"
    found = trace(write_node(tmp_path, body)).outcome
    assert found.status == "timed-out"
    assert (found.reason or "").endswith("; before that it waits for the service start, and was told that it is there")


def test_a_node_that_was_busy_all_the_time_is_slow(tmp_path: Path) -> None:
    asked = request(write_node(tmp_path, ""))
    end = {"ev": "end", "status": "timed-out", "waits": [], "initialised": True, "seconds": 5.0, "cpu": 4.5}
    for queued, lasting in ((0.1, True), (3.0, False)):
        raw = RawRun([{"own": {**end, "queued": queued}}], b"", started=0.0)
        observed = observe(raw, make(environment(tmp_path), asked), asked)
        assert observed.interface.outcome.reason == "it is slow: it was still busy after 5 s"
        assert observed.lasting == lasting


@pytest.mark.ros
def test_what_others_do_with_the_processor_is_not_the_nodes_time(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(run, "WALL_SECONDS", 3.0)
    monkeypatch.setattr(run, "STRETCH_SECONDS", 40.0)  # other tests may be on the same processor
    script = write_node(
        tmp_path,
        """
        import time
        import rospy
        from std_msgs.msg import String
        rospy.init_node("n")
        while time.process_time() < 2:
            pass
        rospy.Publisher("late", String, queue_size=1)
        rospy.spin()
        """,
    )
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {min(before)})
    others = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(3)]
    try:
        found = trace(script)
    finally:
        os.sched_setaffinity(0, before)
        for other in others:
            other.kill()
            other.wait()
    assert found.outcome.status == "spinning", found.outcome
    assert own(found) == {("publisher", "late", "std_msgs/String")}
    # It had to wait; for how long is the kernel's business, which shares between groups of processes.
    assert found.outcome.seconds > run.WALL_SECONDS
