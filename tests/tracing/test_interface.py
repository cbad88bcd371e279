"""What a trace tells of ordinary nodes: names as given, types, places, parameters, outcome."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.tracing.interface import ENDS, KINDS, NOT_RUN, Endpoint, Interface, Outcome, ParamUse
from support.tracing_harness import ROS1_FIXTURES, own, trace, write_node

pytestmark = pytest.mark.ros

TUTORIALS = ROS1_FIXTURES / "tutorials" / "scripts"
SERVICES = ROS1_FIXTURES / "services" / "scripts"


def endpoint(interface: Interface, name: str) -> Endpoint:
    (found,) = [e for e in interface.endpoints if e.name == name]
    return found


def params(interface: Interface) -> dict[tuple[str, str], ParamUse]:
    return {(p.access, p.name): p for p in interface.params if not p.builtin}


def line_of(path: Path, text: str) -> int:
    return next(n for n, line in enumerate(path.read_text().splitlines(), 1) if text in line)


def test_names_are_as_given_whatever_the_remaps_and_namespace() -> None:
    plain = trace(TUTORIALS / "listener.py")
    moved = trace(TUTORIALS / "listener.py", "/robot/ears", remaps=(("chatter", "/elsewhere"),))
    assert own(plain) == own(moved) == {("subscriber", "chatter", "std_msgs/String")}


def test_endpoints_have_type_md5_qos_and_the_place_in_the_source() -> None:
    script = TUTORIALS / "advanced_publish.py"
    found = trace(script)
    color = endpoint(found, "color")
    assert color == Endpoint(
        "publisher",
        "color",
        "std_msgs/ColorRGBA",
        "a29a96539573343b1310c73607334b00",
        {"latch": True, "queue_size": 1},
        str(script),
        line_of(script, '"color"'),
    )
    assert endpoint(found, "~numbers").qos == {"latch": False, "queue_size": None}
    assert own(found) == {
        ("publisher", "chatter", "std_msgs/String"),
        ("publisher", "color", "std_msgs/ColorRGBA"),
        ("publisher", "~numbers", "std_msgs/Int32MultiArray"),
    }


def test_what_every_node_has_is_marked() -> None:
    found = trace(TUTORIALS / "listener.py", params={"/use_sim_time": True})
    assert {(e.role, e.name) for e in found.endpoints if e.builtin} == {
        ("publisher", "/rosout"),
        ("service", "~get_loggers"),
        ("service", "~set_logger_level"),
        ("subscriber", "/clock"),
    }
    assert not [p for p in found.params if not p.builtin]


def test_services_and_clients() -> None:
    assert own(trace(SERVICES / "switch.py")) == {
        ("service", "enable", "std_srvs/SetBool"),
        ("service", "~reset", "std_srvs/Trigger"),
    }
    assert own(trace(SERVICES / "operator.py")) == {("client", "enable", "std_srvs/SetBool")}
    confused = {("client", "enable", "std_srvs/Trigger"), ("client", "calibrate", "std_srvs/Empty")}
    assert own(trace(SERVICES / "confused_operator.py")) == confused


def test_parameters_with_access_default_and_place() -> None:
    script = TUTORIALS / "param_talker.py"
    values = {"/global_example": "hi", "/ns/utterance": "u", "/ns/gains/p": 1.0, "/ns/gains/i": 2, "/ns/gains/d": 3.5}
    found = trace(script, "/ns/talker", params=values | {"/ns/talker/topic_name": "news", "/ns/to_delete": 1})
    assert found.outcome.status == "spinning"
    assert ("publisher", "news", "std_msgs/String") in own(found)
    uses = params(found)
    assert set(uses) == {
        ("get", "/global_example"),
        ("get", "utterance"),
        ("get", "~topic_name"),
        ("get", "~rate"),
        ("get", "gains"),
        ("set", "list_of_floats"),
        ("set", "~private_bool"),
        ("has", "to_delete"),
        ("delete", "to_delete"),
        ("search", "global_example"),
        ("list", "/"),
    }
    rate = uses["get", "~rate"]
    assert (rate.has_default, rate.default, rate.mandatory) == (True, 10, False)
    assert uses["get", "utterance"].mandatory
    assert (rate.source_file, rate.source_line) == (str(script), line_of(script, "~rate"))


def test_a_missing_mandatory_parameter_is_told_before_the_crash() -> None:
    found = trace(TUTORIALS / "param_talker.py")
    assert found.outcome.status == "crashed"
    assert found.outcome.exit_code == 1
    assert found.outcome.reason == "it ended with exit code 1: KeyError: '/global_example'"
    assert params(found)["get", "/global_example"].mandatory


def test_the_parameter_server_answers_as_the_real_one(tmp_path: Path) -> None:
    script = write_node(
        tmp_path,
        """
        import rospy, sys
        rospy.init_node("n")
        assert rospy.get_param("/a") == {"b": {"c": 1, "d": [1, 2]}, "e": True}
        assert rospy.get_param("b/c") == 1
        assert not rospy.has_param("/a/x") and rospy.has_param("/a/b")
        assert rospy.search_param("e") == "/a/e" and rospy.search_param("b/new") == "/a/b/new"
        assert rospy.search_param("nowhere") is None
        rospy.set_param("/a/b/c/deep", "v")
        assert rospy.get_param("/a/b/c") == {"deep": "v"}
        rospy.delete_param("/a/b")
        assert rospy.get_param_cached("b", "gone") == "gone"
        assert rospy.get_param("/binary").data == b"\\x00\\xff"
        assert sorted(rospy.get_param_names()) == ["/a/e", "/binary"], rospy.get_param_names()
        sys.exit(42)
        """,
    )
    values = {"/a/b/c": 1, "/a/b/d": [1, 2], "/a/e": True, "/binary": b"\x00\xff"}
    found = trace(script, "/a/n", params=values)
    assert found.outcome.exit_code == 42, found.outcome


def test_arguments_environment_and_folder_of_the_launch_file_reach_the_node(tmp_path: Path) -> None:
    script = write_node(
        tmp_path,
        """
        import os, rospy, sys
        from std_msgs.msg import String
        rospy.init_node("other")
        words = rospy.myargv()[1:] + [os.environ["ROBOT"], os.path.basename(os.getcwd()), rospy.get_name()]
        rospy.Publisher("/".join(words), String, queue_size=1)
        rospy.spin()
        """,
    )
    found = trace(script, "/ns/me", args=("one two", "three"), env=(("ROBOT", "r2"),), cwd="node")
    assert {e.name for e in found.endpoints if not e.builtin} == {f"one two/three/r2/{tmp_path.name}//ns/me"}


def test_private_parameters_given_as_arguments() -> None:
    values = {"/global_example": "hi", "/utterance": "u", "/gains/p": 1, "/gains/i": 2, "/gains/d": 3}
    found = trace(TUTORIALS / "param_talker.py", params=values, args=("_topic_name:=news",))
    assert ("publisher", "news", "std_msgs/String") in own(found)


def test_a_node_that_ends_is_exited(tmp_path: Path) -> None:
    script = write_node(
        tmp_path,
        """
        import rospy
        from std_msgs.msg import String
        rospy.init_node("once")
        rospy.Publisher("news", String, latch=True, queue_size=1).publish("done")
        """,
    )
    found = trace(script)
    assert (found.outcome.status, found.outcome.exit_code) == ("exited", 0)
    assert own(found) == {("publisher", "news", "std_msgs/String")}


def test_a_crash_keeps_what_was_seen_and_shows_only_the_nodes_own_frames(tmp_path: Path) -> None:
    script = write_node(
        tmp_path,
        """
        import rospy
        from std_msgs.msg import String
        rospy.init_node("n")
        rospy.Publisher("news", String, queue_size=1)
        rospy.get_param("~missing")
        """,
    )
    found = trace(script)
    assert found.outcome.reason == "it ended with exit code 1: KeyError: '~missing'"
    assert own(found) == {("publisher", "news", "std_msgs/String")}
    shown = "\n".join(found.outcome.stderr_tail)
    assert 'node.py", line 7' in shown
    assert "preflight" not in shown.replace(str(tmp_path), "")


def test_a_crash_in_an_import(tmp_path: Path) -> None:
    found = trace(write_node(tmp_path, "import rospy\nfrom os import foo\n"))
    assert found.outcome.reason is not None
    assert found.outcome.reason.startswith("it ended with exit code 1: ImportError: cannot import name 'foo' from 'os'")


def test_a_package_that_a_node_does_not_find(tmp_path: Path) -> None:
    said = "raise type('ResourceNotFound', (Exception,), {'__module__': 'rospkg.common'})"
    interface = trace(write_node(tmp_path, f"{said}('smach_ros\\nROS path [0]=/usr/share')\n"))
    assert interface.outcome.reason == "it ended with exit code 1: rospkg.common.ResourceNotFound: smach_ros"


def test_a_signal_is_named(tmp_path: Path) -> None:
    found = trace(write_node(tmp_path, "import os\nos.kill(os.getpid(), 11)\n"))
    assert (found.outcome.status, found.outcome.signal) == ("crashed", "SIGSEGV")
    assert found.outcome.reason == "it was killed by SIGSEGV"


def test_an_interpreter_that_is_not_there(tmp_path: Path) -> None:
    script = write_node(tmp_path, "")
    script.write_text("#!/usr/bin/env python3.99\nimport rospy\n")
    found = trace(script)
    assert found.outcome.status == "crashed"
    assert "python3.99" in str(found.outcome.reason)


def test_an_executable_without_the_permission(tmp_path: Path) -> None:
    script = write_node(tmp_path, "")
    script.write_text("#!/bin/sh\n")
    script.chmod(0o644)
    found = trace(script)
    assert found.outcome.reason == "the executable cannot be started: Permission denied"


def test_waiting_for_a_service_is_told(tmp_path: Path) -> None:
    found = trace(TUTORIALS / "connection_client.py")
    assert found.outcome.status == "spinning"
    assert found.notes == ("it waits for the service set_cookies, and was told that it is there",)
    assert own(found) == {("client", "set_cookies", "std_srvs/SetBool")}


def test_a_pause_is_no_event_loop(tmp_path: Path) -> None:
    script = write_node(
        tmp_path,
        """
        import rospy
        from std_msgs.msg import String
        rospy.init_node("n")
        rospy.Publisher("early", String, queue_size=1)
        rospy.sleep(1.0)
        rospy.Publisher("late", String, queue_size=1)
        rospy.spin()
        """,
    )
    assert {name for _, name, _ in own(trace(script))} == {"early", "late"}


def test_endpoints_made_in_a_thread_while_the_main_thread_spins(tmp_path: Path) -> None:
    script = write_node(
        tmp_path,
        """
        import rospy, threading, time
        from std_msgs.msg import String
        def work():
            time.sleep(0.2)
            rospy.Publisher("from_a_thread", String, queue_size=1)
            time.sleep(100)
        rospy.init_node("n")
        threading.Thread(target=work, daemon=True).start()
        rospy.spin()
        """,
    )
    found = trace(script)
    assert (found.outcome.status, own(found)) == ("spinning", {("publisher", "from_a_thread", "std_msgs/String")})


@pytest.mark.parametrize(
    "loop",
    ["while not rospy.is_shutdown(): time.sleep(30)", "threading.Event().wait()", "signal.pause()"],
)
def test_event_loops_of_other_kinds(tmp_path: Path, loop: str) -> None:
    script = write_node(
        tmp_path,
        f"""
        import rospy, signal, threading, time
        from std_msgs.msg import String
        rospy.init_node("n")
        rospy.Publisher("news", String, queue_size=1)
        {loop}
        """,
    )
    found = trace(script)
    assert (found.outcome.status, own(found)) == ("spinning", {("publisher", "news", "std_msgs/String")})


def test_calls_past_the_library_are_seen_by_the_master(tmp_path: Path) -> None:
    script = write_node(
        tmp_path,
        """
        import os, rosgraph, rospy
        rospy.init_node("n")
        master = rosgraph.Master(rospy.get_name())
        master.registerPublisher("/raw", "std_msgs/String", rospy.get_node_uri())
        master.hasParam("/raw_param")
        rospy.spin()
        """,
    )
    found = trace(script)
    assert own(found) == {("publisher", "/raw", "std_msgs/String")}
    assert ("has", "/raw_param") in params(found)


def test_subclasses_and_own_sitecustomize_keep_working(tmp_path: Path) -> None:
    (tmp_path / "sitecustomize.py").write_text("import builtins\nbuiltins.customised = __file__\n")
    script = write_node(
        tmp_path,
        """
        import inspect, rospy, sys
        from std_msgs.msg import String
        class Loud(rospy.Publisher):
            def __init__(self, name):
                super().__init__(name, String, queue_size=1)
        assert customised.endswith("/sitecustomize.py"), customised
        assert "preflight" not in repr(sys.path), sys.path
        assert rospy.Publisher.__init__.__name__ == "__init__"
        rospy.init_node("n")
        Loud("loud")
        rospy.spin()
        """,
    )
    found = trace(script, env=(("PYTHONPATH", str(tmp_path)),))
    assert (found.outcome.reason, own(found)) == (None, {("publisher", "loud", "std_msgs/String")})


@pytest.mark.ros
@pytest.mark.parametrize(
    ("first", "why"),
    [
        ("#!/opt/nowhere/python2", "there is no '/opt/nowhere/python2', which its first line names"),
        ("#!/usr/bin/env python2.1", "there is no 'python2.1' on the PATH, which its first line names"),
        (
            "#!/usr/bin/python3\r",
            "there is no '/usr/bin/python3', which its first line names; the file has the line ends of Windows",
        ),
        (
            "#!/usr/bin/env python3\r",
            "there is no 'python3' on the PATH, which its first line names; the file has the line ends of Windows",
        ),
    ],
)
def test_an_interpreter_that_is_missing_is_named(tmp_path: Path, first: str, why: str) -> None:
    script = write_node(tmp_path, "import rospy\n")
    script.write_bytes(f"{first}\nimport rospy\n".encode())
    outcome = trace(script).outcome
    assert (outcome.status, outcome.exit_code) == ("crashed", 127)
    assert outcome.reason == f"the executable cannot be started: {why}"


@pytest.mark.ros
@pytest.mark.parametrize("first", ["#!/usr/bin/env python", "#!/opt/nowhere/python", "#!/opt/nowhere/python -u"])
def test_python_is_python_3_where_only_that_is_there(tmp_path: Path, first: str) -> None:
    programs = tmp_path / "bin"
    programs.mkdir()
    for name in ("env", "python3", "sh"):
        (programs / name).symlink_to(f"/usr/bin/{name}")
    script = write_node(tmp_path, "")
    body = "import rospy\nrospy.init_node('n')\nrospy.Subscriber('scan', rospy.AnyMsg, print)\nrospy.spin()\n"
    script.write_text(f"{first}\n{body}")
    found = trace(script, variables={"PATH": str(programs)})
    assert found.outcome.status == "spinning", found.outcome
    assert own(found) == {("subscriber", "scan", "*")}


def test_what_is_known_is_known_kind_by_kind() -> None:
    ends = Endpoint("publisher", "scan", None), Endpoint("service", "~/get_state", None, builtin=True)
    bridge = Interface("source", Outcome("not-run"), ends, whole=ENDS)
    assert (bridge.tells_all(*ENDS), bridge.tells_all("parameters"), bridge.likely_complete) == (True, False, True)
    catalogued = Interface("catalogue", Outcome("not-run"), ends)
    assert [kind for kind in KINDS if catalogued.speaks_of(kind)] == ["topics"]
    assert [kind for kind in KINDS if bridge.speaks_of(kind)] == list(KINDS)
    assert not any(map(catalogued.tells_all, KINDS))
    assert not any(map(NOT_RUN.speaks_of, KINDS))
