"""The wheel on a machine without a compiler."""

from __future__ import annotations

import json
import platform
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from preflight_analysis.tracing import preload_compile
from preflight_analysis.tracing.preload_compile import MACHINES, WATCHED
from support.installed_wheel import install, wheel

pytestmark = pytest.mark.ros


def test_an_installed_wheel_watches_roscpp_nodes_without_a_compiler(package: Path, tmp_path: Path) -> None:
    assert wheel().name.endswith("-py3-none-any.whl")
    interpreter = install(tmp_path / "installed")
    (site,) = tmp_path.glob("installed/lib/python3*/site-packages")

    tools = tmp_path / "tools"
    tools.mkdir()
    for tool in ("bwrap", "sh", "env", "python3"):
        found = shutil.which(tool, path="/usr/bin:/bin")
        assert found is not None
        (tools / tool).symlink_to(found)
    launch_file = tmp_path / "compiled.launch"
    launch_file.write_text('<launch><node name="n" pkg="compiled" type="node"/></launch>')
    variables = {
        "PATH": str(tools),
        "HOME": str(tmp_path),
        "XDG_CACHE_HOME": str(tmp_path / "cache"),
        "ROS_DISTRO": "noetic",
        "ROS_PACKAGE_PATH": str(package.parent),
    }
    told = subprocess.run(
        [str(interpreter.with_name("ros-preflight")), "graph", str(launch_file), "--format", "json"],
        env=variables,
        capture_output=True,
        text=True,
    )
    assert told.returncode == 0, told.stderr
    (node,) = json.loads(told.stdout)["nodes"]
    assert node["outcome"] == "spinning"
    chatter = {"name": "/chatter", "type": "std_msgs/String", "qos": {"latch": True, "queue_size": 7}}
    assert chatter in node["publishers"]
    (copy,) = (tmp_path / "cache" / "ros-preflight" / "preload").glob("*.so")
    agents = site / "preflight_analysis/tracing/agents"
    assert copy.read_bytes() == (agents / f"roscpp_preload.{platform.machine()}.so").read_bytes()
    libraries = {path.name for path in agents.glob("*.so")}
    assert libraries == {watched.prebuilt(machine).name for watched in WATCHED for machine in MACHINES}


def test_what_compiles_for_a_wheel_needs_the_standard_library_alone() -> None:
    """A wheel is built where nothing of ours is installed: else it silently comes without the compiled libraries."""
    subprocess.run([sys.executable, "-I", "-S", preload_compile.__file__], check=True)
