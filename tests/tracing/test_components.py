"""Composable nodes of ROS 2, each loaded by its container in the sandbox (`container_like.cpp`)."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.workspace.workspace import Analysis
from support.rcl_harness import ContainerHarness, rcl_node
from support.ros2_harness import ends, uses

pytestmark = pytest.mark.ros

TALKER = "<composable_node pkg='cpkg' plugin='cpkg::Talker' name='talker'/>"


@pytest.fixture(params=["kilted", "jazzy"])
def harness(request: pytest.FixtureRequest, tmp_path: Path) -> ContainerHarness:
    return ContainerHarness(tmp_path, request.param)


@pytest.fixture
def kilted(tmp_path: Path) -> ContainerHarness:
    return ContainerHarness(tmp_path)


@pytest.fixture
def outside(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder that is not of the workspace."""
    return tmp_path_factory.mktemp("outside")


def test_a_component_is_loaded_and_watched(harness: ContainerHarness) -> None:
    harness.component("Talker", "pub=chatter sub=~/state double=rate@1.5")
    found = harness.loaded("Talker")
    assert (found.source, found.outcome.status, found.outcome.answers, found.notes) == ("trace", "spinning", (), ())
    assert set(ends(found)) == {("publisher", "chatter"), ("subscriber", "~/state")}
    assert {name: (use.type, use.default) for name, use in uses(found).items()} == {"~rate": ("double", 1.5)}
    assert [(node.name, node.given, node.renamed) for node in found.nodes] == [("n", "own", True)]


def test_names_are_as_given_and_the_graph_applies_what_the_tag_says(kilted: ContainerHarness) -> None:
    kilted.component("Talker", "pub=chatter sub=~/state")
    component = (
        "<composable_node pkg='cpkg' plugin='cpkg::Talker' name='n' namespace='robot'><remap from='chatter' to='x'/>"
    )
    container = f"<node_container pkg='cpkg' exec='node' name='box' namespace='elsewhere'>{component}</composable_node>"
    graph = kilted.check(f"{container}</node_container>").graph
    assert graph is not None
    assert set(ends(graph.processes[1])) == {("publisher", "chatter"), ("subscriber", "~/state")}
    assert {"/robot/x", "/robot/n/state", "/elsewhere/of_the_container"} <= set(graph.topics)


def test_what_the_container_makes_is_its_own(kilted: ContainerHarness) -> None:
    kilted.component("Talker", "pub=chatter")
    graph = kilted.check(
        f"<node_container pkg='cpkg' exec='node' name='box' namespace=''>{TALKER}</node_container>"
    ).graph
    assert graph is not None
    box, talker = graph.processes
    assert {name for _, name in ends(box)} == {"of_the_container", "~/_container/load_node"}
    assert {name for _, name in ends(talker)} == {"chatter"}
    assert [node.name for node in box.nodes] == ["box"]


def test_a_component_that_the_launch_does_not_name(kilted: ContainerHarness) -> None:
    kilted.component("Talker", "pub=~/chatter")
    container = "<node_container pkg='cpkg' exec='node' name='box' namespace=''>"
    analysis = kilted.check(f"{container}<composable_node pkg='cpkg' plugin='cpkg::Talker'/></node_container>")
    assert [node.name for node in analysis.tree.nodes] == ["/box", "/own"]


@pytest.mark.parametrize("value", ["2.5", "-1.0", ".inf", ".nan"])
def test_parameters_reach_it_with_their_types(kilted: ContainerHarness, value: str) -> None:
    kilted.component("Talker", "mandatory=rate")
    others = "".join(f"<param name='p{at}' value='{each}'/>" for at, each in enumerate(("true", "7", "a", "[1, 2]")))
    found = kilted.loaded("Talker", f"{others}<param name='rate' value='{value}'/><param name='b' value='[1.5, 2.5]'/>")
    assert (found.outcome.status, found.outcome.reason) == ("spinning", None)
    assert uses(found)["~rate"].type == "double"


@pytest.mark.parametrize(
    ("steps", "params", "rule", "message"),
    [
        ("double=speed@1.0", {"speed": "fast"}, "PRM014", "parameter 'speed': got a string, /n declares a double"),
        ("percent=level", {"level": "300"}, "PRM017", "'level' is 300, which /n refuses"),
        ("mandatory=speed", {}, "PRM010", "required parameter 'speed' is not set; /n declares it without a default"),
    ],
)
def test_a_constructor_that_throws_tells_of_the_parameter(
    kilted: ContainerHarness, steps: str, params: dict[str, str], rule: str, message: str
) -> None:
    kilted.component("Talker", steps)
    inside = "".join(f"<param name='{name}' value='{value}'/>" for name, value in params.items())
    component = f"<composable_node pkg='cpkg' plugin='cpkg::Talker' name='n'>{inside}</composable_node>"
    launch = f"<node_container pkg='cpkg' exec='node' name='box' namespace=''>{component}</node_container>"
    findings = kilted.check(launch).findings
    assert {(f.rule, f.severity) for f in findings} == {(rule, "error"), ("TRC001", "info")}
    assert message in next(f.message for f in findings if f.rule == rule)


@pytest.mark.parametrize(
    ("steps", "inside", "reason"),
    [
        (
            "pub=before invalid=a-b",
            "",
            "its constructor threw an exception: Invalid topic name: topic name must not contain characters other "
            "than alphanumerics, '_', '~', '{', or '}': 'a-b' ^",
        ),
        ("pub=before abort", "", "it was killed by SIGABRT"),
        ("invalid=" + "\u20ac" * 700, "", "its constructor threw an exception: Invalid topic name"),
        (
            "pub=before",
            "<extra_arg name='use_intra_process' value='true'/>",
            "its container did not load it: Extra component argument 'use_intra_process' is not supported",
        ),
    ],
)
def test_how_it_fails_is_told(kilted: ContainerHarness, steps: str, inside: str, reason: str) -> None:
    kilted.component("Talker", steps)
    outcome = kilted.loaded("Talker", inside).outcome
    assert outcome.status == "crashed"
    assert (outcome.reason or "").startswith(reason)


def test_a_crash_costs_one_component(kilted: ContainerHarness) -> None:
    kilted.component("Talker", "pub=chatter")
    kilted.component("Crash", "abort")
    crash = "<composable_node pkg='cpkg' plugin='cpkg::Crash' name='c'/>"
    launch = f"<node_container pkg='cpkg' exec='node' name='box' namespace=''>{crash}{TALKER}</node_container>"
    graph = kilted.check(launch).graph
    assert graph is not None
    assert [each.outcome.status for each in graph.processes] == ["spinning", "crashed", "spinning"]


def test_a_library_that_lacks_another_one_is_not_told_against_it(kilted: ContainerHarness) -> None:
    kilted.component("Talker", "pub=chatter")
    (kilted.folder / "install/lib/libtalker.so").write_bytes(b"\x7fELF\x02 no library")
    outcome = kilted.loaded("Talker").outcome
    assert outcome.status == "not-run"
    assert (outcome.reason or "").startswith("it cannot be loaded here: Failed to load library: ")


@pytest.mark.parametrize("what", ["library", "program"])
def test_what_a_link_of_the_workspace_leads_to_is_not_run(kilted: ContainerHarness, what: str, outside: Path) -> None:
    kilted.component("Talker", "pub=chatter")
    path = kilted.folder / "install/lib/libtalker.so" if what == "library" else kilted.program
    path.rename(outside / path.name)
    path.symlink_to(outside / path.name)
    outcome = kilted.loaded("Talker").outcome
    assert outcome.status == "not-run"
    assert "lies outside of the workspace" in (outcome.reason or "")


@pytest.mark.parametrize("mode", ["none", "deaf"])
def test_a_container_that_does_not_load(kilted: ContainerHarness, mode: str) -> None:
    kilted.component("Talker", "pub=chatter")
    found = kilted.loaded("Talker", args=mode)
    assert (found.outcome.status, found.endpoints) == ("not-run", ())
    assert (found.outcome.reason or "").startswith("its container did not get to load it")


def test_a_constructor_that_takes_its_time(kilted: ContainerHarness) -> None:
    kilted.component("Slow", "sleep=2 pub=late")
    found = kilted.loaded("Slow")
    assert (found.outcome.status, set(ends(found))) == ("spinning", {("publisher", "late")})


@pytest.mark.parametrize("timers", ["after=0.15@pub:late", "after=0.05@double:rate@1 after=0.2@pub:late"])
def test_what_a_first_turn_of_a_timer_makes(kilted: ContainerHarness, timers: str) -> None:
    """As a constructor sets one for what it cannot do itself."""
    kilted.component("Later", f"pub=early {timers}")
    found = kilted.loaded("Later")
    assert (found.outcome.status, set(ends(found))) == ("spinning", {("publisher", "early"), ("publisher", "late")})


def test_a_timer_that_is_far_off_is_not_waited_for(kilted: ContainerHarness) -> None:
    kilted.component("Later", "pub=early after=60@pub:late")
    found = kilted.loaded("Later")
    assert (found.outcome.status, set(ends(found))) == ("spinning", {("publisher", "early")})


def test_a_node_that_comes_later(kilted: ContainerHarness) -> None:
    kilted.component("Later", "pub=early after=0.1@child:costmap@/n/costmap after=0.2@pub:map")
    graph = contained(kilted, "<composable_node pkg='cpkg' plugin='cpkg::Later' name='n'/>", "").graph
    assert graph is not None
    assert [node.name for node in graph.tree.nodes] == ["/box", "/n", "/n/costmap/costmap"]
    assert "/n/costmap/map" in graph.topics


def test_a_constructor_that_does_not_return(kilted: ContainerHarness) -> None:
    kilted.component("Stuck", "pub=early sleep=60")
    found = kilted.loaded("Stuck")
    assert (found.outcome.status, set(ends(found))) == ("timed-out", {("publisher", "early")})
    assert found.outcome.reason == "it waits for its constructor to return, and did not reach its event loop within 5 s"


def test_a_lifecycle_component_is_configured_and_activated(kilted: ContainerHarness) -> None:
    kilted.component("Managed", "managed")
    found = kilted.loaded("Managed")
    assert (found.outcome.status, found.outcome.answers) == ("spinning", ())
    assert set(ends(found)) == {("publisher", "made"), ("subscriber", "active")}


def test_nodes_that_a_component_makes_beside_itself(kilted: ContainerHarness) -> None:
    kilted.component("Server", "pub=plan double=rate@1.0 child=costmap@/n/costmap pub=map double=resolution@0.1")
    component = "<composable_node pkg='cpkg' plugin='cpkg::Server' name='n'><remap from='map' to='elsewhere'/>"
    component += "<param name='resolution' value='0.2'/></composable_node>"
    launch = f"<node_container pkg='cpkg' exec='node' name='box' namespace=''>{component}</node_container>"
    graph = kilted.check(launch).graph
    assert graph is not None
    by_name = dict(zip((node.name for node in graph.tree.nodes), graph.tree.nodes, strict=True))
    assert set(by_name) == {"/box", "/n", "/n/costmap/costmap"}
    assert by_name["/n/costmap/costmap"].params == ()
    assert {"/plan", "/n/costmap/map"} <= set(graph.topics)


def contained(harness: ContainerHarness, component: str, inside: str) -> Analysis:
    """All that is known of a container `/box` with this in its tag, and of its component."""
    return harness.check(
        f"<node_container pkg='cpkg' exec='node' name='box' namespace=''>{inside}{component}</node_container>"
    )


def test_the_arguments_of_its_container_count_for_what_a_component_makes(kilted: ContainerHarness) -> None:
    """As Nav2's bringup gives its costmaps their parameters."""
    kilted.component("Server", "pub=map double=resolution@0.1 child=costmap@/n/costmap pub=map double=resolution@0.1")
    section = "{ros__parameters: {resolution: 0.2}}"
    (kilted.folder / "p.yaml").write_text(f"/n/costmap/costmap: {section}\n/n: {section}\n")
    inside = f"<param from='{kilted.folder}/p.yaml'/><remap from='map' to='elsewhere'/>"
    analysis = contained(kilted, "<composable_node pkg='cpkg' plugin='cpkg::Server' name='n'/>", inside)
    assert analysis.graph is not None
    by_name = dict(zip((node.name for node in analysis.graph.tree.nodes), analysis.graph.tree.nodes, strict=True))
    given = {name: {param.name: param.value for param in node.params} for name, node in by_name.items()}
    assert given == {"/box": {}, "/n": {}, "/n/costmap/costmap": {"resolution": 0.2}}
    assert {"/map", "/n/costmap/elsewhere"} <= set(analysis.graph.topics)
    said = [finding.message for finding in analysis.findings if finding.rule in ("PRM008", "PRM011")]
    assert len(said) == 1 and said[0].startswith("section '/n' applies to no node"), "the component gets its own alone"


def test_a_parameter_of_its_container_for_what_a_component_makes(kilted: ContainerHarness) -> None:
    kilted.component("Server", "pub=plan child=costmap@/n/costmap double=resolution@0.1")
    (kilted.folder / "p.yaml").write_text("/**: {ros__parameters: {resolution: fine}}\n")
    component = "<composable_node pkg='cpkg' plugin='cpkg::Server' name='n'/>"
    findings = contained(kilted, component, f"<param from='{kilted.folder}/p.yaml'/>").findings
    (message,) = (finding.message for finding in findings if finding.rule == "PRM014")
    assert "parameter 'resolution': got a string, /n/costmap/costmap declares a double" in message


def test_the_name_of_its_container_is_for_other_nodes_of_a_component_too(kilted: ContainerHarness) -> None:
    """The ends of such a node are its own, and not those that the container itself makes."""
    kilted.component("Server", "pub=plan node=helper pub=help")
    graph = contained(kilted, "<composable_node pkg='cpkg' plugin='cpkg::Server' name='n'/>", "").graph
    assert graph is not None
    assert [node.name for node in graph.tree.nodes] == ["/box", "/n", "/box"]
    assert {name for _, name in ends(graph.processes[1])} == {"plan", "help"}


def test_global_arguments_that_are_forwarded(kilted: ContainerHarness) -> None:
    kilted.component("Talker", "pub=chatter sub=other double=rate@1.0 double=gain@1.0")
    (kilted.folder / "p.yaml").write_text("/**: {ros__parameters: {rate: 2.0, gain: much}}\n")
    inside = f"<param from='{kilted.folder}/p.yaml'/><remap from='chatter' to='x'/><remap from='other' to='y'/>"
    more = "<remap from='other' to='own'/><param name='rate' value='3.0'/>"
    forward = "<extra_arg name='forward_global_arguments' value='true'/>"
    for told, topics, wrong in ((forward, {"/x", "/own"}, ["gain"]), ("", {"/chatter", "/own"}, [])):
        component = f"<composable_node pkg='cpkg' plugin='cpkg::Talker' name='n'>{more}{told}</composable_node>"
        analysis = contained(kilted, component, inside)
        assert analysis.graph is not None
        assert topics <= set(analysis.graph.topics)
        refused = [finding.message.partition(";")[0] for finding in analysis.findings if finding.rule == "PRM014"]
        assert refused == [f"type mismatch of parameter '{name}': got a string, /n declares a double" for name in wrong]


def test_a_container_that_another_launch_starts(kilted: ContainerHarness) -> None:
    """That of rclcpp_components stands in."""
    kilted.component("Talker", "pub=chatter")
    index = kilted.folder / "install/share/ament_index/resource_index/packages/rclcpp_components"
    index.touch()
    program = kilted.folder / "install/lib/rclcpp_components/component_container"
    program.parent.mkdir()
    shutil.copy(kilted.program, program)
    manifest = kilted.folder / "install/share/rclcpp_components/package.xml"
    manifest.parent.mkdir()
    text = (kilted.folder / "install/share/cpkg/package.xml").read_text()
    manifest.write_text(text.replace("cpkg", "rclcpp_components"))
    graph = kilted.check(f"<load_composable_node target='/other'>{TALKER}</load_composable_node>").graph
    assert graph is not None
    assert set(ends(graph.processes[0])) == {("publisher", "chatter")}


def test_a_trace_is_kept_while_what_it_depends_on_is_the_same(kilted: ContainerHarness) -> None:
    kilted.cache = TraceCache(kilted.folder / "cache")
    kilted.component("Talker", "pub=chatter double=rate@1.0")
    rate = "<param name='rate' value='2.0'/>"
    assert not kilted.loaded("Talker").cached
    assert kilted.loaded("Talker").cached
    assert kilted.loaded("Talker", "<remap from='chatter' to='x'/>").cached
    assert not kilted.loaded("Talker", rate).cached
    assert kilted.loaded("Talker", rate).cached
    assert not kilted.loaded("Talker", f"{rate}<extra_arg name='use_intra_process_comms' value='true'/>").cached
    assert not kilted.loaded("Talker", args="other").cached
    kilted.component("Talker", "pub=chatter pub=more")
    assert set(ends(kilted.loaded("Talker"))) == {("publisher", "chatter"), ("publisher", "more")}


XML = """<launch>
  <node_container pkg="cpkg" exec="node" name="box" namespace="">
    <composable_node pkg="cpkg" plugin="cpkg::Talker" name="talker">
      <remap from="chatter" to="chater"/>
    </composable_node>
    <composable_node pkg="cpkg" plugin="cpkg::Driver" name="driver">
      <param name="speed" value="fast"/>
      <extra_arg name="use_intra_process_comms" value="true"/>
    </composable_node>
    <composable_node pkg="cpkg" plugin="cpkg::Managed" name="managed"/>
  </node_container>
  <node pkg="cpkg" exec="listener" name="listener" args="listen chatter"/>
</launch>
"""
YAML = """launch:
- node_container:
    pkg: cpkg
    exec: node
    name: box
    namespace: ""
    composable_node:
    - pkg: cpkg
      plugin: "cpkg::Talker"
      name: talker
      remap: [{from: chatter, to: chater}]
    - pkg: cpkg
      plugin: "cpkg::Driver"
      name: driver
      param: [{name: speed, value: fast}]
      extra_arg: [{name: use_intra_process_comms, value: "true"}]
    - {pkg: cpkg, plugin: "cpkg::Managed", name: managed}
- node: {pkg: cpkg, exec: listener, name: listener, args: listen chatter}
"""
PYTHON = """
from launch import LaunchDescription
from launch_ros.actions import ComposableNodeContainer, LoadComposableNodes, Node
from launch_ros.descriptions import ComposableNode


def generate_launch_description():
    talker = ComposableNode(
        package="cpkg", plugin="cpkg::Talker", name="talker", remappings=[("chatter", "chater")]
    )
    driver = ComposableNode(
        package="cpkg", plugin="cpkg::Driver", name="driver", parameters=[{"speed": "fast"}],
        extra_arguments=[{"use_intra_process_comms": True}],
    )
    managed = ComposableNode(package="cpkg", plugin="cpkg::Managed", name="managed")
    return LaunchDescription([
        ComposableNodeContainer(
            package="cpkg", executable="node", name="box", namespace="", composable_node_descriptions=[talker, driver]
        ),
        LoadComposableNodes(target_container="box", composable_node_descriptions=[managed]),
        Node(package="cpkg", executable="listener", name="listener", arguments=["listen", "chatter"]),
    ])
"""


EXPECTED = {("PRM014", "error"), ("TOP001", "warning"), ("LCH035", "info")}


def ask(harness: ContainerHarness, verb: str, launch_file: str) -> Any:
    """What the command says of a launch file."""
    line = [str(Path(sys.executable).with_name("ros-preflight")), verb, launch_file, "--format", "json"]
    line += ["--cache-dir", str(harness.folder / "cache")]
    done = subprocess.run(line, env=harness.variables, capture_output=True, text=True, check=False)
    return json.loads(done.stdout)


@pytest.mark.parametrize(
    ("file", "text"),
    [("c.launch.xml", XML), ("c.launch.yaml", YAML), ("c.launch.py", PYTHON)],
    ids=["xml", "yaml", "python"],
)
def test_a_container_of_three_components_in_each_format(kilted: ContainerHarness, file: str, text: str) -> None:
    """A wrong remap, a parameter of the wrong type and a lifecycle, with no source at hand."""
    kilted.component("Talker", "pub=chatter")
    kilted.component("Driver", "double=speed@1.0")
    kilted.component("Managed", "managed sub=chatter")
    shutil.copy(rcl_node(source="rcl_node.c"), kilted.program.with_name("listener"))
    launch_file = kilted.launch_file.with_name(file)
    launch_file.write_text(text)
    found = ask(kilted, "check", str(launch_file))
    assert {(each["rule"], each["severity"]) for each in found["findings"]} == EXPECTED
    messages = {each["rule"]: each["message"] for each in found["findings"]}
    assert "parameter 'speed': got a string, /driver declares a double" in messages["PRM014"]
    (wrong,) = (each for each in found["findings"] if each["rule"] == "PRM014")
    _, crash = wrong["related"]
    assert "not allowed" in crash["message"], "the crash stands behind its cause"
    topics = ask(kilted, "graph", str(launch_file))["topics"]
    assert topics["/chater"]["publishers"] == ["/talker"]
    assert topics["/chatter"]["subscribers"] == ["/listener", "/managed"]
    assert topics["/made"]["publishers"] == ["/managed"]
