"""`frames`: the contract's JSON, and the text."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from support.editor_harness import Harness

Run = Callable[..., Any]

LAUNCH = """<launch>
  <param name="robot_description" textfile="$(dirname)/r.urdf"/>
  <node pkg="robot_state_publisher" type="robot_state_publisher" name="rsp"/>
  <node pkg="tf2_ros" type="static_transform_publisher" name="s" args="0 0 0 0 0 0 odom base"/>
  <node pkg="tf2_ros" type="static_transform_publisher" name="t" args="0 0 0 0 0 0 map base"/>
</launch>
"""
URDF = """<robot name="r"><link name="base"/><link name="arm"/>
<joint name="j" type="fixed"><parent link="base"/><child link="arm"/></joint></robot>
"""


@pytest.fixture
def launch(harness: Harness) -> Path:
    path = harness.launch_file.with_name("frames.launch")
    path.write_text(LAUNCH)
    path.with_name("r.urdf").write_text(URDF)
    return path


def test_the_contract(launch: Path, preflight: Run) -> None:
    data = preflight("frames", launch, "--format", "json", "--no-run", "--fail-on", "never").json
    assert set(data) == {"schema", "file", "frames", "uses", "gaps"}
    assert (data["schema"], data["file"]) == ("ros-preflight/frames/1", str(launch))
    frames = {each["frame"]: each for each in data["frames"]}
    assert list(frames) == ["arm", "base", "map", "odom"]
    assert (frames["arm"]["topic"], frames["arm"]["root"]) == ("/tf", "odom")
    (arm,) = frames["arm"]["parents"]
    assert (arm["parent"], arm["how"], arm["node"], arm["detail"]) == ("base", "urdf", "/rsp", "joint j")
    assert [each["parent"] for each in frames["base"]["parents"]] == ["odom", "map"]


def test_the_text(launch: Path, preflight: Run) -> None:
    lines = preflight("frames", launch, "--no-run", "--fail-on", "never").out.splitlines()
    assert [line.split("  [")[0] for line in lines[:5]] == [
        "/tf", "  odom", "    base  /s", "      arm  /rsp (joint j)", "  map",
    ]  # fmt: skip
    assert "/t, parent map" in lines[2]
