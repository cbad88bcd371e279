"""Chains beside a running system: each link that can break there."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pytest
from preflight_analysis.graph.model import ChannelKind
from preflight_analysis.live.model import LiveEndpoint, LiveNode, Observation
from preflight_analysis.queries.why import Chain, first_broken
from preflight_analysis.queries.why_live import live_links

CHAIN = Chain("topics", "/chatter", "/a", "/b", (), "/chatter", "/chatter")
PUBLISHER = LiveEndpoint("publisher", "/a", "/chatter", "x/msg/Y")
SUBSCRIBER = LiveEndpoint("subscriber", "/b", "/chatter", "x/msg/Y")


def seen(*endpoints: LiveEndpoint, generation: int = 2, **nodes: LiveNode) -> Observation:
    running = {"/a": LiveNode("/a"), "/b": LiveNode("/b"), **{f"/{name}": node for name, node in nodes.items()}}
    return Observation(generation, running, endpoints)


def broken(observation: Observation, chain: Chain = CHAIN) -> str | None:
    found = first_broken(live_links(chain, observation))
    return found.text if found is not None else None


def test_all_links_are_there() -> None:
    links = live_links(CHAIN, seen(PUBLISHER, SUBSCRIBER))
    assert [(link.about, link.state) for link in links] == [
        ("started", "ok"),
        ("endpoint", "ok"),
        ("started", "ok"),
        ("endpoint", "ok"),
        ("name", "ok"),
        ("type", "ok"),
    ]


def test_a_node_that_does_not_run() -> None:
    observation = Observation(2, {"/a": LiveNode("/a"), "/bb_node": LiveNode("/bb_node")}, (PUBLISHER,))
    assert broken(observation) == "/b does not run"
    chain = Chain("topics", "/chatter", "/a", "/bb_nod", (), "/chatter", "/chatter")
    assert broken(observation, chain) == "/bb_nod does not run; did you mean /bb_node?"


def test_a_node_that_does_not_answer_and_one_that_is_not_active() -> None:
    dead = seen(PUBLISHER, SUBSCRIBER, generation=1, b=LiveNode("/b", dead="connection refused"))
    assert broken(dead) == "/b is registered and does not answer: connection refused"
    assert broken(seen(PUBLISHER, a=LiveNode("/a", lifecycle="inactive"))) == "/a runs and is inactive: activate it"


def test_an_endpoint_that_is_missing() -> None:
    other = LiveEndpoint("publisher", "/a", "/chater", "x/msg/Y")
    assert broken(seen(other, SUBSCRIBER)) == "/a runs and has no publisher '/chatter'; it publishes '/chater'"
    assert broken(seen(PUBLISHER)) == "/b runs and has no subscriber '/chatter'"


def test_the_names_of_two_ends_that_are_not_the_same() -> None:
    chain = Chain("topics", None, "/a", "/b", (), "/chatter", "/chater")
    subscriber = LiveEndpoint("subscriber", "/b", "/chater", "x/msg/Y")
    assert broken(seen(PUBLISHER, subscriber), chain) == "'/chatter' and '/chater' are different topic names"
    assert broken(seen(PUBLISHER, SUBSCRIBER), chain) == (
        "/b runs and has no subscriber '/chater'; it subscribes to '/chatter'"
    )


@pytest.mark.parametrize(
    ("publisher", "subscriber", "why"),
    [
        ({"type": "x/msg/Z"}, {}, "types differ: /a uses x/msg/Z, /b uses x/msg/Y"),
        ({"type": None}, {}, None),
        ({"type": "tf/tfMessage"}, {"type": "tf2_msgs/TFMessage"}, None),
        (
            {"qos": {"reliability": "best_effort", "durability": "volatile"}},
            {"qos": {"reliability": "reliable", "durability": "volatile"}},
            "QoS reliability: /a offers best effort, /b requests reliable",
        ),
    ],
)
def test_types_and_qos(publisher: Mapping[str, Any], subscriber: Mapping[str, Any], why: str | None) -> None:
    first: dict[str, Any] = {"type": "x/msg/Y", **publisher}
    second: dict[str, Any] = {"type": "x/msg/Y", **subscriber}
    ends = LiveEndpoint("publisher", "/a", "/chatter", **first), LiveEndpoint("subscriber", "/b", "/chatter", **second)
    assert broken(seen(*ends)) == why


@pytest.mark.parametrize(("kind", "unknown"), [("services", 1), ("actions", 2)])
def test_what_a_master_does_not_know_is_no_broken_link(kind: ChannelKind, unknown: int) -> None:
    chain = Chain(kind, "/x", "/a", "/b", (), "/x", "/x")
    links = live_links(chain, seen(LiveEndpoint("service", "/a", "/x", None), generation=1))
    assert first_broken(links) is None
    assert sum(link.state == "unknown" for link in links) == unknown
