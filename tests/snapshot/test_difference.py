"""What counts as a difference of two snapshots, and how it is told."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.snapshot.difference import difference
from preflight_analysis.snapshot.files import NotASnapshotError, from_yaml, is_snapshot, to_yaml
from preflight_analysis.snapshot.make import snapshot_of
from preflight_analysis.snapshot.model import EndpointSnapshot, NodeSnapshot, Snapshot
from preflight_analysis.snapshot.portable import Portable
from preflight_analysis.snapshot.report import to_json, to_markdown, to_text
from preflight_analysis.tracing.interface import Endpoint, Interface, Outcome, ParamUse
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

CAMERA = NodeSnapshot(
    {"package": "cam", "executable": "camera"},
    "$(find cam)/launch/camera.launch",
    "trace",
    "spinning",
    {"publisher": {"/image": EndpointSnapshot("sensor_msgs/msg/Image", {"reliability": "best_effort", "depth": 5})}},
    {"rate": 10, "names": ["a", "b"]},
)
VIEW = NodeSnapshot(
    {"package": "view", "executable": "view"},
    interface="trace",
    outcome="spinning",
    endpoints={"subscriber": {"/image": EndpointSnapshot("sensor_msgs/msg/Image", {"reliability": "reliable"})}},
)
ROBOT = Snapshot("$(find robot)/launch/robot.launch", 2, {"sim": "true"}, {"/camera": CAMERA, "/view": VIEW})


def with_camera(**changes: Any) -> Snapshot:
    return replace(ROBOT, nodes={**ROBOT.nodes, "/camera": replace(CAMERA, **changes)})


def told(before: Snapshot, after: Snapshot) -> list[str]:
    return to_text(difference(before, after), "a", "b").splitlines()[3:]


def test_the_same_is_the_same() -> None:
    assert told(ROBOT, ROBOT) == ["no differences"]
    moved = with_camera(origin="$(find cam)/launch/other.launch")
    assert told(ROBOT, moved) == ["no differences"], "which file a node is written in changes nothing"


def test_types_qos_and_parameters_that_changed() -> None:
    changed = with_camera(
        endpoints={
            "publisher": {
                "/image": EndpointSnapshot("sensor_msgs/msg/CompressedImage", {"reliability": "reliable", "depth": 5})
            }
        },
        parameters={"rate": 10.0, "names": ["a", "b"], "frame": ""},
        facts={**CAMERA.facts, "respawn": True},
    )
    assert told(ROBOT, changed) == [
        "~ node /camera",
        "  + respawn  true",
        "  ~ publishes /image  type sensor_msgs/msg/Image -> sensor_msgs/msg/CompressedImage, "
        "reliability best_effort -> reliable",
        '  + parameter frame  ""',
        "  ~ parameter rate  10 -> 10.0",
        "",
        "1 node changed",
    ]


def test_nodes_that_came_and_went() -> None:
    without = replace(ROBOT, nodes={"/camera": CAMERA})
    assert told(ROBOT, without) == [
        "- node /view  view/view  (1 subscriber)",
        "",
        "connections",
        "  - topic /image  /camera -> /view",
        "",
        "1 node removed, 1 connection removed",
    ]
    assert [line.replace("+", "-") for line in told(without, ROBOT)][:4] == told(ROBOT, without)[:4]


@pytest.mark.parametrize(
    "other",
    [
        {"interface": "none", "outcome": "not-run", "endpoints": {}},
        {"interface": "source", "outcome": "not-run", "endpoints": {}},
        {"interface": "source", "outcome": "not-run", "endpoints": {"publisher": {"/image": EndpointSnapshot(None)}}},
    ],
)
def test_what_a_side_cannot_know_is_no_difference(other: dict[str, Any]) -> None:
    unsure = with_camera(**other)
    for before, after in ((ROBOT, unsure), (unsure, ROBOT)):
        found = difference(before, after)
        assert found.same, found.changes
        assert list(found.not_compared) == ["/camera"]


def test_what_only_the_source_tells_counts_against_a_run() -> None:
    """A run that reached the event loop is a witness that there is no more; two sources are alike."""
    more = {"publisher": {**CAMERA.endpoints["publisher"], "/info": EndpointSnapshot("a/msg/B")}}
    read = with_camera(interface="source", outcome="not-run", endpoints=more)
    assert told(ROBOT, read)[1] == "  + publishes /info  a/msg/B"
    less = with_camera(interface="source", outcome="not-run")
    assert told(read, less)[1] == "  - publishes /info  a/msg/B"


def test_a_run_that_ended_otherwise_is_a_difference() -> None:
    assert told(ROBOT, with_camera(outcome="exited 3", endpoints={}))[1] == "  ~ outcome  spinning -> exited 3"
    assert not difference(ROBOT, with_camera(outcome="exited 3", endpoints={})).links


def test_errors_and_parameters_of_no_node_are_told() -> None:
    broken = replace(ROBOT, errors=("PKG001 $(find gone) ($(find robot)/x.launch)",), parameters={"/map": "a"})
    assert told(ROBOT, broken) == [
        "+ error PKG001 $(find gone) ($(find robot)/x.launch)",
        "+ parameter /map  a",
        "",
        "2 differences beside the nodes",
    ]


def test_markdown_shows_any_text_as_it_is() -> None:
    odd = with_camera(parameters={**CAMERA.parameters, "a|b": "`x` | <b>\n| y"})
    row = to_markdown(difference(ROBOT, odd), "a", "b").splitlines()[-1]
    assert row == "| + | `/camera` | parameter `a\\|b` |  | `` `x` \\| <b> \\| y `` |"


def test_json_says_all_of_it() -> None:
    data = to_json(difference(ROBOT, with_camera(parameters={"rate": 11, "names": ["a", "b"]})))
    assert data["changes"] == [
        {"kind": "changed", "what": "parameter", "node": "/camera", "name": "rate", "before": 10, "after": 11}
    ]
    assert data["before"] == {"launch": ROBOT.launch, "generation": 2, "args": {"sim": "true"}}


_TEXT = st.text(st.characters(codec="utf-8"), max_size=12)
_VALUE = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | _TEXT,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(_TEXT, inner, max_size=3),
    max_leaves=6,
)
_NAME = _TEXT.filter(bool)


_END = st.builds(EndpointSnapshot, st.none() | _TEXT, st.fixed_dictionaries({"depth": st.integers()}))


@settings(deadline=None, derandomize=True, max_examples=100, suppress_health_check=[HealthCheck.too_slow])
@given(
    st.dictionaries(_NAME, _VALUE, max_size=3),
    st.dictionaries(_NAME, _TEXT, max_size=3),
    st.dictionaries(_NAME, _END, max_size=3),
)
def test_written_and_read_again_is_the_same(
    values: dict[str, Any], texts: dict[str, str], ends: dict[str, EndpointSnapshot]
) -> None:
    node = replace(CAMERA, parameters=values, remaps=texts, env=texts, endpoints={"client": ends} if ends else {})
    snapshot = replace(ROBOT, args=texts, nodes={"/camera": node}, parameters=values, unknown=tuple(texts))
    text = to_yaml(snapshot)
    assert is_snapshot(text)
    again = from_yaml(text)
    assert again == snapshot
    assert difference(snapshot, again).same
    assert to_yaml(again) == text


@pytest.mark.parametrize(
    "text",
    [
        *("", "[", "5", "schema: 5", "\x00", "a: b", "schema: ros-preflight/snapshot/1\nnodes: {/a: 5}"),
        "schema: ros-preflight/snapshot/1\nparameters: &a {/a: *a}",
    ],
)
def test_what_is_no_snapshot(text: str) -> None:
    with pytest.raises(NotASnapshotError):
        from_yaml(text)


def test_values_of_yaml_that_json_does_not_have_are_told() -> None:
    read = from_yaml(
        "schema: ros-preflight/snapshot/1\n"
        "nodes: {/n: {interface: trace, reads: {/n/b: {default: .nan, 1: 2024-01-02}}}}\n"
        "parameters: {/x: {1: a, b: !!binary aGk=}}\n"
    )
    assert read.nodes["/n"].reads == {"/n/b": {"default": "nan", "1": "2024-01-02"}}
    assert json.dumps(to_json(difference(ROBOT, read)), sort_keys=True, allow_nan=False)


def test_a_launch_file_is_no_snapshot() -> None:
    assert not is_snapshot('<launch><param name="a" value="ros-preflight/snapshot/1"/></launch>')
    assert not is_snapshot("launch:\n- node: {pkg: a, exec: b}\n")


LAUNCH = """<launch>
  <node pkg="robot" exec="driver" name="driver" namespace="left">
    <param name="file" value="$(find-pkg-share robot)/config/a.yaml"/>
    <param name="gain" value="1.5"/>
    <remap from="scan" to="/front/scan"/>
  </node>
  <node pkg="robot" exec="driver" name="driver" namespace="left"/>
</launch>
"""


def test_ros_2(tmp_path: Path) -> None:
    folder = tmp_path / "src/robot"
    (folder / "launch").mkdir(parents=True)
    (folder / "package.xml").write_text(
        "<package><name>robot</name><export><build_type>ament_cmake</build_type></export></package>"
    )
    launch = folder / "launch/robot.launch.xml"
    launch.write_text(LAUNCH)
    environment = detect_environment(str(tmp_path), {}, root=str(tmp_path / "nothing"))
    workspace = Workspace(environment, Sources())
    ends = (Endpoint("publisher", "scan", "sensor_msgs/msg/LaserScan", qos={"reliability": "reliable", "depth": 5}),)
    seen = Interface("trace", Outcome("spinning"), ends, (ParamUse("~gain", "get", 1.0, True),))
    analysis = workspace.with_interfaces(workspace.static(str(launch)), [seen, seen], None)
    assert analysis.graph is not None
    snapshot = snapshot_of(analysis, analysis.graph)
    assert (
        to_yaml(snapshot).partition("\n\nnodes:\n")[2]
        == """\
  /left/driver:
    package: robot
    executable: driver
    from: $(find-pkg-share robot)/launch/robot.launch.xml
    interface: trace
    outcome: spinning
    publishers:
      /front/scan: {type: sensor_msgs/msg/LaserScan, depth: 5, reliability: reliable}
    parameters:
      file: $(find-pkg-share robot)/config/a.yaml
      gain: 1.5
    reads:
      /left/driver/gain: {default: 1.0}
    remaps:
      scan: /front/scan

  /left/driver#2:
    package: robot
    executable: driver
    from: $(find-pkg-share robot)/launch/robot.launch.xml
    interface: trace
    outcome: spinning
    publishers:
      /left/scan: {type: sensor_msgs/msg/LaserScan, depth: 5, reliability: reliable}
    reads:
      /left/driver/gain: {default: 1.0}
"""
    )
    assert from_yaml(to_yaml(snapshot)) == snapshot


def test_paths_of_this_machine_are_told_by_what_they_are(tmp_path: Path) -> None:
    (tmp_path / "ws/src/a").mkdir(parents=True)
    (tmp_path / "ws/src/a/package.xml").write_text("<package><name>a</name></package>")
    portable = Portable(detect_environment(str(tmp_path / "ws"), {}, root=str(tmp_path / "nothing")), 1)
    said = (
        f"x {tmp_path}/ws/src/a/maps/b.yaml:{tmp_path}/ws/data file://{tmp_path}/ws/src/a {tmp_path}/ws/src/abc /scan"
    )
    assert portable.text(said) == "x $(find a)/maps/b.yaml:<workspace>/data file://$(find a) <workspace>/src/abc /scan"
