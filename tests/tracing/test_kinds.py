"""Kinds of nodes that are more than their topics."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.graph.actions import actions_of
from tracing_desk import trace, write_node

NAVIGATE = """
    import actionlib
    import rospy
    from actionlib.msg import TestAction
    rospy.init_node("n")
    {make}
    rospy.spin()
"""
CLIENT = "client = actionlib.SimpleActionClient('navigate', TestAction)"
SERVER = "server = actionlib.SimpleActionServer('navigate', TestAction, lambda goal: None, False); server.start()"


@pytest.mark.parametrize(("make", "role"), [(CLIENT, "action_client"), (SERVER, "action_server")])
def test_an_action_of_actionlib(tmp_path: Path, make: str, role: str) -> None:
    node = write_node(tmp_path, NAVIGATE.format(make=make))
    interface = trace(node)
    assert interface.outcome.status == "spinning"
    (found,) = actions_of(interface.endpoints)
    assert (found.endpoint.role, found.endpoint.name) == (role, "navigate")
    assert found.endpoint.type == "actionlib/TestAction"
    assert found.endpoint.md5 == "991e87a72802262dfbe5d1b3cf6efc9a"
    assert (found.endpoint.source_file, found.endpoint.source_line) == (str(node), 7)


def test_rospy_remaps_the_name_of_an_action_as_it_is_written(tmp_path: Path) -> None:
    node = write_node(tmp_path, NAVIGATE.format(make=CLIENT))
    (moved,) = actions_of(trace(node, "/a/n", remaps=(("navigate", "go"),)).endpoints)
    assert moved.endpoint.name == "/a/go"
    (left,) = actions_of(trace(node, "/a/n", remaps=(("/a/navigate", "/a/go"),)).endpoints)
    assert left.endpoint.name == "navigate"
