"""Names that no ROS library would let through: whoever is in a robot's network can have them."""

from __future__ import annotations

import json
import threading
import xmlrpc.client
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from xmlrpc.server import SimpleXMLRPCServer

import pytest
from preflight_analysis.live import names
from preflight_analysis.live.compare import compare
from preflight_analysis.live.model import CannotObserveError, Expected, ExpectedNode, Observation
from preflight_analysis.live.observe_ros1 import Ros1Observer
from preflight_analysis.live.observe_ros2 import said
from preflight_analysis.live.report import event_json, line
from preflight_analysis.live.watcher import State
from preflight_server.cli.output import dumps_json

HOSTILE = {
    "/clipboard\x1b]52;c;eA==\x07": "/clipboard�]52;c;eA==�",
    "/two\r\nlines\x85": "/two��lines�",
    "/turned\u202efdp": "/turned�fdp",
    "/nowhere\u200b\ufeff\u2060": "/nowhere���",
    "/half\ud800": "/half�",
    "/long" + "x" * 1_000_000: "/long" + "x" * 294 + "…",
    "/![x](http://example.org/x.png)<img src=x>": "/![x](http://example.org/x.png)<img src=x>",
}


def of_ros2(nodes: Sequence[str], lifecycle: str = "active") -> Observation:
    told = {
        "nodes": nodes,
        "endpoints": [["publisher", each, each, each, {each: each}] for each in nodes],
        "lifecycle": dict.fromkeys(nodes, lifecycle),
    }
    return said(json.dumps(told), "domain 0")


@contextmanager
def master(nodes: Sequence[str]) -> Iterator[Ros1Observer]:
    """A master that has these nodes, each with a topic of its own name; all of them live at its own address."""

    class Master(SimpleXMLRPCServer):
        def _dispatch(self, method: str, params: Sequence[object]) -> list[object]:
            own = f"http://127.0.0.1:{self.server_address[1]}/"
            topics = [[each, [each]] for each in nodes]
            answers = {"getSystemState": [topics, [], []], "getTopicTypes": [[each, each] for each in nodes]}
            return [1, "", answers.get(method, own)]

    with Master(("127.0.0.1", 0), logRequests=False) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        observer = Ros1Observer(f"http://127.0.0.1:{server.server_address[1]}/")
        yield observer
        observer.close()
        server.shutdown()


@pytest.mark.parametrize("generation", [1, 2])
def test_each_is_reported_as_it_can_be_shown(generation: int, tmp_path: Path) -> None:
    given = [each for each in HOSTILE if generation == 2 or xmlrpc_takes(each)]
    if generation == 2:
        live = of_ros2(given, "\x1b[2J")
        assert {node.lifecycle for node in live.nodes.values()} == {"�[2J"}
    else:
        with master(given) as observer:
            live = observer.observe()
    expected = sorted(HOSTILE[each] for each in given)
    assert sorted(live.nodes) == sorted(endpoint.name for endpoint in live.endpoints) == expected
    found = compare(Expected(generation, (ExpectedNode("/n", (), True, None),)), live)
    assert sorted(issue.node for issue in found.issues if issue.kind == "extra") == expected
    told = dumps_json(event_json(State(found)))
    assert len(told) < 20_000
    for issue in found.issues:
        assert line(issue, None).isprintable()


def xmlrpc_takes(name: str) -> bool:
    """XML has no way to write most control characters."""
    try:
        return bool(xmlrpc.client.loads(xmlrpc.client.dumps((name,)).encode())[0] == (name,))
    except (UnicodeEncodeError, xmlrpc.client.expat.ExpatError):
        return False


def test_ordinary_names_stay_what_they_are() -> None:
    live = of_ros2(["/robot/camera_1", "/" + "n" * 255])
    assert list(live.nodes) == ["/robot/camera_1", "/" + "n" * 255]
    assert [dict(endpoint.qos) for endpoint in live.endpoints] == [{name: name} for name in live.nodes]


def test_nodes_that_look_the_same_are_one_twice() -> None:
    live = of_ros2(["/a\x01", "/a\x02", "/b"])
    assert {node.name: node.count for node in live.nodes.values()} == {"/a�": 2, "/b": 1}


@pytest.mark.parametrize("generation", [1, 2])
def test_more_than_can_be_compared_is_said(generation: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(names, "MOST_ENDPOINTS", 20)
    few, many = ([f"/n{number}" for number in range(count)] for count in (20, 21))
    if generation == 2:
        assert len(of_ros2(few).endpoints) == 20
        with pytest.raises(CannotObserveError, match="21 nodes with 21 endpoints"):
            of_ros2(many)
    else:
        with master(few) as observer:
            assert len(observer.observe().endpoints) == 20
        with master(many) as observer, pytest.raises(CannotObserveError, match="21 nodes with 21 endpoints"):
            observer.observe()
