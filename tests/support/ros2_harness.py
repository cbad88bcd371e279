"""Workspaces of ROS 2 that are never built, and real runs of their nodes with the rclpy of PyPI."""

from __future__ import annotations

import functools
import os
import subprocess
import textwrap
import threading
from pathlib import Path

from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.environment.model import Environment
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.interface import Endpoint, Interface, ParamUse
from preflight_analysis.tracing.trace import Tracer
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Analysis, Workspace

ROOT = Path(__file__).parents[2]
NODE = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Own(Node):
    def __init__(self):
        super().__init__('own')
{constructor}


def main():
    rclpy.init()
    rclpy.spin(Own())
"""
"""A node like those of the tutorials, with the body of its constructor to fill in."""


@functools.cache
def ros2_prefix(distribution: str = "kilted") -> Path:
    """A virtual environment with rclpy, made by the first test that asks."""
    subprocess.run([ROOT / "tests" / "tracing" / "install_ros2.sh", distribution], check=True, timeout=600)
    return ROOT / "out" / f"ros2-{distribution}"


def node_of(constructor: str, *imports: str) -> str:
    """The source of a node whose constructor does this."""
    return "\n".join(imports) + NODE.format(constructor=textwrap.indent(textwrap.dedent(constructor).strip(), " " * 8))


class Ros2Harness:
    """A workspace with the package `pkg`, whose console scripts are its modules."""

    def __init__(self, folder: Path, **modules: str) -> None:
        self.folder = folder
        self.package = folder / "src" / "pkg"
        scripts = [f"{name} = pkg.{name}:main" for name in modules]
        self.write("package.xml", "<package format='3'><name>pkg</name><version>0.0.0</version><description>d"
                   "</description><maintainer email='a@b.c'>a</maintainer><license>MIT</license>"
                   "<exec_depend>rclpy</exec_depend><exec_depend>std_msgs</exec_depend>"
                   "<export><build_type>ament_python</build_type></export></package>")  # fmt: skip
        scripts_to = "$base/lib/pkg"
        self.write("setup.cfg", f"[develop]\nscript_dir={scripts_to}\n[install]\ninstall_scripts={scripts_to}\n")
        self.write("setup.py", "from setuptools import setup\nsetup(name='pkg', packages=['pkg'], data_files=[], "
                   f"entry_points={{'console_scripts': {scripts!r}}})\n")  # fmt: skip
        self.write("pkg/__init__.py", "")
        for name, body in modules.items():
            self.write(f"pkg/{name}.py", body)
        self.variables = {"PATH": f"{ros2_prefix() / 'bin'}:/usr/bin:/bin", "HOME": os.environ["HOME"]}
        self.cache: TraceCache | None = None

    def write(self, name: str, text: str) -> Path:
        """A file of the package."""
        path = self.package / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def check(self, launch: str) -> Analysis:
        """All that is known of a launch file in XML after its nodes were run."""
        path = self.write("launch/a.launch.xml", f"<launch>{launch}</launch>")
        return checked(path, detect_environment(str(self.folder), self.variables), self.cache)

    def trace(self, module: str, inside: str = "", attributes: str = "name='n'") -> Interface:
        """What one node does, with this in its tag."""
        graph = self.check(f"<node pkg='pkg' exec='{module}' {attributes}>{inside}</node>").graph
        assert graph is not None
        return graph.processes[0]


def ends(interface: Interface) -> dict[tuple[str, str], Endpoint]:
    """The node's own endpoints by role and name."""
    return {(e.role, e.name): e for e in interface.endpoints if not e.builtin}


def uses(interface: Interface) -> dict[str, ParamUse]:
    """The node's own parameters by name."""
    return {use.name: use for use in interface.params if not use.builtin}


def checked(launch_file: Path, environment: Environment, cache: TraceCache | None) -> Analysis:
    """All that is known of a launch file after its nodes were run."""
    workspace = Workspace(environment, Sources())
    static = workspace.static(str(launch_file))
    tracer = Tracer(environment, cache)
    interfaces = []
    for request in workspace.requests(static):
        assert request is not None
        interfaces.append(tracer.trace(request, threading.Event()))
    return workspace.with_interfaces(static, interfaces, None)
