"""Nodes with windows get an X server inside of the sandbox, where one is installed."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.tracing import x_server
from support.tracing_harness import own, trace, write_node

pytestmark = pytest.mark.ros

WINDOW = """
    import os, socket, sys
    if "DISPLAY" not in os.environ:
        sys.exit("cannot open display")
    server = socket.socket(socket.AF_UNIX)
    server.connect("/tmp/.X11-unix/X" + os.environ["DISPLAY"].lstrip(":"))
    server.sendall(b"l\\0" + (11).to_bytes(2, "little") + bytes(8))
    assert server.recv(8)[0] == 1, "the server refused"
    import rospy
    from std_msgs.msg import String
    rospy.init_node("n")
    rospy.Publisher("clicked", String, queue_size=1)
    rospy.spin()
"""


def test_a_node_that_lacks_an_x_server_is_run_again_with_one(tmp_path: Path) -> None:
    found = trace(write_node(tmp_path, WINDOW))
    assert (found.outcome.status, found.notes) == ("spinning", ())
    assert own(found) == {("publisher", "clicked", "std_msgs/String")}


def test_where_none_is_installed_the_trace_says_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(x_server, "server", lambda: None)
    found = trace(write_node(tmp_path, WINDOW))
    assert found.outcome.status == "crashed"
    assert "it seems to need an X server: with Xvfb installed it is run with one" in found.notes


def test_a_node_that_ends_for_another_reason_is_not_run_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(x_server, "server", lambda: pytest.fail("an X server was looked for"))
    assert trace(write_node(tmp_path, "import sys; sys.exit('no such camera')")).outcome.status == "crashed"


def test_a_node_that_ends_with_its_windows_has_ended(tmp_path: Path) -> None:
    ending = WINDOW.replace("rospy.spin()", "").replace("import rospy\n", "sys.exit(0)\n")
    assert trace(write_node(tmp_path, ending)).outcome.status == "exited"
