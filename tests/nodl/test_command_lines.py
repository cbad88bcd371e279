"""Topics that the nodes of topic_tools are given."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.tracing.interface import NOT_RUN
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace


def topics_of(folder: Path, node: str, name: str = "a.launch") -> tuple[set[str], set[str]]:
    """What the node publishes and subscribes to."""
    launch = folder / "src" / name
    launch.parent.mkdir()
    launch.write_text(f"<launch>{node}</launch>")
    environment = detect_environment(str(folder), {}, root=str(folder / "nowhere"))
    workspace = Workspace(environment, Sources(), str(folder))
    static = workspace.static(str(launch))
    graph = workspace.with_interfaces(static, [NOT_RUN] * len(static.tree.nodes), None).graph
    assert graph is not None
    any_type = {name: channel for name, channel in graph.topics.items() if channel.types == ("*",)}
    return (
        {name for name, channel in any_type.items() if channel.providers},
        {name for name, channel in any_type.items() if channel.consumers},
    )


@pytest.mark.parametrize(
    ("tool", "args", "published", "subscribed"),
    [
        ("relay", "scan /base_scan", {"/base_scan"}, {"/r/scan"}),
        ("relay", "/scan _lazy:=true", {"/scan_relay"}, {"/scan"}),
        ("throttle", "messages scan 5.0", {"/r/scan_throttle"}, {"/r/scan"}),
        ("throttle", "messages scan 5.0 slow", {"/r/slow"}, {"/r/scan"}),
        ("throttle", "bytes scan 1024 1.0 slow", {"/r/slow"}, {"/r/scan"}),
        ("drop", "scan 1 2", {"/r/scan_drop"}, {"/r/scan"}),
        ("mux", "cmd_vel nav teleop", {"/r/cmd_vel"}, {"/r/nav", "/r/teleop"}),
        ("demux", "in a b", {"/r/a", "/r/b"}, {"/r/in"}),
        ("throttle", "", set(), set()),
        ("relay", "", set(), set()),
        ("transform", "/imu/orientation /norm std_msgs/Float64 m", set(), set()),
    ],
)
def test_ros1(tmp_path: Path, tool: str, args: str, published: set[str], subscribed: set[str]) -> None:
    node = f'<node pkg="topic_tools" type="{tool}" name="tool" ns="r" args="{args}"/>'
    assert topics_of(tmp_path, node) == (published, subscribed)


def test_ros2_has_parameters_for_it(tmp_path: Path) -> None:
    params = '<param name="input_topic" value="scan"/><param name="output_topic" value="/out"/>'
    node = f'<node pkg="topic_tools" exec="relay" name="tool">{params}</node>'
    assert topics_of(tmp_path, node, "a.launch.xml") == ({"/out"}, {"/scan"})


def test_a_remap_and_the_users_word_count(tmp_path: Path) -> None:
    node = '<node pkg="topic_tools" type="relay" name="tool" args="scan out"><remap from="scan" to="/laser"/></node>'
    assert topics_of(tmp_path, node) == ({"/out"}, {"/laser"})
