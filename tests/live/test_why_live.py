"""`why --live` beside real nodes."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from support.command import Done
from support.live_harness import Ros1System, preflight
from support.waiting import until

pytestmark = pytest.mark.ros
LAUNCH = """<node pkg="pkg" type="talker.py" name="talker"/>
<node pkg="pkg" type="listener.py" name="listener"/>"""


@pytest.fixture
def system(tmp_path: Path) -> Iterator[Ros1System]:
    system = Ros1System(tmp_path)
    system.node("talker.py", "rospy.Publisher('chatter', String, queue_size=1)")
    system.node("listener.py", "rospy.Subscriber('chatter', String, print)")
    yield system
    system.close()


def why(system: Ros1System, file: Path) -> Done:
    return preflight(system.environment, "why", file, "talker", "listener", "--live", "--format", "json")


def test_a_node_that_ended_is_the_broken_link(system: Ros1System) -> None:
    file = system.launch_file(LAUNCH)
    system.launch(file)
    until(lambda: why(system, file).code == 0)
    (chain,) = why(system, file).json["chains"]
    assert [link["state"] for link in chain["live"]] == ["ok"] * len(chain["live"])
    system.shut_down("/talker")
    until(lambda: why(system, file).code == 1)
    (chain,) = why(system, file).json["chains"]
    assert chain["connected"] is True
    assert [link["text"] for link in chain["live"] if link["state"] == "broken"] == ["/talker does not run"]


def test_without_a_system_the_reason_is_reported(system: Ros1System) -> None:
    done = why(system, system.launch_file(LAUNCH))
    assert (done.code, done.out) == (2, "")
    assert str(system.port) in done.err
