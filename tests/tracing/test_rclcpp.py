"""Nodes of rclcpp, as far as rcl sees them (`rclcpp_like.cpp`): their nodes, their parameters, how they end."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding
from preflight_analysis.live.expected import expected_of
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.interface import Range
from support.rcl_harness import RclHarness
from support.ros2_harness import ends, uses

pytestmark = pytest.mark.ros

SOURCE = "rclcpp_like.cpp"
CHILD = "node=own pub=chatter double=rate@1.5 child=costmap@/n/costmap pub=map double=resolution@0.1"


@pytest.fixture(params=["kilted", "jazzy"])
def harness(request: pytest.FixtureRequest, tmp_path: Path) -> RclHarness:
    return RclHarness(tmp_path, request.param, SOURCE)


@pytest.fixture
def kilted(tmp_path: Path) -> RclHarness:
    return RclHarness(tmp_path, source=SOURCE)


def launched(harness: RclHarness, args: str, inside: str = "", attributes: str = "name='n'") -> str:
    """The tag of a node that does this."""
    return f"<node pkg='cpkg' exec='node' args='{args}' {attributes}>{inside}</node>"


def found(harness: RclHarness, rule: str, launch: str) -> list[Finding]:
    """What the rule says of a launch."""
    return [finding for finding in harness.check(launch).findings if finding.rule == rule]


def command(harness: RclHarness, *words: str) -> subprocess.CompletedProcess[str]:
    """Run `ros-preflight` on the launch file that was checked last."""
    program = str(Path(sys.executable).with_name("ros-preflight"))
    line = [program, words[0], str(harness.launch_file), *words[1:]]
    return subprocess.run(line, env=harness.variables, capture_output=True, text=True, check=False)


# Several nodes


def test_events_carry_the_node_that_they_are_of(harness: RclHarness) -> None:
    trace = harness.trace(CHILD)
    assert trace.names == ("/n", "/n/costmap/costmap")
    assert {(e.name, e.node) for e in trace.endpoints if not e.builtin} == {
        ("chatter", "/n"),
        ("/n/costmap/map", "/n/costmap/costmap"),
    }
    assert {(p.name, p.node) for p in trace.params if not p.builtin} == {
        ("~rate", "/n"),
        ("~resolution", "/n/costmap/costmap"),
    }
    assert harness.trace("node=own pub=chatter").names == ()


def test_each_node_of_a_process_is_a_node_of_the_graph(kilted: RclHarness) -> None:
    graph = kilted.check(launched(kilted, CHILD)).graph
    assert graph is not None
    assert [(node.name, node.namespace, node.within) for node in graph.tree.nodes] == [
        ("/n", "/", None),
        ("/n/costmap/costmap", "/n/costmap/", "/n"),
    ]
    assert {
        name: [c.node.name for c in topic.providers] for name, topic in graph.topics.items() if "a" in name[-3:]
    } == {"/n/costmap/map": ["/n/costmap/costmap"]}
    reads = {read.name: read.node.name for read in graph.param_reads if not read.use.builtin}
    assert reads == {"/n/rate": "/n", "/n/costmap/costmap/resolution": "/n/costmap/costmap"}
    told = json.loads(command(kilted, "graph", "--format", "json").stdout)
    assert [
        (node["name"], [p["name"] for p in node["publishers"] if "builtin" not in p]) for node in told["nodes"]
    ] == [
        ("/n", ["/chatter"]),
        ("/n/costmap/costmap", ["/n/costmap/map"]),
    ]


def test_a_name_of_the_launch_is_that_of_each_node_and_others_are_their_own(kilted: RclHarness) -> None:
    both = "node=front pub=a node=rear pub=b"
    graph = kilted.check(launched(kilted, both, attributes="")).graph
    assert graph is not None
    assert [node.name for node in graph.tree.nodes] == ["/front", "/rear"]
    (finding,) = found(kilted, "LCH037", launched(kilted, both))
    assert "duplicate node name '/n'" in finding.message
    inside = "<remap from='rear:__node' to='back'/><remap from='front:a' to='x'/><remap from='back:b' to='y'/>"
    graph = kilted.check(launched(kilted, both, inside, "namespace='robot'")).graph
    assert graph is not None
    assert [node.name for node in graph.tree.nodes] == ["/robot/front", "/robot/back"]
    topics = {name: [c.node.name for c in topic.providers] for name, topic in graph.topics.items()}
    assert topics["/robot/x"] == ["/robot/front"]
    assert topics["/robot/y"] == ["/robot/back"]


def test_a_remap_counts_for_each_node_as_rcl_has_it(kilted: RclHarness) -> None:
    graph = kilted.check(
        launched(kilted, CHILD, "<remap from='map' to='grid'/><remap from='/n/costmap/x' to='y'/>")
    ).graph
    assert graph is not None
    assert "/n/costmap/grid" in graph.topics
    assert "/n/costmap/map" not in graph.topics


def test_each_node_gets_what_the_parameter_file_has_for_it(kilted: RclHarness) -> None:
    file = kilted.folder / "p.yaml"
    file.write_text(
        "n:\n  ros__parameters:\n    rate: 2.0\nn/costmap/costmap:\n  ros__parameters:\n    resolutoin: 0.7\n"
    )
    mandatory = f"{CHILD} mandatory=resolution2"
    launch = launched(kilted, CHILD, f"<param from='{file}'/>")
    (finding,) = found(kilted, "PRM013", launch)
    assert "parameter 'resolutoin' is not declared by /n/costmap/costmap" in finding.message
    assert "did you mean 'resolution'" in finding.message
    assert found(kilted, "PRM011", launch) == []
    file.write_text("n/costmap/costmap:\n  ros__parameters:\n    resolution2: 0.5\n")
    assert found(kilted, "PRM011", launched(kilted, mandatory, f"<param from='{file}'/>")) == []
    graph = kilted.check(launched(kilted, mandatory, f"<param from='{file}'/>")).graph
    assert graph is not None
    assert [interface.outcome.status for interface in graph.interfaces] == ["spinning", "spinning"]


def test_a_process_of_several_nodes_is_kept_until_what_one_of_them_gets_changes(kilted: RclHarness) -> None:
    kilted.cache = TraceCache(kilted.folder / "cache")
    file = kilted.folder / "p.yaml"
    inside = f"<param from='{file}'/>"
    for value, cached in ((0.5, False), (0.5, True), (0.7, False), (0.7, True)):
        file.write_text(f"n/costmap/costmap:\n  ros__parameters:\n    resolution: {value}\n")
        assert kilted.trace(CHILD, inside).cached is cached


# Parameters


@pytest.mark.parametrize("how", ["", "intra", "silent"])
def test_parameters_are_known_however_the_node_publishes_them(harness: RclHarness, how: str) -> None:
    trace = harness.trace(f"{how} node=own double=rate@1.5 percent=level", "<param name='rate' value='2.5'/>")
    assert (trace.outcome.status, trace.outcome.answers, trace.notes) == ("spinning", (), ())
    assert {name: (use.type, use.default, use.range) for name, use in uses(trace).items()} == {
        "~rate": ("double", None, None),  # what is seen is the value that it was given
        "~level": ("integer", 0, Range(0, 100)),
    }


def test_parameters_of_a_node_that_publishes_none_before_its_end_are_known(kilted: RclHarness) -> None:
    trace = kilted.trace("intra node=own double=rate@1.5 invalid=a")
    assert (trace.outcome.status, set(uses(trace))) == ("crashed", {"~rate"})


def test_a_value_out_of_range_is_told_of_a_node_that_goes_on(kilted: RclHarness) -> None:
    launch = launched(kilted, "node=own percent=level", "<param name='level' value='50'/>")
    assert kilted.check(launch).findings == ()


@pytest.mark.parametrize(("topic", "reliability"), [("/num", "best_effort"), ("/overridable", "reliable")])
def test_qos_is_overridden_under_the_remapped_name(harness: RclHarness, topic: str, reliability: str) -> None:
    override = f"<param name='qos_overrides.{topic}.publisher.reliability' value='best_effort'/>"
    trace = harness.trace("node=own overridable=overridable", f"<remap from='overridable' to='num'/>{override}")
    assert ends(trace)["publisher", "overridable"].qos["reliability"] == reliability


def test_a_trace_with_overridden_qos_is_kept_until_the_remap_changes(kilted: RclHarness) -> None:
    kilted.cache = TraceCache(kilted.folder / "cache")
    override = "<param name='qos_overrides./num.publisher.reliability' value='best_effort'/>"
    for target, cached in (("num", False), ("num", True), ("other", False)):
        trace = kilted.trace("node=own overridable=a", f"<remap from='a' to='{target}'/>{override}")
        assert trace.cached is cached
        assert (ends(trace)["publisher", "a"].qos["reliability"] == "best_effort") is (target == "num")


# The graph


def test_a_node_that_asks_who_is_there_is_not_fully_known(harness: RclHarness) -> None:
    relay = harness.trace("node=own relay=in")
    assert (relay.outcome.status, relay.looks, relay.complete, relay.likely_complete) == (
        "spinning",
        True,
        False,
        False,
    )
    plain = harness.trace("node=own pub=out")
    assert (plain.looks, plain.complete) == (False, True)


def test_nothing_is_said_to_be_missing_at_a_node_that_asks_who_is_there(kilted: RclHarness) -> None:
    others = launched(kilted, "node=own pub=in", "", "name='talker'") + launched(
        kilted, "node=own sub=in_relay", "", "name='listener'"
    )
    with_relay = others + launched(kilted, "node=own relay=in", "<remap from='in_relay' to='x'/>", "name='relay'")
    assert {(f.severity, f.confidence) for f in kilted.check(with_relay).findings} <= {("hint", "possible")}
    assert found(kilted, "TOP004", with_relay) == []
    unknown = [{doubt.reason for doubt in f.doubts} for f in kilted.check(others).findings]
    assert unknown and not any(Reason.NOT_ANALYSED in reasons for reasons in unknown)


# How it ends


def test_an_error_that_rcl_had_on_our_way_is_not_the_nodes(harness: RclHarness) -> None:
    outcome = harness.trace("node=own double=rate@1.0 error invalid=a").outcome
    assert outcome.status == "crashed"
    assert "overwritten" not in "".join(outcome.stderr_tail)


@pytest.mark.parametrize(
    ("args", "params", "rule", "message"),
    [
        ("double=speed@1.0", {"speed": "fast"}, "PRM014", "parameter 'speed': got a string, /n declares a double"),
        ("intra double=speed@1.0", {"speed": "2"}, "PRM014", "write 2.0"),
        ("percent=level", {"level": "300"}, "PRM017", "'level' is 300, which /n refuses"),
        ("mandatory=speed", {}, "PRM010", "required parameter 'speed' is not set; /n declares it without a default"),
        ("mandatory=speed", {"speed": "fast"}, "PRM014", "parameter 'speed': got a string"),
    ],
)
def test_a_constructor_that_throws_tells_of_the_parameter(
    harness: RclHarness, args: str, params: dict[str, str], rule: str, message: str
) -> None:
    inside = "".join(f"<param name='{name}' value='{value}'/>" for name, value in params.items())
    how, _, declares = args.rpartition(" ")
    findings = harness.check(launched(harness, f"{how} node=own {declares}", inside)).findings
    assert {(f.rule, f.severity) for f in findings} == {(rule, "error"), ("TRC001", "info")}
    assert message in next(f.message for f in findings if f.rule == rule)
    assert command(harness, "check").returncode == 1


def test_a_mandatory_parameter_that_is_misspelt_is_told_where_it_stands(kilted: RclHarness) -> None:
    findings = kilted.check(launched(kilted, "node=own mandatory=speed", "<param name='sped' value='1.0'/>")).findings
    assert {(f.rule, f.severity) for f in findings} == {("PRM010", "error"), ("PRM013", "warning"), ("TRC001", "info")}
    assert "did you mean 'speed'" in next(f.message for f in findings if f.rule == "PRM013")


def test_of_a_value_that_the_node_refuses_by_its_default_only_the_crash_is_told(kilted: RclHarness) -> None:
    given = "<param name='other' value='1'/>"
    findings = kilted.check(launched(kilted, "node=own refuse=level", given)).findings
    assert [(f.rule, f.severity) for f in findings] == [("TRC001", "warning")]


def test_what_a_node_that_goes_on_declares_is_not_refused(kilted: RclHarness) -> None:
    given = "<param name='speed' value='2.0'/><param name='level' value='100'/>"
    given += "<param name='speed2' value='1.0'/>"
    launch = launched(kilted, "node=own double=speed@1.0 mandatory=speed2 percent=level", given)
    assert kilted.check(launch).findings == ()


def test_a_crash_shows_what_was_thrown(harness: RclHarness) -> None:
    outcome = harness.trace("node=own invalid=a-b").outcome
    assert outcome.reason == (
        "it was killed by SIGABRT: InvalidTopicNameError: Invalid topic name: topic name must not contain characters "
        "other than alphanumerics, '_', '~', '{', or '}': 'a-b'"
    )


def test_watch_expects_each_node_with_its_own_ends(kilted: RclHarness) -> None:
    analysis = kilted.check(launched(kilted, CHILD))
    assert analysis.graph is not None
    expected = expected_of(analysis.graph, analysis.documents)
    assert {node.name: [end.name for end in node.endpoints] for node in expected.nodes} == {
        "/n": ["/chatter"],
        "/n/costmap/costmap": ["/n/costmap/map"],
    }
    assert all(node.certain and node.complete for node in expected.nodes)
