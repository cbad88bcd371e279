"""Nodes on rcl that are no Python: what the preloaded library tells of them, on each distribution that PyPI has."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest
from preflight_analysis.tracing import preload, preload_compile
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.interface import MadeNode
from preflight_analysis.tracing.preload import Library
from support.rcl_harness import RclHarness
from support.ros2_harness import ends, uses

pytestmark = pytest.mark.ros

ALL = {
    ("publisher", "chatter"): "std_msgs/msg/String",
    ("publisher", "~/state"): "std_msgs/msg/String",
    ("subscriber", "/scan"): "std_msgs/msg/String",
    ("service", "reset"): "std_srvs/srv/Empty",
    ("client", "/map/load"): "std_srvs/srv/Empty",
}


@pytest.fixture(params=["kilted", "jazzy"])
def harness(request: pytest.FixtureRequest, tmp_path: Path) -> RclHarness:
    return RclHarness(tmp_path, request.param)


def test_endpoints_have_the_names_that_the_node_gave(harness: RclHarness) -> None:
    found = harness.trace("ends", "<remap from='chatter' to='/elsewhere'/>", "name='n' namespace='/robot'")
    assert (found.source, found.outcome.status, found.outcome.answers, found.notes) == ("trace", "spinning", (), ())
    assert found.nodes == (MadeNode("n", "own", "", renamed=True),)
    by_name = ends(found)
    assert {key: end.type for key, end in by_name.items()} == ALL
    assert by_name["publisher", "~/state"].qos == {
        "reliability": "reliable",
        "durability": "transient_local",
        "liveliness": "automatic",
        "depth": 1,
        "deadline": 2.5,
    }
    assert by_name["subscriber", "/scan"].qos["reliability"] == "best_effort"


def test_nodes_are_seen_the_same_with_each_way_to_isolate(tmp_path: Path, each_backend: str) -> None:
    harness = RclHarness(tmp_path)
    found = harness.trace("ends")
    if each_backend == "landlock":  # which leaves the middleware no socket: nothing is known then, and nothing is said
        assert (found.source, found.outcome.status) == ("none", "not-run")
        assert "the middleware may need what the sandbox by landlock refuses" in (found.outcome.reason or "")
        return
    assert (found.outcome.status, found.notes, set(ends(found))) == ("spinning", (), set(ALL))
    assert set(ends(harness.trace("managed"))) == {("publisher", "made"), ("subscriber", "active")}


@pytest.mark.parametrize("mode", ["ends", "poll", "thread", "sleep"])
def test_event_loops(harness: RclHarness, mode: str) -> None:
    found = harness.trace(mode)
    assert (found.outcome.status, set(ends(found))) == ("spinning", set(ALL))


def test_what_is_made_after_a_short_wait_is_seen(harness: RclHarness) -> None:
    assert set(ends(harness.trace("late"))) == {*ALL, ("publisher", "late")}


def test_a_node_in_a_namespace_of_its_own_has_full_names(harness: RclHarness) -> None:
    found = harness.trace("elsewhere", attributes="")
    assert ("publisher", "/there/chatter") in ends(found)
    assert [(node.name, node.space) for node in found.nodes] == [("own", "/there")]


@pytest.mark.parametrize("mode", ["wait", "watch"])
def test_a_service_that_is_waited_for_answers_and_what_comes_then_is_speculative(
    harness: RclHarness, mode: str
) -> None:
    found = harness.trace(mode)
    assert found.outcome.status == "spinning"
    assert set(found.outcome.answers) == {
        "it asks for the service /start again and again, and was told that it is there",
        "it calls the service /start, and was given an empty answer",
    }
    assert {key: "made-up answer" in end.evidence.doubts for key, end in ends(found).items()} == {
        ("client", "start"): False,
        ("publisher", "after"): True,
    }


def test_actions_are_one_end_each_and_their_servers_are_waited_for(harness: RclHarness) -> None:
    found = harness.trace("action")
    assert found.outcome.status == "spinning"
    assert found.outcome.answers == ("it waits for the action server /n/other, and was told that it is there",)
    assert {key: (end.type, "made-up answer" in end.evidence.doubts) for key, end in ends(found).items()} == {
        ("action_server", "count"): ("fib/action/Fib", False),
        ("action_client", "~/other"): ("fib/action/Fib", False),
        ("publisher", "after"): ("std_msgs/msg/String", True),
    }


def test_lifecycle_nodes_are_configured_and_activated(harness: RclHarness) -> None:
    found = harness.trace("managed")
    assert (found.outcome.status, found.outcome.answers) == ("spinning", ())
    assert set(ends(found)) == {("publisher", "made"), ("subscriber", "active")}
    builtin = {e.name for e in found.endpoints if e.builtin}
    assert {"~/change_state", "~/get_state", "~/transition_event"} <= builtin


@pytest.mark.parametrize("transitions", [(), ("configure",), ("activate", "configure")])
def test_the_transitions_that_a_lifecycle_node_makes_by_itself(
    harness: RclHarness, transitions: tuple[str, ...]
) -> None:
    found = harness.trace(f"managed self {len(transitions)}")
    assert (found.outcome.status, found.outcome.answers, found.transitions) == ("spinning", (), transitions)


def test_a_lifecycle_node_that_refuses_to_be_configured_is_left_alone(harness: RclHarness) -> None:
    found = harness.trace("managed fail")
    assert (found.outcome.status, set(ends(found))) == ("spinning", {("publisher", "made")})
    assert found.outcome.answers == ("it was asked to configure, as a manager of lifecycle nodes would, and did not",)
    assert not found.complete


def test_how_it_ends_is_told_with_what_it_made_until_then(harness: RclHarness) -> None:
    outcomes = {}
    for mode in ("exit 0", "exit 7", "crash", "early"):
        found = harness.trace(mode)
        outcomes[mode] = found.outcome.status, found.outcome.exit_code, found.outcome.signal
        assert set(ends(found)) == (set() if mode == "early" else set(ALL))
    assert outcomes == {
        "exit 0": ("exited", 0, None),
        "exit 7": ("crashed", 7, None),
        "crash": ("crashed", None, "SIGABRT"),
        "early": ("crashed", None, "SIGABRT"),
    }


def test_parameters_are_those_that_the_client_library_publishes(harness: RclHarness) -> None:
    found = harness.trace("declare", "<param name='count' value='3'/>")
    assert {name: (use.type, use.default, use.has_default) for name, use in uses(found).items()} == {
        "~on": ("bool", True, True),
        "~count": ("integer", None, False),  # what is seen is the value that it was given
        "~rate": ("double", 10.0, True),
        "~frame.id": ("string", 'a"b', True),
        "~gains": ("double array", [0.25, 3.0], True),
        "~frames": ("string array", ["map", "base"], True),
        "~typed": (None, None, False),
        "~odd": ("double", None, False),
    }
    assert isinstance(uses(found)["~rate"].default, float)
    assert [use.name for use in found.params if use.builtin] == ["~use_sim_time"]


def test_a_parameter_that_is_not_declared_is_told_only_where_they_are_known(harness: RclHarness) -> None:
    launch = "<node pkg='cpkg' exec='node' name='n' args='{}'><param name='rte' value='1.0'/></node>"
    (finding,) = [f for f in harness.check(launch.format("declare")).findings if f.rule == "PRM013"]
    assert "rate" in finding.message
    assert "PRM013" not in {f.rule for f in harness.check(launch.format("ends")).findings}


@pytest.mark.parametrize(("topic", "space", "found"), [("chatter", "", 0), ("chater", "", 1), ("chatter", "robot", 1)])
def test_check_says_which_topics_of_two_nodes_do_not_meet(
    harness: RclHarness, topic: str, space: str, found: int
) -> None:
    harness.launch_file.write_text(
        "<launch><node pkg='cpkg' exec='node' name='talker' args='talk chatter'/>"
        f"<node pkg='cpkg' exec='node' name='listener' args='listen {topic}' namespace='{space}'/></launch>"
    )
    command = [
        str(Path(sys.executable).with_name("ros-preflight")),
        "check",
        str(harness.launch_file),
        "--format",
        "json",
    ]
    told = subprocess.run(command, env=harness.variables, capture_output=True, text=True, check=False)
    findings = json.loads(told.stdout)["findings"]
    assert [(f["rule"], f["confidence"]) for f in findings] == [("TOP001", "likely")] * found
    assert all("did you mean '/chatter', published by /talker" in f["message"] for f in findings)


def test_a_trace_is_kept_until_the_name_a_parameter_or_the_program_changes(harness: RclHarness) -> None:
    harness.cache = TraceCache(harness.folder / "cache")
    assert not harness.trace("talk a").cached
    assert harness.trace("talk a", "<remap from='a' to='b'/>").cached
    assert not harness.trace("talk a", attributes="name='m'").cached
    # rcl does not tell which parameters the node looks at.
    assert not harness.trace("talk a", "<param name='rate' value='1.0'/>").cached
    assert harness.trace("talk a", "<param name='rate' value='1.0'/>").cached
    assert not harness.trace("talk a", "<param name='rate' value='2.0'/>").cached
    with harness.program.open("ab") as file:
        file.write(b"more")
    assert not harness.trace("talk a").cached


SOURCE = """#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/string.hpp"
int main(int argc, char ** argv) {
  rclcpp::init(argc, argv);
  auto node = rclcpp::Node::make_shared("own");
  auto chatter = node->create_publisher<std_msgs::msg::String>("chatter", 10);
  auto other = node->create_publisher<std_msgs::msg::String>("other", 10);
  node->declare_parameter("rate", 10.0);
  rclcpp::spin(node);
}
"""


def with_source(harness: RclHarness) -> str:
    """Put a source of the program beside it, which says more than the program does."""
    package = harness.folder / "src" / "cpkg"
    package.mkdir(parents=True)
    (package / "package.xml").write_text((harness.launch_file.parent.parent / "package.xml").read_text())
    (package / "CMakeLists.txt").write_text(
        "add_executable(node node.cpp)\ninstall(TARGETS node DESTINATION lib/cpkg)\n"
    )
    (package / "node.cpp").write_text(SOURCE)
    return str(package / "node.cpp")


def test_a_trace_wins_over_the_source_which_says_where_things_are_made(tmp_path: Path) -> None:
    harness = RclHarness(tmp_path)
    source = with_source(harness)
    found = harness.trace("talk chatter")
    places = {key: (end.source_file, end.source_line, end.evidence.inferred) for key, end in ends(found).items()}
    assert (found.source, places) == ("trace", {("publisher", "chatter"): (source, 6, False)})
    # Of parameters rcl knows nothing.
    rate = uses(found)["~rate"]
    assert (rate.default, rate.evidence.inferred, rate.source_line) == (10.0, True, 8)
    given = uses(harness.trace("declare", "<param name='rate' value='2.0'/>"))
    rate, frames = given["~rate"], given["~frames"]
    assert (rate.default, rate.evidence.inferred, rate.source_line) == (10.0, False, 8)
    assert (frames.default, frames.type, frames.source_line) == (["map", "base"], "string array", None)


@pytest.mark.parametrize(
    ("body", "reason"),
    [
        ("exit 0", "it does not use rcl, or not within the time that it was given"),
        ("exit 127", "it cannot be loaded here: it ended with exit code 127"),
    ],
)
def test_of_a_program_without_rcl_the_source_is_read(tmp_path: Path, body: str, reason: str) -> None:
    harness = RclHarness(tmp_path)
    with_source(harness)
    compiled = ["cc", "-x", "c", "-", "-o", str(harness.program)]
    subprocess.run(compiled, input=f"int main(void) {{ return {body.split()[1]}; }}", text=True, check=True)
    found = harness.trace("")
    assert (found.source, found.outcome.status, found.outcome.reason) == ("source", "not-run", reason)
    assert set(ends(found)) == {("publisher", "chatter"), ("publisher", "other")}


def test_a_program_that_could_not_be_loaded_is_run_again(tmp_path: Path) -> None:
    harness = RclHarness(tmp_path)
    harness.cache = TraceCache(tmp_path / "cache")
    library = tmp_path / "install/lib/library"
    compiled = ["cc", "-x", "c", "-", "-o", str(harness.program)]
    body = f'#include <unistd.h>\nint main(void) {{ return access("{library}", F_OK) ? 127 : 0; }}'
    subprocess.run(compiled, input=body, text=True, check=True)
    assert (harness.trace("").outcome.reason or "").startswith("it cannot be loaded here")
    library.touch()
    assert harness.trace("").outcome.reason == "it does not use rcl, or not within the time that it was given"


def test_without_a_compiler_the_source_is_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    harness = RclHarness(tmp_path)
    with_source(harness)
    monkeypatch.setattr(preload_compile, "COMPILERS", ("no-such-compiler",))
    lacking = Library(tmp_path / "cache", tmp_path / "absent", preload_compile.RCL)
    monkeypatch.setattr(preload, "library", lambda _: lacking)
    found = harness.trace("ends")
    assert found.source == "source"
    assert "there is no C++ compiler to watch rcl nodes with" in (found.outcome.reason or "")


@pytest.mark.parametrize("distribution", ["kilted", "jazzy"])
def test_types_of_cpp_are_known_as_those_of_c(tmp_path: Path, distribution: str) -> None:
    found = RclHarness(tmp_path, distribution, "rcl_types.cpp").trace("")
    assert found.outcome.status == "spinning"
    assert {key: end.type for key, end in ends(found).items()} == {
        ("client", "start"): "std_srvs/srv/Trigger",
        ("publisher", "after"): "std_msgs/msg/String",
    }
    assert uses(found)["~frames"].default == ["map", "base"]


def test_arguments_of_ros_that_are_wrong_end_the_node_and_it_says_so(harness: RclHarness) -> None:
    for given in ("--ros-args -r __ns:=/not-a-name --", "--ros-args --params-file /absent.yaml --"):
        outcome = harness.trace(f"ends {given}").outcome
        assert (outcome.status, outcome.exit_code) == ("crashed", 3)
        assert "error: " in (outcome.reason or "")


def test_a_container_is_run_as_any_other_node(tmp_path: Path) -> None:
    graph = (
        RclHarness(tmp_path).check("<node_container pkg='cpkg' exec='node' args='ends' name='box' namespace=''/>").graph
    )
    assert graph is not None
    assert (graph.processes[0].outcome.status, set(ends(graph.processes[0]))) == ("spinning", set(ALL))


@pytest.mark.parametrize("name", ["RMW_IMPLEMENTATION", "CYCLONEDDS_URI"])
def test_a_middleware_that_is_not_installed_is_not_asked_for(tmp_path: Path, name: str) -> None:
    harness = RclHarness(tmp_path)
    setting = f"<set_env name='{name}' value='rmw_cyclonedds_cpp'/>"
    analysis = harness.check(f"{setting}<node pkg='cpkg' exec='node' args='talk chatter' name='n'/>")
    assert analysis.graph is not None
    assert analysis.graph.processes[0].outcome.status == "spinning"
    found = {each.rule for each in analysis.findings if each.rule in ("PKG008", "TRC001")}
    assert found == ({"PKG008"} if name == "RMW_IMPLEMENTATION" else set())
