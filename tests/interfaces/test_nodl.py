"""NoDL documents of packages: what a node that was not run does. And back: interfaces to documents."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.graph.model import Graph
from preflight_analysis.interfaces.nodl_read import read_nodl
from preflight_analysis.interfaces.nodl_write import nodl, nodl_files
from preflight_analysis.snapshot.difference import difference
from preflight_analysis.snapshot.make import snapshot_of
from preflight_analysis.tracing.interface import NOT_RUN, Endpoint, Interface, Outcome, ParamUse
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

DRIVER = """\
---
nodl_version: 2
description: The laser
include:
  - ref: local://common.nodl.yaml
  - ref: nodl://laser/more
  - ref: https://example.org/none
parameters:
  rate:
    type: double
    default_value: 10.0
  port:
    type: string
publishers:
  - name: scan
    type: sensor_msgs/LaserScan
    qos: {history: KEEP_LAST, depth: 5, reliability: BEST_EFFORT, durability: SYSTEM_DEFAULT}
service_servers:
  - {name: ~/reset, type: std_srvs/srv/Trigger}
action_clients:
  - {name: dock, type: nav_msgs/action/Dock}
"""
COMMON = """
nodl_version: 2
include: [{ref: 'local://driver.nodl.yaml'}]
subscriptions: [{name: /stop, type: std_msgs/msg/Empty, qos: {history: KEEP_ALL, reliability: SYSTEM_DEFAULT}}]
"""
MORE = '{"nodl_version": 2, "publishers": [{"name": "heat", "type": "std_msgs/msg/Float32", "qos": {}}, 5, {}]}'
VERSION_1 = """<interface version="1">
  <node name="other" executable="other"><topic name="x" type="std_msgs/msg/String" role="publisher"/></node>
  <node name="driver" executable="driver">
    <parameter name="verbose" type="bool"/>
    <topic name="scan" type="sensor_msgs/msg/LaserScan" role="both"/>
    <service name="reset" type="std_srvs/srv/Trigger" role="server"/>
    <action name="dock" type="nav_msgs/action/Dock" role="client"/>
  </node>
</interface>"""
MANIFEST = "<package><name>laser</name><export><build_type>ament_cmake</build_type></export></package>"
LAUNCH = '<launch><node pkg="laser" exec="driver" name="front" namespace="robot"/></launch>'
INSTALLED = "share/ament_index/resource_index"


def create_workspace(folder: Path, files: dict[str, str]) -> Workspace:
    for name, text in {"package.xml": MANIFEST, "launch/robot.launch.xml": LAUNCH, **files}.items():
        path = folder / "src/laser" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    environment = detect_environment(str(folder), {}, root=str(folder / "nothing"))
    return Workspace(environment, Sources())


def graph(workspace: Workspace, interface: Interface = NOT_RUN) -> Graph:
    assert workspace.environment.workspace is not None
    analysis = workspace.static(f"{workspace.environment.workspace}/src/laser/launch/robot.launch.xml")
    found = workspace.with_interfaces(analysis, [interface] * len(analysis.tree.nodes), "not run here").graph
    assert found is not None
    return found


def told(interface: Interface) -> list[tuple[str, str, str | None]]:
    return sorted((end.role, end.name, end.type) for end in interface.endpoints)


def test_the_document_of_an_executable_and_what_it_includes(tmp_path: Path) -> None:
    names = ("driver.nodl.yaml", "common.nodl.yaml", "more.nodl.json")
    files = {f"nodl/{name}": text for name, text in zip(names, (DRIVER, COMMON, MORE), strict=True)}
    found = graph(create_workspace(tmp_path, files))
    (interface,) = found.interfaces
    assert (interface.source, interface.complete) == ("nodl", True)
    assert told(interface) == [
        ("action_client", "dock", "nav_msgs/action/Dock"),
        ("publisher", "heat", "std_msgs/msg/Float32"),
        ("publisher", "scan", "sensor_msgs/msg/LaserScan"),
        ("service", "~/reset", "std_srvs/srv/Trigger"),
        ("subscriber", "/stop", "std_msgs/msg/Empty"),
    ]
    scan = found.topics["/robot/scan"].providers[0].endpoint
    assert dict(scan.qos) == {"reliability": "best_effort", "depth": 5}
    assert (scan.source_file or "").endswith("nodl/driver.nodl.yaml")
    assert DRIVER.splitlines()[(scan.source_line or 0) - 1].strip() == "- name: scan"
    assert {p.name: (p.default, p.mandatory) for p in interface.params} == {
        "~rate": (10.0, False),
        "~port": (None, True),
    }


@pytest.mark.parametrize(
    "place", ["nodl/driver.nodl.yaml", "driver.nodl.yaml", "nodl/driver.yaml", "nodl/Driver.nodl.yml"]
)
def test_places_of_a_document(tmp_path: Path, place: str) -> None:
    assert graph(create_workspace(tmp_path, {place: DRIVER})).interfaces[0].source == "nodl"


@pytest.mark.parametrize(
    "place", ["nodl/other.nodl.yaml", "driver.yaml", "nodl/driver.nodl.txt", "config/driver.nodl.yaml"]
)
def test_what_is_no_document_of_the_node(tmp_path: Path, place: str) -> None:
    assert graph(create_workspace(tmp_path, {place: DRIVER})).interfaces[0].source == "none"


def test_documents_of_the_ament_index(tmp_path: Path) -> None:
    index = tmp_path / "install/laser" / INSTALLED
    for name, text in (("packages/laser", ""), ("nodl/laser__driver", DRIVER), ("nodl/laser__more", MORE)):
        (index / name).parent.mkdir(parents=True, exist_ok=True)
        (index / name).write_text(text)
    (interface,) = graph(create_workspace(tmp_path, {})).interfaces
    assert interface.source == "nodl"
    assert ("publisher", "heat", "std_msgs/msg/Float32") in told(interface)


def test_version_1_names_its_executables(tmp_path: Path) -> None:
    (interface,) = graph(create_workspace(tmp_path, {"laser.nodl.xml": VERSION_1})).interfaces
    assert told(interface) == [
        ("action_client", "dock", "nav_msgs/action/Dock"),
        ("publisher", "scan", "sensor_msgs/msg/LaserScan"),
        ("service", "reset", "std_srvs/srv/Trigger"),
        ("subscriber", "scan", "sensor_msgs/msg/LaserScan"),
    ]
    assert [p.name for p in interface.params] == ["~verbose"]


def test_annotations_and_settings_count_before_and_the_source_after(tmp_path: Path) -> None:
    workspace = create_workspace(tmp_path, {"nodl/driver.nodl.yaml": DRIVER})
    launch = tmp_path / "src/laser/launch/robot.launch.xml"
    annotation = '<topics><topic name="a" type="b/C" class="pub"/></topics>'
    launch.write_text(LAUNCH.replace("/></launch>", f"><!-- {annotation} --></node></launch>"))
    workspace.refresh()
    assert graph(workspace).interfaces[0].source == "annotation"
    launch.write_text(LAUNCH)
    settings = "nodes: [{package: laser, executable: driver, topics: [{name: a, type: b/C, class: pub}]}]"
    (tmp_path / ".ros-preflight.yaml").write_text(settings)
    workspace.refresh()
    assert graph(workspace).interfaces[0].source == "settings"


def test_a_run_counts_before_and_a_crashed_one_is_added_to(tmp_path: Path) -> None:
    workspace = create_workspace(tmp_path, {"nodl/driver.nodl.yaml": DRIVER})
    seen = (Endpoint("publisher", "seen", "a/msg/B"),)
    assert graph(workspace, Interface("trace", Outcome("spinning"), seen)).interfaces[0].source == "trace"
    (interface,) = graph(workspace, Interface("trace", Outcome("crashed"), seen)).interfaces
    assert {end.name for end in interface.endpoints} == {"seen", "scan", "~/reset", "dock"}


def test_a_changed_document_is_read_again(tmp_path: Path) -> None:
    workspace = create_workspace(tmp_path, {"nodl/driver.nodl.yaml": DRIVER})
    graph(workspace)
    (tmp_path / "src/laser/nodl/driver.nodl.yaml").write_text(DRIVER.replace("name: scan", "name: front_scan"))
    workspace.refresh()
    assert ("publisher", "front_scan", "sensor_msgs/msg/LaserScan") in told(graph(workspace).interfaces[0])


@pytest.mark.parametrize(
    "text",
    [
        *(
            "",
            "5",
            "[",
            "- a",
            "nodl_version: 1",
            "\x00",
            "{nodl_version: 2, ? [a] : b}",
            "nodl_version: 2\npublishers: 7",
        ),
        "nodl_version: 2\nparameters: [a]\nsubscriptions: [a, {name: 5}]\ninclude: [x, {ref: 5}]",
        "nodl_version: 2\nparameters: {2: {}, a: 5}",
    ],
)
def test_rubbish_is_no_document(text: str) -> None:
    assert not any(said.endpoints or said.params for said in read_nodl("/x.nodl.yaml", text, 2))
    assert not any(said.endpoints or said.params for said in read_nodl("/x.nodl.xml", text, 2))


@pytest.mark.parametrize("type_", ["String", "/", "std_msgs/", ""])
def test_an_end_whose_type_is_none_stays_without_one(type_: str) -> None:
    (two,) = read_nodl("/x.nodl.yaml", f"nodl_version: 2\npublishers: [{{name: a, type: '{type_}'}}]", 2)
    one = VERSION_1.replace("std_msgs/msg/String", type_)
    for said in (two, read_nodl("/x.nodl.xml", one, 2)[0]):
        assert [(end.role, end.type) for end in said.endpoints] == [("publisher", None)]


def test_written_and_read_again_is_the_same(tmp_path: Path) -> None:
    files = {"nodl/driver.nodl.yaml": DRIVER}
    workspace = create_workspace(tmp_path / "a", files)
    written = nodl_files(graph(workspace))
    assert list(written) == ["laser/driver.nodl.yaml"]
    text = written["laser/driver.nodl.yaml"]
    assert "# Left out: parameter ~port: type not known\n" in text, "it has no default to tell it"
    again = create_workspace(tmp_path / "b", {"nodl/driver.nodl.yaml": text})
    one, other = (
        snapshot_of(w.static(f"{w.environment.workspace}/src/laser/launch/robot.launch.xml"), graph(w))
        for w in (workspace, again)
    )
    found = difference(one, other)
    assert [(c.kind, c.what, c.name) for c in found.changes] == [("removed", "read", "/robot/front/port")]
    assert found.links == ()


def test_a_document_reads_well() -> None:
    ends = (
        Endpoint("publisher", "chatter", "std_msgs/String", qos={"latch": True, "queue_size": 10}),
        Endpoint("subscriber", "~state", "std_msgs/String", qos={"queue_size": None}),
        Endpoint("subscriber", "anything", "*"),
        Endpoint("service", "~get_loggers", "roscpp/GetLoggers", builtin=True),
    )
    params = (
        *(ParamUse("~rate", "get", 5, True), ParamUse("~names", "get", ["a", "b"], True)),
        *(ParamUse("/use_sim_time", "get", False, True), ParamUse("~needed", "get", mandatory=True)),
    )
    text = nodl([Interface("trace", Outcome("spinning"), ends, params)], 1)
    assert text == (
        "---\n"
        "# Written by `ros-preflight snapshot --format nodl`; known by: trace.\n"
        "# Left out: parameter /use_sim_time: not its own\n"
        "# Left out: parameter ~needed: type not known\n"
        "# Left out: subscriber anything: type not known\n"
        "nodl_version: 2\n"
        "parameters:\n"
        "  names:\n"
        "    type: string_array\n"
        "    default_value:\n"
        "    - a\n"
        "    - b\n"
        "  rate:\n"
        "    type: int\n"
        "    default_value: 5\n"
        "publishers:\n"
        "- name: chatter\n"
        "  type: std_msgs/String\n"
        "  qos:\n"
        "    history: KEEP_LAST\n"
        "    depth: 10\n"
        "    reliability: RELIABLE\n"
        "    durability: TRANSIENT_LOCAL\n"
        "subscriptions:\n"
        "- name: ~/state\n"
        "  type: std_msgs/String\n"
        "  qos:\n"
        "    history: SYSTEM_DEFAULT\n"
        "    reliability: RELIABLE\n"
    )
    assert yaml.safe_load(text)["nodl_version"] == 2
