"""Chains from publisher to subscriber: each kind of link breaks once and holds once."""

from __future__ import annotations

import json
from collections.abc import Mapping
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
    chain = only(ros1(a='<env name="ROS_MASTER_URI" value="http://other:11311"/>'))
    assert broken(chain) == (
        "environment",
        "ROS_MASTER_URI differs: /a has http://other:11311, /b has http://localhost:11311",
    )


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
    (clock,) = (link for link in chain.links if link.about == "clock")
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


def started(name: str) -> Start:
    at = at_cursor(CONDITION)
    return why_started(at.analysis, name, at.evaluate)


def test_a_condition_leaves_a_node_out() -> None:
    start = started("/world/gazebo")
    assert start.broken is not None
    assert start.broken.text == "not started: if=\"$(arg sim)\" is 'false'; it is started with sim:=true"
    assert dict(start.wanted) == {"sim": "true"}


def test_what_starts_a_node() -> None:
    start = started("base")
    assert start.node == "/base"
    assert [(link.about, link.state) for link in start.links] == [("started", "ok"), ("finding", "broken")]
    assert start.broken is not None
    assert start.broken.text.startswith("PKG002: ")


def test_no_condition_leads_to_it() -> None:
    with pytest.raises(NoSuchNodeError) as raised:
        started("bas")
    assert raised.value.near == ("/base",)
