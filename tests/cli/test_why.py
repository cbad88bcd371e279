"""`why`: the connection of two nodes, or the start of one, on the demo."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from support.editor_harness import Harness

pytestmark = pytest.mark.ros
Run = Callable[..., Any]
FILE = "launch/talker_listener.launch"


def test_a_connection_that_breaks(harness: Harness, preflight: Run) -> None:
    done = preflight("why", FILE, "talker", "listener")
    assert (done.code, done.err) == (1, "")
    verdict, *links = done.out.splitlines()
    assert verdict == "/talker -> /listener: not connected: '/chatter' and '/chater' are different topic names"
    assert [line.split()[0] for line in links] == ["ok", "ok", "ok", "ok", "BROKEN", "fix:", "ok"]
    assert links[4].endswith(f"[{FILE}:7:31]")


def test_the_same_as_json(harness: Harness, preflight: Run) -> None:
    done = preflight("why", FILE, "talker", "listener", "/chatter", "--format", "json", "--paths", "relative")
    (chain,) = done.json["chains"]
    assert (done.json["schema"], done.code, chain["connected"]) == ("ros-preflight/why/1", 1, False)
    (broken,) = (link for link in chain["links"] if link["state"] == "broken")
    assert (broken["about"], broken["file"], broken["line"]) == ("name", FILE, 7)
    assert broken["fixes"]


def test_without_the_mistake(harness: Harness, preflight: Run) -> None:
    path = Path(harness.workspace, FILE)
    path.write_text(path.read_text().replace('to="chater"', 'to="chatter"'))
    done = preflight("why", FILE, "talker", "listener")
    assert (done.code, done.err) == (0, "")
    assert done.out.startswith("/talker -> /listener over the topic '/chatter': connected\n")


def test_the_start_of_one_node(harness: Harness, preflight: Run) -> None:
    done = preflight("why", FILE, "talker")
    assert (done.code, done.out.splitlines()[0]) == (0, "/talker is started")
    assert harness.sandbox_starts() == 0


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (("talkr",), "no node 'talkr' in this launch; did you mean /talker?"),
        (("a", "b", "c", "d"), "name one node, or two nodes"),
        (("rate:=3",), "name one node, or two nodes"),
    ],
)
def test_what_cannot_be_answered(harness: Harness, preflight: Run, words: tuple[str, ...], text: str) -> None:
    done = preflight("why", FILE, *words, "--no-run")
    assert (done.code, done.out) == (2, "")
    assert text in done.err


def test_two_nodes_that_are_not_known_to_share_anything(harness: Harness, preflight: Run) -> None:
    path = Path(harness.workspace, "launch/apart.launch")
    path.write_text(
        '<launch>\n  <node pkg="joy" type="joy_node" name="joy"/>\n'
        '  <node pkg="amcl" type="amcl" name="amcl"/>\n</launch>\n'
    )
    done = preflight("why", "launch/apart.launch", "joy", "amcl", "--no-run")
    title, *lines = done.out.splitlines()
    assert (done.code, len([line for line in lines if line.lstrip().startswith("?")])) == (0, 2)
    assert title == "/joy -> /amcl: no topic, service or action is known that they share; 2 links are unknown"


IN_PYTHON = """
from launch import LaunchDescription
from launch.conditions import UnlessCondition
from launch_ros.actions import Node

def generate_launch_description():
    spawner = Node(package="controller_manager", executable="spawner", arguments=["joint_state_broadcaster"])
    kind = {"joint_state_broadcaster.type": "joint_state_broadcaster/JointStateBroadcaster"}
    manager = Node(
        package="controller_manager",
        executable="ros2_control_node",
        name="controller_manager",
        parameters=[kind],
        condition=UnlessCondition("false"),
    )
    return LaunchDescription([manager, spawner])
"""


def test_a_condition_in_python_is_shown_as_it_is_written(harness: Harness, preflight: Run) -> None:
    Path(harness.workspace, "launch/arm.launch.py").write_text(IN_PYTHON)
    done = preflight("why", "launch/arm.launch.py", "controller_manager")
    assert 'under the condition UnlessCondition("false") [launch/arm.launch.py:14:19]' in done.out
    assert "controller_manager is started here" in done.out


def test_a_controller_is_started_within_its_manager(harness: Harness, preflight: Run) -> None:
    Path(harness.workspace, "launch/arm.launch.py").write_text(IN_PYTHON)
    done = preflight("why", "launch/arm.launch.py", "joint_state_broadcaster")
    assert done.out.startswith("/joint_state_broadcaster is started\n")
    assert "/joint_state_broadcaster is started here within /controller_manager" in done.out


def test_nodes_of_a_launch_file_of_the_catalogue(harness: Harness, preflight: Run) -> None:
    path = Path(harness.workspace, "launch/mux.launch")
    path.write_text('<launch><include file="$(find twist_mux)/launch/twist_mux.launch"/></launch>\n')
    done = preflight("why", "launch/mux.launch", "twist_mux", "twist_marker", "--no-run")
    assert done.out.startswith("/twist_mux -> /twist_marker over the topic '/twist_mux/")
