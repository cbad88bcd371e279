"""Chains from publisher to subscriber: each kind of link breaks once and holds once."""

from __future__ import annotations

import json
from collections.abc import Mapping
from inspect import cleandoc
from typing import Any

import pytest
from preflight_analysis.queries.why import Chain, NoSuchNodeError, chains
from preflight_analysis.queries.why_started import Start, why_started
from support.query_harness import at_cursor

ROS1 = '<launch><node pkg="p" type="a" name="a">{a}</node><node pkg="p" type="b" name="b">{b}</node></launch>'
ROS2 = '<launch>{first}<node pkg="p" exec="a" name="a">{a}</node><node pkg="p" exec="b" name="b">{b}</node></launch>'
TALKS: Mapping[str, Any] = {"/a": {"publishers": {"chatter": "x/Y"}}, "/b": {"subscribers": {"chatter": "x/Y"}}}


def found(text: str, interfaces: Mapping[str, Any], channel: str | None = None) -> tuple[Chain, ...]:
    analysis = at_cursor(f"{text}\n//- interfaces\n{json.dumps(interfaces)}").analysis
    assert analysis.graph is not None
    return chains(analysis, analysis.graph, "a", "b", channel)


def only(text: str, interfaces: Mapping[str, Any] = TALKS, channel: str | None = None) -> Chain:
    (chain,) = found(text, interfaces, channel)
    return chain


def ros1(a: str = "", b: str = "") -> str:
    return f"//- /main.launch\n{ROS1.format(a=a, b=b)}"


def ros2(a: str = "", b: str = "", first: str = "") -> str:
    return f"//- /main.launch.xml\n{ROS2.format(a=a, b=b, first=first)}"


def broken(chain: Chain) -> tuple[str, str] | None:
    return (chain.broken.about, chain.broken.text) if chain.broken is not None else None


def test_two_nodes_that_talk() -> None:
    chain = only(ros1())
    assert (chain.kind, chain.channel, chain.provider, chain.consumer) == ("topics", "/chatter", "/a", "/b")
    assert broken(chain) is None
    assert [link.about for link in chain.links] == ["started", "endpoint", "started", "endpoint", "name", "type"]


def test_the_order_of_the_nodes_does_not_matter() -> None:
    chain = only(ros1(), {"/a": TALKS["/b"], "/b": TALKS["/a"]})
    assert (chain.provider, chain.consumer, broken(chain)) == ("/b", "/a", None)


def test_a_remap_on_one_side() -> None:
    chain = only(ros1(b='<remap from="chatter" to="chater"/>'))
    assert broken(chain) == ("name", "'/chatter' and '/chater' are different topic names")
    assert chain.broken is not None
    assert [fix.title for fix in chain.broken.fixes] == ["Replace 'chater' with 'chatter'"]
    assert chain.broken.location is not None
    (remapped,) = (link for link in chain.links if "remapped" in link.text)
    assert remapped.text == "/b subscribes to 'chatter', remapped to '/chater'"
    assert remapped.location == chain.broken.location


def test_types() -> None:
    chain = only(ros1(), {**TALKS, "/b": {"subscribers": {"chatter": "x/Z"}}})
    assert broken(chain) == ("type", "types differ: /a uses x/Y, /b uses x/Z")


def test_a_type_that_is_not_known_is_no_broken_link() -> None:
    chain = only(ros1(), {**TALKS, "/b": {"subscribers": {"chatter": None}}})
    assert (broken(chain), chain.unknown) == (None, 1)


@pytest.mark.parametrize(
    ("offered", "requested", "text"),
    [
        ("best_effort", "reliable", "QoS reliability: /a offers best effort, /b requests reliable"),
        ("reliable", "best_effort", None),
    ],
)
def test_qos(offered: str, requested: str, text: str | None) -> None:
    sides = {"/a": ("publishers", offered), "/b": ("subscribers", requested)}
    interfaces = {
        node: {
            side: {"chatter": "x/msg/Y"},
            "qos": {"chatter": {"reliability": setting, "durability": "volatile"}},
        }
        for node, (side, setting) in sides.items()
    }
    chain = only(ros2(), interfaces)
    assert broken(chain) == (("qos", text) if text is not None else None)
    assert [link.state for link in chain.links if link.about == "qos"] == ["broken" if text else "ok", "ok"]


def test_another_domain() -> None:
    chain = only(ros2(b='<env name="ROS_DOMAIN_ID" value="7"/>'))
    assert broken(chain) == ("environment", "ROS_DOMAIN_ID differs: /a has 0, /b has 7")


def test_one_domain_for_all() -> None:
    assert broken(only(ros2(first='<set_env name="ROS_DOMAIN_ID" value="7"/>'))) is None


def test_a_master_of_its_own() -> None:
    chain = only(ros1(a='<env name="ROS_MASTER_URI" value="http://localhost:11312"/>'))
    assert broken(chain) == (
        "environment",
        "ROS_MASTER_URI differs: /a has http://localhost:11312, /b has http://localhost:11311",
    )


def test_a_master_that_may_be_the_same() -> None:
    chain = only(ros1(a='<env name="ROS_MASTER_URI" value="http://other:11311"/>'))
    assert [(link.state, link.text) for link in chain.links if link.about == "environment"] == [
        ("unknown", "ROS_MASTER_URI differs: /a has http://other:11311, /b has http://localhost:11311")
    ]


def test_the_place_of_a_domain_and_its_fix() -> None:
    first = '<group><set_env name="ROS_DOMAIN_ID" value="7"/><node pkg="p" exec="a" name="a"/></group>'
    text = f'//- /main.launch.xml\n<launch>{first}<node pkg="p" exec="b" name="b"/></launch>'
    chain = only(text)
    assert chain.broken is not None
    assert chain.broken.location is not None
    at = chain.broken.location.span
    assert text.partition("\n")[2][at.start : at.end] == "7"
    assert [fix.title for fix in chain.broken.fixes] == ["Replace '7' with '0'"]


@pytest.mark.parametrize(
    ("args", "state", "end"),
    [("/bridge.yaml", "ok", "; a bridge carries '/chatter'"), ("/none.yaml", "unknown", "; a bridge may connect them")],
)
def test_a_bridge_between_domains(args: str, state: str, end: str) -> None:
    bridge = f'<node pkg="domain_bridge" exec="domain_bridge" name="bridge" args="{args}"/>'
    files = "\n//- /bridge.yaml\ntopics: {chatter: {type: x/msg/Y, from_domain: 0, to_domain: 7}}"
    chain = only(ros2(b='<env name="ROS_DOMAIN_ID" value="7"/>', first=bridge) + files)
    (link,) = (link for link in chain.links if link.about == "environment")
    assert (link.state, link.text) == (state, f"ROS_DOMAIN_ID differs: /a has 0, /b has 7{end}")


@pytest.mark.parametrize(
    ("text", "namespaces", "conditions"),
    [
        (
            """
            //- /main.launch
            <launch><arg name="sim" default="true"/><group ns="robot" if="$(arg sim)">
            <node pkg="p" type="a" name="a" ns="front"/></group>
            <include file="/part.launch" ns="robot"><arg name="on" value="false"/></include></launch>
            //- /part.launch
            <launch><arg name="on"/><node pkg="p" type="b" name="b" unless="$(arg on)"/></launch>""",
            ["/a is in the namespace 'robot'", "/a is in the namespace 'front'", "/b is in the namespace 'robot'"],
            [
                '/a is started under the condition if="$(arg sim)"',
                '/b is started under the condition unless="$(arg on)"',
            ],
        ),
        (
            """
            //- /main.launch.xml
            <launch><arg name="sim" default="true"/><group><push_ros_namespace namespace="robot"/>
            <node pkg="p" exec="a" name="a" namespace="" if="$(var sim)"/></group>
            <group><node pkg="p" exec="b" name="b" namespace="robot"/><push_ros_namespace namespace="late"/></group>
            </launch>""",
            ["/a is in the namespace 'robot'", "/b is in the namespace 'robot'"],
            ['/a is started under the condition if="$(var sim)"'],
        ),
    ],
)
def test_what_stands_around_the_nodes(text: str, namespaces: list[str], conditions: list[str]) -> None:
    talker = "/robot/front/a" if "front" in text else "/robot/a"
    (chain,) = found(cleandoc(text), {talker: TALKS["/a"], "/robot/b": TALKS["/b"]})
    texts = [link.text.replace("/robot/front", "").replace("/robot/", "/") for link in chain.links]
    assert [text for text in texts if "in the namespace" in text] == namespaces
    assert [text for text in texts if "under the condition" in text] == conditions


def test_nodes_on_two_clocks() -> None:
    clock = {"/a": {"publishers": {"chatter": "x/Y"}}, "/b": TALKS["/b"], "/sim": {"publishers": {"/clock": "r/C"}}}
    first = '<node pkg="p" exec="sim" name="sim"/>'
    chain = only(ros2(b='<param name="use_sim_time" value="true"/>', first=first), clock)
    assert [(link.state, link.text) for link in chain.links if link.about == "clock"] == [
        ("unknown", "/b uses simulated time, /a does not: their times differ"),
        ("ok", "/b uses simulated time; /clock is published by /sim"),
    ]


def test_a_simulator_publishes_the_clock_as_the_rules_have_it() -> None:
    first = '<node pkg="gazebo_ros" exec="gzserver" name="gz"/><set_parameter name="use_sim_time" value="true"/>'
    chain = only(ros2(first=first), {**TALKS, "/gz": {}})
    assert [(link.state, link.text) for link in chain.links if link.about == "clock"] == [
        ("ok", "/b uses simulated time; /clock is published by /gz")
    ]


def test_a_node_that_crashes() -> None:
    crashed = {"status": "crashed", "reason": "KeyError: 'rate'", **TALKS["/a"]}
    chain = only(ros1(), {**TALKS, "/a": crashed})
    assert broken(chain) == ("interface", "/a crashes on start: KeyError: 'rate'")


def test_a_node_of_which_nothing_is_known() -> None:
    chain = only(ros1(), {"/b": TALKS["/b"]})
    assert broken(chain) == ("endpoint", "no endpoint of /b fits the other; it subscribes to /chatter")
    assert {link.about: link.state for link in chain.links}["interface"] == "unknown"


def test_simulated_time_without_a_clock() -> None:
    chain = only(ros2(b='<param name="use_sim_time" value="true"/>'))
    *_, clock = (link for link in chain.links if link.about == "clock")
    assert (clock.state, clock.text) == (
        "unknown",
        "/b uses simulated time, and no node of this launch publishes /clock",
    )


def test_a_chain_for_each_topic_that_they_share() -> None:
    ends = {"one": "x/Y", "two": "x/Y", "three": "x/Y"}
    both = {"/a": {"publishers": ends}, "/b": {"subscribers": ends}}
    assert [chain.channel for chain in found(ros1(), both)] == ["/one", "/three", "/two"]
    assert [chain.channel for chain in found(ros1(), both, "two")] == ["/two"]


def test_services() -> None:
    chain = only(ros1(), {"/a": {"services": {"reset": "x/R"}}, "/b": {"clients": {"~reset": "x/R"}}})
    assert (chain.kind, broken(chain)) == ("services", ("name", "'/reset' and '/b/reset' are different service names"))


def test_a_node_that_is_not_there() -> None:
    analysis = at_cursor(f"{ros1()}\n//- interfaces\n{{}}").analysis
    assert analysis.graph is not None
    with pytest.raises(NoSuchNodeError) as raised:
        chains(analysis, analysis.graph, "a", "/talker")
    assert raised.value.near == ()


CONDITION = """
//- /main.launch
<launch>
  <arg name="sim" default="false"/>
  <group if="$(arg sim)"><include file="/more.launch"/></group>
  <node pkg="p" type="a" name="base" unless="$(arg sim)"/>
</launch>
//- /more.launch
<launch><node pkg="p" type="b" name="gazebo" ns="world"/></launch>
"""


def started(name: str, sim: str = "false") -> Start:
    at = at_cursor(CONDITION.replace('default="false"', f'default="{sim}"'))
    return why_started(at.analysis, name, at.evaluate)


def test_a_condition_leaves_a_node_out() -> None:
    start = started("/world/gazebo")
    assert start.broken is not None
    assert start.broken.text == "not started: if=\"$(arg sim)\" is 'false'; it is started with sim:=true"
    assert dict(start.wanted) == {"sim": "true"}


def test_what_starts_a_node() -> None:
    start = started("base")
    assert start.node == "/base"
    assert [(link.about, link.state) for link in start.links] == [
        ("condition", "ok"),
        ("started", "ok"),
        ("finding", "broken"),
    ]
    assert start.broken is not None
    assert start.broken.text.startswith("PKG002: ")


def test_the_conditions_and_files_on_the_way_to_a_node() -> None:
    start = started("/world/gazebo", sim="true")
    assert [link.text for link in start.links if link.state == "ok"] == [
        "includes the file below",
        'under the condition if="$(arg sim)"',
        "/world/gazebo is started here",
    ]


def test_no_condition_leads_to_it() -> None:
    with pytest.raises(NoSuchNodeError) as raised:
        started("bas")
    assert raised.value.near == ("/base",)
