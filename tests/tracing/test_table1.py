"""Table 1 of the paper, row by row: the traced interfaces of a launch file equal what a real master shows of it."""

from __future__ import annotations

import os
import threading
from pathlib import Path

import pytest
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.trace import Tracer
from support.roslaunch_harness import launched, master_view
from support.tracing_harness import ROS1_FIXTURES, environment

pytestmark = pytest.mark.ros

TUTORIALS = [
    "talker_listener",
    "headers",
    "listener_with_user_data",
    "listener_subscribe_notify",
    "parameters",
    "connection_header",
    "on_shutdown",
    "advanced_publish",
]


@pytest.mark.parametrize("tutorial", TUTORIALS)
def test_traced_interfaces_equal_the_real_masters_view(tutorial: str, tmp_path: Path) -> None:
    real = launched(ROS1_FIXTURES / "tutorials" / "launch" / f"{tutorial}.launch", tmp_path)
    requests = [
        TraceRequest(
            node["name"],
            node["package"],
            node["executable"],
            tuple(node["args"]),
            tuple((source, target) for source, target in node["remaps"]),
            real["params"],
            tuple((k, v) for k, v in node["env"]),
            node["cwd"],
        )
        for node in real["nodes"]
    ]
    assert requests
    tracer = Tracer(environment(), None)
    interfaces = [tracer.trace(request, threading.Event()) for request in requests]

    outcomes = {request.node: i.outcome.status for request, i in zip(requests, interfaces, strict=True)}
    assert outcomes == {r.node: "spinning" for r in requests}
    assert master_view(requests, interfaces) == real["shown"]


def test_every_row_of_the_table_is_there() -> None:
    launch_files = {path.stem for path in (ROS1_FIXTURES / "tutorials" / "launch").glob("*.launch")}
    assert launch_files == set(TUTORIALS)
    for script in (ROS1_FIXTURES / "tutorials" / "scripts").glob("*.py"):
        assert os.access(script, os.X_OK), script
