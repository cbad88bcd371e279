"""Kinds of nodes that are more than their topics."""

from __future__ import annotations

import threading
from dataclasses import replace
from pathlib import Path

import pytest
from preflight_analysis.environment.model import Environment
from preflight_analysis.environment.packages import find_packages
from preflight_analysis.graph.actions import actions_of
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.interface import Frame
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.trace import Tracer
from support.tracing_harness import environment, own, trace, write_node

pytestmark = pytest.mark.ros

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


NODELET = """
    import sys
    import rospy
    from std_msgs.msg import String
    rospy.init_node("nodelet")
    assert sys.argv[1:3] == ["standalone", "vision/Rectify"], sys.argv
    rospy.Publisher("~image", String, queue_size=1)
    rospy.spin()
"""


def nodelet_folder(tmp_path: Path) -> Path:
    """A package `nodelet` whose executable stands for the real one; no nodelet is packaged for Debian."""
    folder = tmp_path / "nodelet"
    folder.mkdir()
    return write_node(folder, NODELET, "nodelet")


def test_a_nodelet_of_a_manager_runs_alone_and_calls_its_manager(tmp_path: Path) -> None:
    executable = nodelet_folder(tmp_path)
    tracer = Tracer(environment(tmp_path), TraceCache(tmp_path / "cache"))
    args = ("load", "vision/Rectify", "manager", "--no-bond")
    asked = TraceRequest("/camera/rectify", "nodelet", str(executable), args)
    expected = {("publisher", "~image", "std_msgs/String"), ("client", "manager/load_nodelet", "nodelet/NodeletLoad")}
    first = tracer.trace(asked, threading.Event())
    assert own(first) == expected
    assert first.outcome.status == "spinning"
    again = tracer.lookup(asked)
    assert again is not None
    assert own(again) == expected
    elsewhere = tracer.lookup(replace(asked, args=("load", "vision/Rectify", "other", "--no-bond")))
    assert elsewhere is not None
    assert ("client", "other/load_nodelet", "nodelet/NodeletLoad") in own(elsewhere)
    bonded = tracer.lookup(replace(asked, args=("load", "vision/Rectify", "manager")))
    assert bonded is None, "the standalone nodelet would get other arguments"


def test_a_nodelet_and_its_manager_keep_a_bond(tmp_path: Path) -> None:
    asked = TraceRequest("/n", "nodelet", str(nodelet_folder(tmp_path)), ("load", "vision/Rectify", "manager"))
    found = own(Tracer(environment(tmp_path), None).trace(asked, threading.Event()))
    assert {("publisher", "manager/bond", "bond/Status"), ("subscriber", "manager/bond", "bond/Status")} <= found


def nodelet_workspace(tmp_path: Path, library: str = "vision") -> Environment:
    """A package with a nodelet that is described and not built."""
    share = tmp_path / "vision"
    share.mkdir()
    export = '<export><nodelet plugin="${prefix}/plugins.xml"/></export>'
    depends = "<depend>nodelet</depend>"
    (share / "package.xml").write_text(
        '<package format="2"><name>vision</name><version>0.0.1</version><description>d</description>'
        f'<maintainer email="a@b.c">a</maintainer><license>x</license>{depends}{export}</package>'
    )
    described = '<class name="vision/Rectify" type="vision::Rectify" base_class_type="nodelet::Nodelet"/>'
    (share / "plugins.xml").write_text(f'<library path="lib/lib{library}">{described}</library>')
    (share / "CMakeLists.txt").write_text("project(vision)\nadd_library(${PROJECT_NAME} src/rectify.cpp)\n")
    return replace(environment(tmp_path), packages=find_packages([str(tmp_path)]).packages)


@pytest.mark.parametrize("args", [("load", "vision/Rectify", "manager"), ("standalone", "vision/Rectify")])
def test_a_nodelet_whose_library_is_not_built_is_as_if_it_had_not_been_run(
    tmp_path: Path, args: tuple[str, ...]
) -> None:
    asked = TraceRequest("/n", "nodelet", "/usr/lib/nodelet/nodelet", args)
    found = Tracer(nodelet_workspace(tmp_path), None).trace(asked, threading.Event())
    assert found.outcome.status == "not-run"
    assert found.outcome.reason == "the library 'vision' of nodelet 'vision/Rectify' is not built yet"
    calls = ("client", "manager/load_nodelet", "nodelet/NodeletLoad")
    assert (calls in own(found)) == (args[0] == "load")


def test_a_nodelet_whose_library_no_build_makes_crashes(tmp_path: Path) -> None:
    asked = TraceRequest("/n", "nodelet", "/usr/lib/nodelet/nodelet", ("standalone", "vision/Rectify"))
    tracer = Tracer(nodelet_workspace(tmp_path, "vison"), TraceCache(tmp_path / "cache"))
    found = tracer.trace(asked, threading.Event())
    assert found.outcome.status == "crashed"
    assert "the library 'lib/libvison' actually exists" in str(found.outcome.reason)
    assert tracer.lookup(asked) is None, "the library may turn up"


def test_a_nodelet_of_a_package_that_is_not_there_is_as_if_it_had_not_been_run(tmp_path: Path) -> None:
    asked = TraceRequest("/n", "nodelet", "/usr/lib/nodelet/nodelet", ("load", "elsewhere/Thing", "manager"))
    found = Tracer(nodelet_workspace(tmp_path), None).trace(asked, threading.Event())
    assert found.outcome.status == "not-run"
    reason = "package 'elsewhere' of nodelet 'elsewhere/Thing' is not among those of this environment"
    assert found.outcome.reason == reason


@pytest.mark.parametrize("name", ["vision/Rectified", "visoin/Rectify"])
def test_a_misspelt_nodelet_crashes(tmp_path: Path, name: str) -> None:
    asked = TraceRequest("/n", "nodelet", "/usr/lib/nodelet/nodelet", ("load", name, "manager"))
    found = Tracer(nodelet_workspace(tmp_path), None).trace(asked, threading.Event())
    assert found.outcome.status == "crashed"
    assert f"the class {name}" in str(found.outcome.reason)


def test_a_nodelet_manager_is_an_ordinary_node() -> None:
    asked = TraceRequest("/manager", "nodelet", "/usr/lib/nodelet/nodelet", ("manager",))
    found = Tracer(environment(), None).trace(asked, threading.Event())
    assert found.outcome.status == "spinning"
    services = {e.name for e in found.endpoints if e.role == "service" and not e.builtin}
    assert services == {"~load_nodelet", "~unload_nodelet", "~list"}


def test_a_shell_wrapper_that_starts_a_node(tmp_path: Path) -> None:
    write_node(tmp_path, NAVIGATE.format(make=CLIENT))
    wrapper = tmp_path / "wrapped"
    wrapper.write_text('#!/bin/sh\nexport X=1\nexec "$(dirname "$0")/node.py" "$@"\n')
    wrapper.chmod(0o755)
    found = trace(wrapper)
    assert found.outcome.status == "spinning"
    (action,) = actions_of(found.endpoints)
    assert action.endpoint.name == "navigate"


DAEMON = """
    import os, sys
    if os.fork():
        os._exit(0)
    os.setsid()
    if os.fork():
        os._exit(0)
    import rospy
    from std_msgs.msg import String
    rospy.init_node("n")
    rospy.Publisher("late", String, queue_size=1)
"""


def test_a_node_that_becomes_a_daemon_is_followed(tmp_path: Path) -> None:
    found = trace(write_node(tmp_path, DAEMON + "    rospy.spin()\n"))
    assert found.outcome.status == "spinning"
    assert own(found) == {("publisher", "late", "std_msgs/String")}


def test_a_daemon_that_ends_has_ended(tmp_path: Path) -> None:
    found = trace(write_node(tmp_path, DAEMON + "    os._exit(0)\n"))
    assert found.outcome.status == "exited"
    assert own(found) == {("publisher", "late", "std_msgs/String")}


def test_a_script_that_starts_a_node_in_the_background(tmp_path: Path) -> None:
    write_node(tmp_path, NAVIGATE.format(make=CLIENT))
    wrapper = tmp_path / "wrapped"
    wrapper.write_text('#!/bin/sh\n"$(dirname "$0")/node.py" "$@" &\n')
    wrapper.chmod(0o755)
    found = trace(wrapper)
    assert found.outcome.status == "spinning"
    assert len(actions_of(found.endpoints)) == 1


def test_a_node_that_ends_beside_its_children_has_ended(tmp_path: Path) -> None:
    body = """
        import os, subprocess
        import rospy
        rospy.init_node("n")
        subprocess.Popen(["sleep", "60"])
        os._exit(0)
    """
    assert trace(write_node(tmp_path, body)).outcome.status == "exited"


def test_message_filters_subscribe_like_others(tmp_path: Path) -> None:
    body = """
        import message_filters
        import rospy
        from std_msgs.msg import String
        rospy.init_node("n")
        both = [message_filters.Subscriber(name, String) for name in ("left", "~right")]
        message_filters.ApproximateTimeSynchronizer(both, 10, 0.1, allow_headerless=True)
        rospy.spin()
    """
    node = write_node(tmp_path, body)
    found = trace(node)
    assert own(found) == {("subscriber", "left", "std_msgs/String"), ("subscriber", "~right", "std_msgs/String")}
    assert {(e.source_file, e.source_line) for e in found.endpoints if not e.builtin} == {(str(node), 7)}


def test_a_node_finds_the_parameters_of_the_whole_launch(tmp_path: Path) -> None:
    body = """
        import rospy
        from std_msgs.msg import String
        rospy.init_node("n")
        found = [rospy.search_param(name) for name in ("robot", "limits/speed", "deep")]
        assert found == ["/fleet/robot", "/limits/speed", "/fleet/one/n/deep"], found
        rospy.Publisher(rospy.get_param(found[0]), String, queue_size=1)
        rospy.Publisher("speed%d" % rospy.get_param("/limits")["speed"], String, queue_size=1)
        rospy.Publisher(rospy.get_param("/fleet/two/other/topic"), String, queue_size=1)
        rospy.spin()
    """
    params = {
        "/robot": "far",
        "/fleet/robot": "near",
        "/limits/speed": 3,
        "/fleet/one/n/deep": 1,
        "/deep": 2,
        "/fleet/two/other/topic": "of_another",
    }
    found = trace(write_node(tmp_path, body), "/fleet/one/n", params=params)
    assert {name for _, name, _ in own(found)} == {"near", "speed3", "of_another"}


def test_frames_that_are_broadcast(tmp_path: Path) -> None:
    body = """
        import rospy
        from geometry_msgs.msg import TransformStamped
        from tf2_msgs.msg import TFMessage
        from std_msgs.msg import String
        rospy.init_node("n")
        def transform(parent, child):
            made = TransformStamped()
            made.header.frame_id, made.child_frame_id = parent, child
            made.transform.rotation.w = 1
            return made
        rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True).publish([transform("base", "laser")])
        moving = rospy.Publisher("tf", TFMessage, queue_size=1)
        rospy.Publisher("word", String, queue_size=1).publish("hello")
        while not rospy.is_shutdown():
            moving.publish(TFMessage([transform("odom", "base"), transform("map", "odom")]))
            moving.publish(transforms=[transform("base", "arm")])
            rospy.sleep(0.05)
    """
    tracer = Tracer(environment(tmp_path), TraceCache(tmp_path / "cache"))
    asked = TraceRequest("/n", "pkg", str(write_node(tmp_path, body)))
    found = tracer.trace(asked, threading.Event())
    assert found.outcome.status == "spinning"
    assert found.notes == ()
    assert found.frames == (
        Frame("base", "arm"),
        Frame("base", "laser", static=True),
        Frame("map", "odom"),
        Frame("odom", "base"),
    )
    again = tracer.lookup(asked)
    assert again is not None
    assert again.frames == found.frames


@pytest.mark.parametrize("static", [False, True])
def test_frames_of_tf2_ros(tmp_path: Path, static: bool) -> None:
    name = "StaticTransformBroadcaster" if static else "TransformBroadcaster"
    body = f"""
        import rospy
        from tf2_ros.{"static_" if static else ""}transform_broadcaster import {name}
        from geometry_msgs.msg import TransformStamped
        rospy.init_node("n")
        made = TransformStamped()
        made.header.frame_id, made.child_frame_id = "base", "laser"
        made.transform.rotation.w = 1
        {name}().sendTransform(made)
        rospy.spin()
    """
    found = trace(write_node(tmp_path, body))
    assert (found.outcome.status, found.frames) == ("spinning", (Frame("base", "laser", static),))


def test_a_node_that_looks_for_its_own_service_does_not_call_it(tmp_path: Path) -> None:
    body = """
        import rospy, tf2_ros
        rospy.init_node("n")
        listener = tf2_ros.TransformListener(tf2_ros.Buffer())
        rospy.spin()
    """
    found = trace(write_node(tmp_path, body))
    assert {(e.role, e.name) for e in found.endpoints if e.role in ("service", "client") and not e.builtin} == {
        ("service", "~tf2_frames")
    }


def test_a_node_that_takes_its_time_to_shut_down_is_not_spinning(tmp_path: Path) -> None:
    body = """
        import time
        import rospy
        rospy.init_node("n")
        rospy.on_shutdown(lambda: time.sleep(2))
        rospy.signal_shutdown("done")
    """
    found = trace(write_node(tmp_path, body))
    assert (found.outcome.status, found.outcome.exit_code) == ("exited", 0)


@pytest.mark.parametrize("loop", ["not rospy.is_shutdown()", "True"])
def test_a_loop_with_sleeps_that_are_not_rospys_is_an_event_loop(tmp_path: Path, loop: str) -> None:
    body = f"""
        import time
        import rospy
        from std_msgs.msg import String
        rospy.init_node("n")
        chatter = rospy.Publisher("chatter", String, queue_size=1)
        while {loop}:
            chatter.publish("")
            time.sleep(1)
    """
    found = trace(write_node(tmp_path, body))
    assert (found.outcome.status, found.outcome.answers) == ("spinning", ())
    assert own(found) == {("publisher", "chatter", "std_msgs/String")}


def test_a_node_of_no_client_library_is_seen_by_its_master(tmp_path: Path) -> None:
    body = """
        import os, sys, threading
        from xmlrpc.client import ServerProxy
        from xmlrpc.server import SimpleXMLRPCServer
        name = "/" + next(a for a in sys.argv if a.startswith("__name:="))[len("__name:="):]
        slave = SimpleXMLRPCServer(("127.0.0.1", 0), logRequests=False)
        slave.register_function(lambda caller: [1, "", os.getpid()], "getPid")
        uri = "http://127.0.0.1:%d/" % slave.server_address[1]
        master = ServerProxy(os.environ["ROS_MASTER_URI"])
        master.registerPublisher(name, "/chatter", "std_msgs/String", uri)
        master.registerSubscriber(name, "/commands", "std_msgs/String", uri)
        master.registerService(name, name + "/reset", "rosrpc://127.0.0.1:1", uri)
        assert master.getParam(name, "/rate")[2] == 5
        assert master.lookupService(name, "/elsewhere")[0] == -1
        slave.serve_forever()
    """
    found = trace(write_node(tmp_path, body), params={"/rate": 5})
    assert own(found) == {
        ("publisher", "/chatter", "std_msgs/String"),
        ("subscriber", "/commands", "std_msgs/String"),
        ("service", "/node/reset", None),
        ("client", "/elsewhere", None),
    }
    assert [(p.access, p.name) for p in found.params] == [("get", "/rate")]
    assert found.outcome.status == "spinning"
