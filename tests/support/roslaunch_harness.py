"""What the real roslaunch and master show of a launch file, and traced interfaces in the same form."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any

from preflight_analysis.evaluation import names
from preflight_analysis.tracing.interface import Interface
from preflight_analysis.tracing.request import TraceRequest

from support.live_harness import private_port
from support.tracing_harness import ROS1_FIXTURES, SYSTEM_PYTHON


def launched(launch_file: Path, folder: Path, packages: Path = ROS1_FIXTURES, display: str = "") -> dict[str, Any]:
    """What the real roslaunch starts, and what the real master then shows. `display` is an X server for its windows."""
    env = {
        "PATH": "/usr/bin:/bin",
        "HOME": str(folder),
        "ROS_HOME": str(folder / "ros_home"),
        "ROS_LOG_DIR": str(folder / "log"),
        "ROS_IP": "127.0.0.1",
        "ROS_PACKAGE_PATH": str(packages),
        **({"DISPLAY": display} if display else {}),
    }
    script = Path(__file__).parents[1] / "tracing" / "observe_launch.py"
    done = subprocess.run(
        [SYSTEM_PYTHON, str(script), str(launch_file), str(private_port())],
        env=env,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    answer: dict[str, Any] = json.loads(done.stdout)
    return answer


def master_view(requests: list[TraceRequest], interfaces: list[Interface]) -> dict[str, dict[str, list[list[str]]]]:
    """The interfaces in the form in which the master has them: final names, one type to a topic. What is made on demand
    is left out: nobody connects to the nodes."""
    ends = []
    for request, interface in zip(requests, interfaces, strict=True):
        remaps = names.resolve_remaps(request.remaps, request.node)
        ends += [
            (request.node, e.role, names.resolve(e.name, request.node, remaps), e.type)
            for e in interface.endpoints
            if "on demand" not in e.evidence.doubts
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
