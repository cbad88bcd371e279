"""Workspaces of ROS 2 that are built, with nodes in C on the rcl of PyPI's wheels."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from pathlib import Path

from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.interface import Interface
from preflight_analysis.workspace.workspace import Analysis

from support.action_package import action_package
from support.build_once import build_once
from support.composition_interfaces import composition_interfaces
from support.ros2_harness import ROOT, checked, ros2_prefix

SOURCES = ROOT / "tests" / "tracing"
CONTAINER = "container_like.cpp"
_LIBRARIES = (
    "fib__rosidl_typesupport_c",
    "rcl",
    "rcl_action",
    "rcl_lifecycle",
    "rcutils",
    "rmw",
    "rosidl_runtime_c",
    *(f"{package}__rosidl_{kind}" for package in ("std_msgs", "std_srvs", "lifecycle_msgs", "rcl_interfaces")
      for kind in ("typesupport_c", "typesupport_cpp", "generator_c")),
    "pthread",
)  # fmt: skip


def rcl_node(distribution: str = "kilted", source: str = "rcl_node.c") -> Path:
    """The program, compiled by the first test that asks."""
    name = f"{Path(source).stem}-{distribution}"
    return build_once(name, lambda folder: _compile(folder / "node", distribution, source)) / "node"


def _compile(made: Path, distribution: str, source: str) -> None:
    prefix = ros2_prefix(distribution)
    action = action_package(distribution)
    includes = [f"-I{folder}" for folder in (action.folder, *(prefix / "include").iterdir())]
    loads = source == CONTAINER
    if loads:
        includes += [f"-I{folder}" for folder in composition_interfaces(distribution).includes]
    # The libraries of the wheels are not linked with all that they need.
    linking = [
        f"-L{prefix / 'lib'}",
        f"-L{action.libraries}",
        "-rdynamic",
        "-Wl,--unresolved-symbols=ignore-in-shared-libs",
    ]
    libraries = [f"-l{library}" for library in _LIBRARIES]
    if loads:
        linking.append(f"-L{composition_interfaces(distribution).libraries}")
        libraries += ["-lcomposition_interfaces__rosidl_typesupport_cpp", "-ldl"]
    compiler = "g++" if source.endswith(".cpp") else "cc"
    subprocess.run(
        [compiler, "-w", *includes, str(SOURCES / source), "-o", str(made), *linking, *libraries], check=True
    )


class RclHarness:
    """A workspace with the built package `cpkg`, whose only program is `node`."""

    def __init__(self, folder: Path, distribution: str = "kilted", source: str = "rcl_node.c") -> None:
        self.folder = folder
        install = folder / "install"
        prefix = ros2_prefix(distribution)
        share = install / "share" / "cpkg"
        (install / "share/ament_index/resource_index/packages").mkdir(parents=True)
        (install / "share/ament_index/resource_index/packages/cpkg").touch()
        (share / "launch").mkdir(parents=True)
        (share / "package.xml").write_text(
            "<package format='3'><name>cpkg</name><version>0.0.0</version><description>d</description>"
            "<maintainer email='a@b.c'>a</maintainer><license>MIT</license>"
            "<exec_depend>std_msgs</exec_depend><export><build_type>ament_cmake</build_type></export></package>"
        )
        self.program = install / "lib" / "cpkg" / "node"
        self.program.parent.mkdir(parents=True)
        shutil.copy(rcl_node(distribution, source), self.program)
        self.launch_file = share / "launch" / "a.launch.xml"
        libraries = [
            action_package(distribution).libraries,
            prefix / "lib",
            *prefix.glob("lib/python3*/site-packages/ros_*.libs"),
        ]
        self.variables = {
            "PATH": f"{prefix / 'bin'}:/usr/bin:/bin",
            "HOME": os.environ["HOME"],
            "ROS_DISTRO": distribution,
            "AMENT_PREFIX_PATH": str(install),
            "LD_LIBRARY_PATH": os.pathsep.join(map(str, libraries)),
        }
        self.cache: TraceCache | None = None

    def check(self, launch: str) -> Analysis:
        """All that is known of a launch file in XML after its nodes were run."""
        self.launch_file.write_text(f"<launch>{launch}</launch>")
        return checked(self.launch_file, detect_environment(str(self.folder), self.variables), self.cache)

    def trace(self, args: str, inside: str = "", attributes: str = "name='n'") -> Interface:
        """What the node does with these arguments."""
        graph = self.check(f"<node pkg='cpkg' exec='node' args='{args}' {attributes}>{inside}</node>").graph
        assert graph is not None
        return graph.processes[0]


class ContainerHarness(RclHarness):
    """Likewise, and `node` is a container, with components that do what is told."""

    def __init__(self, folder: Path, distribution: str = "kilted") -> None:
        super().__init__(folder, distribution, CONTAINER)
        libraries = composition_interfaces(distribution).libraries
        self.variables["LD_LIBRARY_PATH"] += f"{os.pathsep}{libraries}"
        self.index = folder / "install/share/ament_index/resource_index/rclcpp_components/cpkg"
        self.index.parent.mkdir()
        self.components: dict[str, str] = {}

    def component(self, name: str, steps: str) -> None:
        """Make the component `cpkg::NAME`, which takes these steps in its constructor."""
        library = self.folder / "install" / "lib" / f"lib{name.lower()}.so"
        source = f"const char* steps(void) {{ return {json.dumps(steps)}; }}"
        subprocess.run(["cc", "-shared", "-fPIC", "-x", "c", "-", "-o", library], input=source, text=True, check=True)
        self.components[f"cpkg::{name}"] = f"lib/{library.name}"
        self.index.write_text("".join(f"{cls};{path}\n" for cls, path in self.components.items()))

    def loaded(self, name: str, inside: str = "", attributes: str = "name='n'", args: str = "") -> Interface:
        """What a component does that is loaded with this in its tag."""
        component = f"<composable_node pkg='cpkg' plugin='cpkg::{name}' {attributes}>{inside}</composable_node>"
        container = f"<node_container pkg='cpkg' exec='node' args='{args}' name='box' namespace=''>{component}"
        graph = self.check(f"{container}</node_container>").graph
        assert graph is not None
        return graph.processes[1]
