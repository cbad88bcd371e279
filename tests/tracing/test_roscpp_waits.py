"""Nodes in C++ that wait for somebody who is not there: as for rospy, what comes after a made-up answer is marked."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.graph.actions import actions_of
from preflight_analysis.tracing.interface import Frame, Interface
from support.tracing_harness import trace

pytestmark = pytest.mark.ros

MESSAGE = "it waits for a message on goal, and was given an empty one"
POLL = "it waits for messages on /{}, and was given empty ones"
PARAMETER = "it waits for the parameter {}, and was given a value"
SERVICES = "it asks for the service /start again and again, and was told that it is there"
CALLS = "it calls the service /start again and again, and was given an empty answer"
SERVER = "it waits for the action server /move, and was told that it is there"
RESULT = "it waits for the result of the action /move, and was given an empty one"
CLOCK = "it waits for simulated time on /clock, and was given the time of day"
TRANSFORM = "it waits for the transform {}, and was given the identity"
TRANSFORMS = "it asks for the transform {} again and again, and was given the identity"


def waiting(package: Path, mode: str) -> Interface:
    return trace(package / "waits", args=(mode,), params={"/use_sim_time": True} if mode.startswith("clock") else {})


def made(interface: Interface) -> dict[str, bool]:
    """Those of the node's publishers that stand for a place in its source, and whether they are speculative."""
    return {
        e.name: "made-up answer" in e.evidence.doubts
        for e in interface.endpoints
        if e.role == "publisher" and e.name in ("before", "after")
    }


@pytest.mark.parametrize(
    ("mode", "answers"),
    [
        ("message", (MESSAGE,)),
        ("timeout", (MESSAGE,)),
        ("twice", (MESSAGE,)),
        ("agreed", (MESSAGE.replace("goal", "ready"),)),
        ("rate", (POLL.format("news"),)),
        ("slow", (POLL.format("news"),)),
        ("ready", (POLL.format("ready"),)),
        ("thread", (POLL.format("numbers"),)),
        ("parameter", (PARAMETER.format("/rate"),)),
        ("has", (PARAMETER.format("/node/ready"),)),
        ("exists", (SERVICES, CALLS)),
        ("calls", (CALLS,)),
        ("clock", (CLOCK,)),
        ("clock_sleep", (CLOCK,)),
        ("clock_loop", (CLOCK,)),
        ("result", (SERVER, RESULT)),
        ("callback", (SERVER, RESULT)),
        ("goals", (SERVER, RESULT)),
        ("lookup", (TRANSFORM.format("map <- base"),)),
        ("can", (TRANSFORM.format("map <- base"),)),
        ("fixed", (TRANSFORM.format("odom <- base"), TRANSFORM.format("map <- odom"))),
        ("poll", (TRANSFORMS.format("map <- base"),)),
        ("poll_can", (TRANSFORMS.format("map <- base"),)),
        ("tf", (TRANSFORM.format("map <- base"),)),
    ],
)
def test_a_wait_is_answered(package: Path, mode: str, answers: tuple[str, ...]) -> None:
    found = waiting(package, mode)
    assert (found.outcome.status, found.outcome.reason) == ("spinning", None)
    assert found.outcome.answers == answers
    assert made(found) == {"before": False, "after": True}
    assert not found.complete


@pytest.mark.parametrize("mode", ["own_message", "own_tf", "no_listener"])
def test_who_is_there_needs_no_made_up_answer(package: Path, mode: str) -> None:
    found = waiting(package, mode)
    assert (found.outcome.status, found.outcome.answers) == ("spinning", ())
    assert made(found)["after"] is False


@pytest.mark.parametrize("mode", ["work", "fragile", "publish", "optional", "calling"])
def test_a_loop_that_is_the_nodes_work_is_none_that_waits(package: Path, mode: str) -> None:
    found = waiting(package, mode)
    assert (found.outcome.status, found.outcome.answers) == ("spinning", ())
    assert made(found) == {"before": False}
    assert found.complete


def test_an_action_server(package: Path) -> None:
    (action,) = actions_of(waiting(package, "server").endpoints)
    assert (action.endpoint.role, action.endpoint.name, action.endpoint.type) == (
        "action_server",
        "move",
        "actionlib/TestAction",
    )
    assert action.endpoint.md5 == "991e87a72802262dfbe5d1b3cf6efc9a"


def test_frames_of_broadcasters(package: Path) -> None:
    assert waiting(package, "frames").frames == (
        Frame("base", "camera", static=True),
        Frame("base", "laser", static=True),
        Frame("odom", "base", static=False),
    )


@pytest.mark.parametrize("mode", ["message", "rate", "result"])
def test_messages_are_made_up_whatever_isolates_the_node(package: Path, each_backend: str, mode: str) -> None:
    found = waiting(package, mode)
    assert (found.outcome.status, found.outcome.reason) == ("spinning", None)
    assert made(found) == {"before": False, "after": True}
