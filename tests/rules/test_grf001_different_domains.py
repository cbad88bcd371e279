"""GRF001: two nodes have ends of one name and cannot reach each other."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.build import build_graph
from preflight_analysis.rules.registry import run_rules
from support.check import check, findings_of, interfaces_of
from support.python_launch_harness import PythonHarness

SCAN = {"/laser": {"publishers": {"scan": "x/msg/Y"}}, "/mapper": {"subscribers": {"scan": "x/msg/Y"}}}
ROS2 = (
    "<launch>{first}<node pkg='p' exec='laser' name='laser'>{laser}</node>"
    "{between}<node pkg='p' exec='m' name='mapper'>{mapper}</node>{last}</launch>"
)
ROS1 = ROS2.replace("exec=", "type=")
PYTHON = """
from launch import LaunchDescription
from launch_ros.actions import Node

def generate_launch_description():
    return LaunchDescription([
        Node(package='p', executable='laser', name='laser', additional_env={'ROS_DOMAIN_ID': '5'}),
        Node(package='p', executable='m', name='mapper'),
    ])
"""


def found(text: str, file: str = "/r.launch.xml", interfaces: object = SCAN, **parts: str) -> list[Finding]:
    names = ("first", "laser", "between", "mapper", "last")
    launch = text.format(**{name: parts.get(name, "") for name in names}) if "{first}" in text else text
    findings = findings_of(f"//- {file}\n{launch}\n//- interfaces\n{json.dumps(interfaces)}")
    return [each for each in findings if each.rule == "GRF001"]


def env(name: str, value: str, tag: str = "env") -> str:
    return f"<{tag} name='{name}' value='{value}'/>"


def test_another_domain_is_reported_at_its_setting() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="laser" name="laser">
            <env name="ROS_DOMAIN_ID" value="5"/>
                                             ^ warning[GRF001] '/scan' is not shared: /laser has ROS_DOMAIN_ID 5
          </node>
          <node pkg="p" exec="mapper" name="mapper"/>
        </launch>
        //- interfaces
        {"/laser": {"publishers": {"scan": "x/msg/Y"}}, "/mapper": {"subscribers": {"scan": "x/msg/Y"}}}
    """)


def test_one_finding_for_two_nodes_and_a_setting_before_one_of_them() -> None:
    interfaces = {
        "/laser": {"publishers": {"scan": "x/msg/Y"}, "services": {"reset": "x/srv/R"}},
        "/mapper": {"subscribers": {"scan": "x/msg/Y"}, "clients": {"reset": "x/srv/R"}},
    }
    (finding,) = found(ROS2, interfaces=interfaces, between=env("ROS_DOMAIN_ID", "7", "set_env"))
    message = "'/scan' and 1 more are not shared: /laser has ROS_DOMAIN_ID 0, /mapper has 7"
    assert (finding.message, finding.confidence) == (message, "likely")


def test_two_middlewares() -> None:
    (finding,) = found(
        ROS2,
        laser=env("RMW_IMPLEMENTATION", "rmw_zenoh_cpp"),
        mapper=env("RMW_IMPLEMENTATION", "rmw_cyclonedds_cpp"),
    )
    assert finding.message.startswith("'/scan' is not shared: /laser has RMW_IMPLEMENTATION rmw_zenoh_cpp")
    assert finding.severity == "warning"


def test_two_vendors_of_dds_are_information() -> None:
    (finding,) = found(
        ROS2,
        laser=env("RMW_IMPLEMENTATION", "rmw_fastrtps_cpp"),
        mapper=env("RMW_IMPLEMENTATION", "rmw_cyclonedds_cpp"),
    )
    assert finding.message.startswith("'/scan' is not shared reliably: /laser has RMW_IMPLEMENTATION rmw_fastrtps_cpp")
    assert finding.severity == "info"


def test_discovery_that_is_off() -> None:
    (finding,) = found(ROS2, laser=env("ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF"))
    message = "'/scan' is not shared: /laser has ROS_AUTOMATIC_DISCOVERY_RANGE OFF, /mapper has the default"
    assert finding.message == message


def test_the_fix_gives_both_the_same_value() -> None:
    (finding,) = found(ROS2, laser=env("ROS_DOMAIN_ID", "5"))
    assert [fix.title for fix in finding.fixes] == ["Replace '5' with '0'"]


def test_a_setting_in_a_group() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="laser" name="laser"/>
          <group>
            <set_env name="ROS_DOMAIN_ID" value="5"/>
                                                 ^ warning[GRF001] '/scan' is not shared: /laser has ROS_DOMAIN_ID 0
            <node pkg="p" exec="mapper" name="mapper"/>
          </group>
        </launch>
        //- interfaces
        {"/laser": {"publishers": {"scan": "x/msg/Y"}}, "/mapper": {"subscribers": {"scan": "x/msg/Y"}}}
    """)


BRIDGED = """
topics:
  {topic}:
    type: x/msg/Y
    from_domain: 5
    to_domain: 0
"""


@pytest.mark.parametrize(("topic", "shared"), [("scan", True), ("/scan", True), ("odom", False)])
def test_a_bridge_whose_topics_are_known(topic: str, shared: bool) -> None:
    bridge = "<node pkg='domain_bridge' exec='domain_bridge' name='b' args='/bridge.yaml'/>"
    launch = ROS2.format(first="", laser=env("ROS_DOMAIN_ID", "5"), between="", mapper="", last=bridge)
    files = f"//- /r.launch.xml\n{launch}\n//- /bridge.yaml\n{BRIDGED.format(topic=topic)}"
    findings = findings_of(f"{files}\n//- interfaces\n{json.dumps({**SCAN, '/b': {}})}")
    assert bool([each for each in findings if each.rule == "GRF001"]) != shared


def test_components_are_in_the_domain_of_their_container() -> None:
    text = (
        "<launch><node_container pkg='p' exec='c' name='c' namespace='/'><env name='ROS_DOMAIN_ID' value='5'/>"
        "<composable_node pkg='p' plugin='p::Laser' name='laser'/></node_container>"
        "<node pkg='p' exec='m' name='mapper'/></launch>"
    )
    (finding,) = found(text, interfaces={**SCAN, "/c": {}})
    assert "/laser has ROS_DOMAIN_ID 5" in finding.message


@pytest.mark.ros
def test_python(tmp_path: Path) -> None:
    harness = PythonHarness(tmp_path)
    path = harness.write("launch/a.launch.py", PYTHON)
    context = harness.launch(path).context
    graph = build_graph(context.tree, interfaces_of(context.tree, SCAN))
    (finding,) = [each for each in run_rules(replace(context, graph=graph)) if each.rule == "GRF001"]
    assert finding.message == "'/scan' is not shared: /laser has ROS_DOMAIN_ID 5, /mapper has 0"
    assert context.text(finding.location) == "5"


def test_another_master() -> None:
    (finding,) = found(ROS1, "/r.launch", laser=env("ROS_MASTER_URI", "http://localhost:11312"))
    assert "/laser has ROS_MASTER_URI http://localhost:11312, /mapper has http://localhost:11311" in finding.message


@pytest.mark.silent
@pytest.mark.parametrize(
    "parts",
    [
        {},
        {"laser": env("ROS_DOMAIN_ID", "0")},
        {"first": env("ROS_DOMAIN_ID", "5", "set_env")},
        {"laser": env("ROS_DOMAIN_ID", "5"), "last": "<node pkg='domain_bridge' exec='domain_bridge' name='b'/>"},
        {"laser": env("ROS_DOMAIN_ID", "5"), "last": "<node pkg='p' exec='laser' name='laser2'/>"},
        {"laser": env("ROS_DOMAIN_ID", "$(env NOT_SET)")},
        {"laser": env("RMW_IMPLEMENTATION", "rmw_cyclonedds_cpp")},
        {"laser": env("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")},
    ],
)
def test_nodes_that_share_or_of_which_it_is_not_known(parts: dict[str, str]) -> None:
    others = {"/laser2": SCAN["/laser"]} if "laser2" in parts.get("last", "") else {}
    assert found(ROS2, interfaces={**SCAN, **others}, **parts) == []


@pytest.mark.silent
def test_a_master_that_may_be_the_same() -> None:
    assert found(ROS1, "/r.launch", laser=env("ROS_MASTER_URI", "http://robot:11311")) == []
