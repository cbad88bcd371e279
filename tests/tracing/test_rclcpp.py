"""Nodes of rclcpp, as far as rcl sees them (`rclcpp_like.cpp`): their nodes, their parameters, how they end."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest
from preflight_analysis.findings.finding import Finding
from preflight_analysis.tracing.cache import TraceCache
from rcl_desk import RclDesk
from ros2_desk import ends, uses

SOURCE = "rclcpp_like.cpp"
CHILD = "node=own pub=chatter double=rate@1.5 child=costmap@/n/costmap pub=map double=resolution@0.1"


@pytest.fixture(params=["kilted", "jazzy"])
def desk(request: pytest.FixtureRequest, tmp_path: Path) -> RclDesk:
    return RclDesk(tmp_path, request.param, SOURCE)


@pytest.fixture
def kilted(tmp_path: Path) -> RclDesk:
    return RclDesk(tmp_path, source=SOURCE)


def launched(desk: RclDesk, args: str, inside: str = "", attributes: str = "name='n'") -> str:
    """The tag of a node that does this."""
    return f"<node pkg='cpkg' exec='node' args='{args}' {attributes}>{inside}</node>"


def found(desk: RclDesk, rule: str, launch: str) -> list[Finding]:
    """What the rule says of a launch."""
    return [finding for finding in desk.check(launch).findings if finding.rule == rule]


def command(desk: RclDesk, *words: str) -> subprocess.CompletedProcess[str]:
    """Run `ros-preflight` on the launch file that was checked last."""
    program = str(Path(sys.executable).with_name("ros-preflight"))
    line = [program, words[0], str(desk.launch_file), *words[1:]]
    return subprocess.run(line, env=desk.variables, capture_output=True, text=True, check=False)


# Several nodes


def test_events_carry_the_node_that_they_are_of(desk: RclDesk) -> None:
    trace = desk.trace(CHILD)
    assert trace.names == ("/n", "/n/costmap/costmap")
    assert {(e.name, e.node) for e in trace.endpoints if not e.builtin} == {
        ("chatter", "/n"),
        ("/n/costmap/map", "/n/costmap/costmap"),
    }
    assert {(p.name, p.node) for p in trace.params if not p.builtin} == {
        ("~rate", "/n"),
        ("~resolution", "/n/costmap/costmap"),
    }
    assert desk.trace("node=own pub=chatter").names == ()


def test_each_node_of_a_process_is_a_node_of_the_graph(kilted: RclDesk) -> None:
    graph = kilted.check(launched(kilted, CHILD)).graph
    assert graph is not None
    assert [(node.name, node.namespace, node.within) for node in graph.tree.nodes] == [
        ("/n", "/", None),
        ("/n/costmap/costmap", "/n/costmap/", "/n"),
    ]
    assert {name: [c.node.name for c in topic.offers] for name, topic in graph.topics.items() if "a" in name[-3:]} == {
        "/n/costmap/map": ["/n/costmap/costmap"]
    }
    reads = {read.name: read.node.name for read in graph.param_reads if not read.use.builtin}
    assert reads == {"/n/rate": "/n", "/n/costmap/costmap/resolution": "/n/costmap/costmap"}
    told = json.loads(command(kilted, "graph", "--format", "json").stdout)
    assert [(node["name"], [p["name"] for p in node["publishers"] if "builtin" not in p]) for node in told["nodes"]] == [
        ("/n", ["/chatter"]),
        ("/n/costmap/costmap", ["/n/costmap/map"]),
    ]


def test_a_name_of_the_launch_is_that_of_each_node_and_others_are_their_own(kilted: RclDesk) -> None:
    both = "node=front pub=a node=rear pub=b"
    graph = kilted.check(launched(kilted, both, attributes="")).graph
    assert graph is not None
    assert [node.name for node in graph.tree.nodes] == ["/front", "/rear"]
    (finding,) = found(kilted, "LCH037", launched(kilted, both))
    assert "all of them have the name '/n'" in finding.message
    inside = "<remap from='rear:__node' to='back'/><remap from='front:a' to='x'/><remap from='back:b' to='y'/>"
    graph = kilted.check(launched(kilted, both, inside, "namespace='robot'")).graph
    assert graph is not None
    assert [node.name for node in graph.tree.nodes] == ["/robot/front", "/robot/back"]
    topics = {name: [c.node.name for c in topic.offers] for name, topic in graph.topics.items()}
    assert topics["/robot/x"] == ["/robot/front"]
    assert topics["/robot/y"] == ["/robot/back"]


def test_a_remap_counts_for_each_node_as_rcl_has_it(kilted: RclDesk) -> None:
    graph = kilted.check(launched(kilted, CHILD, "<remap from='map' to='grid'/><remap from='/n/costmap/x' to='y'/>")).graph
    assert graph is not None
    assert "/n/costmap/grid" in graph.topics
    assert "/n/costmap/map" not in graph.topics


def test_each_node_gets_what_the_parameter_file_has_for_it(kilted: RclDesk) -> None:
    file = kilted.folder / "p.yaml"
    file.write_text(
        "n:\n  ros__parameters:\n    rate: 2.0\n"
        "n/costmap/costmap:\n  ros__parameters:\n    resolution: 0.5\n    resolutoin: 0.7\n"
    )
    mandatory = f"{CHILD} mandatory=resolution2"
    launch = launched(kilted, CHILD, f"<param from='{file}'/>")
    (finding,) = found(kilted, "PRM013", launch)
    assert "/n/costmap/costmap declares no parameter 'resolutoin'" in finding.message
    assert "did you mean 'resolution'" in finding.message
    assert found(kilted, "PRM011", launch) == []
    file.write_text("n/costmap/costmap:\n  ros__parameters:\n    resolution2: 0.5\n")
    graph = kilted.check(launched(kilted, mandatory, f"<param from='{file}'/>")).graph
    assert graph is not None
    assert [interface.outcome.status for interface in graph.interfaces] == ["spinning", "spinning"]


def test_a_process_of_several_nodes_is_kept_until_what_one_of_them_gets_changes(kilted: RclDesk) -> None:
    kilted.cache = TraceCache(kilted.folder / "cache")
    file = kilted.folder / "p.yaml"
    inside = f"<param from='{file}'/>"
    for value, cached in ((0.5, False), (0.5, True), (0.7, False), (0.7, True)):
        file.write_text(f"n/costmap/costmap:\n  ros__parameters:\n    resolution: {value}\n")
        assert kilted.trace(CHILD, inside).cached is cached


# How it ends


def test_an_error_that_rcl_had_on_our_way_is_not_the_nodes(desk: RclDesk) -> None:
    outcome = desk.trace("node=own double=rate@1.0 error invalid=a").outcome
    assert outcome.status == "crashed"
    assert "overwritten" not in "".join(outcome.stderr_tail)


def test_a_crash_shows_what_was_thrown(desk: RclDesk) -> None:
    outcome = desk.trace("node=own invalid=a-b").outcome
    assert outcome.reason == (
        "it was killed by SIGABRT: InvalidTopicNameError: Invalid topic name: topic name must not contain characters "
        "other than alphanumerics, '_', '~', '{', or '}': 'a-b'"
    )


