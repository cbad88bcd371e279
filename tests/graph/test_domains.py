"""Ends of one name in domains that cannot reach each other do not meet in the graph, nor for any rule."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import pytest
from preflight_analysis.graph.graph_json import graph_json
from preflight_analysis.graph.model import Graph
from support.check import analyse, findings_of, read_fixture

LAUNCH = """<launch>
<group><set_env name="ROS_DOMAIN_ID" value="{one}"/>
<node pkg="p" exec="a" name="a"/><node pkg="p" exec="b" name="b"/></group>
<group><set_env name="ROS_DOMAIN_ID" value="{two}"/>
<node pkg="p" exec="c" name="c"/><node pkg="p" exec="d" name="d"/></group>
{more}</launch>"""
QOS = {"scan": {"reliability": "best_effort", "durability": "volatile"}}
STRICT = {"scan": {"reliability": "reliable", "durability": "volatile"}}
TWO_ROBOTS: Mapping[str, Any] = {
    "/a": {"publishers": {"scan": "x/msg/Y"}, "services": {"reset": "x/srv/R"}, "qos": QOS},
    "/b": {"subscribers": {"scan": "x/msg/Y"}, "qos": QOS},
    "/c": {"publishers": {"scan": "x/msg/Z"}, "services": {"reset": "x/srv/R"}, "qos": STRICT},
    "/d": {"subscribers": {"scan": "x/msg/Z"}, "qos": STRICT},
}


def fixture(one: str, two: str, more: str = "", interfaces: Mapping[str, Any] = TWO_ROBOTS) -> str:
    launch = LAUNCH.format(one=one, two=two, more=more)
    return f"//- /r.launch.xml\n{launch}\n//- interfaces\n{json.dumps(interfaces)}"


def graph_of(text: str) -> Graph:
    graph = analyse(read_fixture(text)).graph
    assert graph is not None
    return graph


def ends(graph: Graph) -> dict[str, list[str]]:
    return {
        key: [each.node.name for each in (*channel.providers, *channel.consumers)]
        for key, channel in {**graph.topics, **graph.services}.items()
    }


def test_each_domain_has_its_own_channels() -> None:
    graph = graph_of(fixture("1", "2"))
    assert ends(graph) == {
        "/scan": ["/a", "/b"],
        "/scan (ROS_DOMAIN_ID 2)": ["/c", "/d"],
        "/reset": ["/a"],
        "/reset (ROS_DOMAIN_ID 2)": ["/c"],
    }
    assert [each.types for each in graph.named("topics", "/scan")] == [("x/msg/Y",), ("x/msg/Z",)]
    topics = graph_json(graph)["topics"]
    assert topics["/scan (ROS_DOMAIN_ID 2)"]["name"] == "/scan"
    assert topics["/scan (ROS_DOMAIN_ID 2)"]["domain"] == "ROS_DOMAIN_ID 2"
    assert "domain" not in topics["/scan"]


def test_one_domain_has_the_channels_of_before() -> None:
    assert ends(graph_of(fixture("2", "02"))) == {"/scan": ["/a", "/c", "/b", "/d"], "/reset": ["/a", "/c"]}


@pytest.mark.parametrize(
    ("domains", "rules"),
    [(("1", "2"), set()), (("1", "1"), {"QOS001", "TOP003", "SRV003"})],
)
def test_rules_do_not_compare_what_is_in_other_domains(domains: tuple[str, str], rules: set[str]) -> None:
    compared = {"QOS001", "TOP001", "TOP003", "TOP005", "SRV001", "SRV003", "GRF001"}
    assert {each.rule for each in findings_of(fixture(*domains))} & compared == rules


def test_a_near_name_in_another_domain_is_not_meant() -> None:
    interfaces = {"/a": {"publishers": {"chatter": "x/msg/Y"}}, "/d": {"subscribers": {"chater": "x/msg/Y"}}}
    same, other = (findings_of(fixture("1", two, interfaces={**interfaces, "/b": {}, "/c": {}})) for two in "12")
    assert [each.message for each in same if "chatter" in each.message and "did you mean" in each.message]
    assert not [each.message for each in other if "did you mean" in each.message]


def test_a_node_whose_domain_is_not_known_joins() -> None:
    more = '<load_composable_node target="/elsewhere"><composable_node pkg="p" plugin="p::E" name="e"/>'
    more += "</load_composable_node>"
    interfaces = {**TWO_ROBOTS, "/e": {"subscribers": {"scan": "x/msg/Y"}}}
    graph = graph_of(fixture("1", "2", more, interfaces))
    assert len(graph.named("topics", "/scan")) == 1
    assert len(graph.named("services", "/reset")) == 2


def test_the_clock_of_another_domain() -> None:
    param = '<set_parameter name="use_sim_time" value="true"/>'
    text = fixture("1", "2", interfaces={"/a": {"publishers": {"/clock": "rosgraph_msgs/msg/Clock"}}})
    found = findings_of(text.replace("<launch>", f"<launch>{param}"))
    assert [each.message for each in found if each.rule == "PRM015"] == [
        "'use_sim_time' is true for /c, which has ROS_DOMAIN_ID 2; '/clock' is published with 1"
    ]
