"""The same node with the real client library and with the stand-in for it."""

from __future__ import annotations

import subprocess
import threading
from dataclasses import replace
from pathlib import Path
from typing import Any

from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.environment.model import Environment
from preflight_analysis.tracing.interface import Interface
from preflight_analysis.tracing.trace import Tracer

from support.build_once import build_once
from support.ros2_harness import Ros2Harness, checked
from support.tracing_harness import SYSTEM_PYTHON, environment, request


def bare_python() -> Path:
    """The folder of an interpreter that has the standard library and nothing else."""

    def make(folder: Path) -> None:
        subprocess.run([SYSTEM_PYTHON, "-m", "venv", "--without-pip", folder / "python"], check=True, timeout=60)

    return build_once("bare-python", make) / "python" / "bin"


def without_rospy(*package_path: Path) -> Environment:
    """A machine with these folders on the package path, and no ROS."""
    python = bare_python()
    found = environment(*package_path)
    named = (*found.named_folders, str(python.parent))
    return replace(found, python=str(python / "python3"), named_folders=named)


def both_of_ros1(script: Path, **more: Any) -> tuple[Interface, Interface]:
    """What a script does with the real rospy and with the stand-in."""
    asked, cancel = request(script, **more), threading.Event()
    real, bare = (Tracer(each, None) for each in (environment(script.parent), without_rospy(script.parent)))
    return real.trace(asked, cancel), bare.trace(asked, cancel)


def without_rclpy(harness: Ros2Harness, python: Path | None = None) -> Environment:
    """The harness's workspace on a machine without ROS, or with what the interpreter `python` has of it."""
    python = python or bare_python() / "python3"
    found = detect_environment(str(harness.folder), harness.variables)
    return replace(
        found,
        ros2_python=str(python),
        ament_prefixes=(),
        variables={**found.variables, "PATH": f"{python.parent}:/usr/bin:/bin"},
        named_folders=(*found.named_folders, str(python.parent.parent)),
    )


def both_of_ros2(harness: Ros2Harness, module: str, inside: str = "") -> tuple[Interface, Interface]:
    """What a module does with the real rclpy and with the stand-in."""
    real = harness.trace(module, inside, "name='n' namespace='/robot'")
    graph = checked(harness.package / "launch/a.launch.xml", without_rclpy(harness), None).graph
    assert graph is not None
    return real, graph.processes[0]


def seen(interface: Interface) -> dict[str, Any]:
    """What two traces have to agree in. Sums of definitions are not known without them, and the client library's own
    parameters depend on when it logs for the first time."""
    return {
        "status": interface.outcome.status,
        "answers": interface.outcome.answers,
        "endpoints": sorted(
            repr(replace(e, md5=None, evidence=e.evidence.without("stand-in"))) for e in interface.endpoints
        ),
        "params": sorted({repr(p) for p in interface.params if not p.builtin}),
        "nodes": interface.nodes,
        "frames": interface.frames,
    }
