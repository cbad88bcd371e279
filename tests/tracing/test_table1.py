"""Table 1 of the paper, row by row: the traced interfaces of a launch file equal what a real master shows of it."""

from __future__ import annotations

import json
import os
import socket
import subprocess
import threading
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.evaluation import names
from preflight_analysis.tracing.interface import Interface
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.trace import Tracer
from tracing_desk import ROS1_FIXTURES, SYSTEM_PYTHON, environment

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


def free_port() -> int:
    with socket.socket() as listening:
        listening.bind(("127.0.0.1", 0))
        return int(listening.getsockname()[1])


def launched(launch_file: Path, folder: Path) -> dict[str, Any]:
    """What the real roslaunch starts, and what the real master then shows."""
    env = {
        "PATH": "/usr/bin:/bin",
        "HOME": str(folder),
        "ROS_HOME": str(folder / "ros_home"),
        "ROS_LOG_DIR": str(folder / "log"),
        "ROS_IP": "127.0.0.1",
        "ROS_PACKAGE_PATH": str(ROS1_FIXTURES),
    }
    script = Path(__file__).parent / "observe_launch.py"
    done = subprocess.run(
        [SYSTEM_PYTHON, str(script), str(launch_file), str(free_port())],
        env=env,
        capture_output=True,
        text=True,
        timeout=90,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    answer: dict[str, Any] = json.loads(done.stdout)
    return answer


def master_view(requests: list[TraceRequest], interfaces: list[Interface]) -> dict[str, dict[str, list[list[str]]]]:
    """The interfaces in the form in which the master has them: final names, one type to a topic."""
    ends = []
    for request, interface in zip(requests, interfaces, strict=True):
        remaps = names.resolve_remaps(request.remaps, request.node)
        ends += [
            (request.node, e.role, names.resolve(e.name, request.node, remaps), e.type) for e in interface.endpoints
        ]
    types = {name: kind for _, role, name, kind in ends if role in ("publisher", "subscriber") and kind != "*"}
    view: dict[str, dict[str, list[list[str]]]] = {}
    for request in requests:
        sides = view[request.node] = {}
        for role in ("publisher", "subscriber", "service"):
            found = {(name, kind) for node, r, name, kind in ends if node == request.node and r == role}
            if role != "service":
                found = {(name, types.get(name)) for name, _ in found}
            sides[role + "s"] = [list(pair) for pair in sorted(found)]
    return view


@pytest.mark.ros
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
