"""`watch` beside what real roslaunch started, with a master of its own."""

from __future__ import annotations

import http.server
import json
import os
import signal
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from preflight_analysis.live.model import CannotObserveError
from preflight_analysis.live.observe_ros1 import Ros1Observer
from support.command import Done
from support.live_harness import Ros1System, Watching, differences, preflight
from support.waiting import until

pytestmark = pytest.mark.ros

TALKER = "rospy.Publisher('chatter', String, queue_size=1)\nrospy.Service('~reset', Trigger, print)"
LISTENER = "rospy.Subscriber('chatter', String, print)"
LAUNCH = """
<node pkg="pkg" type="talker.py" name="talker" ns="robot"/>
<node pkg="pkg" type="listener.py" name="$(anon listener)">
  <remap from="chatter" to="/robot/chatter"/>
</node>
"""


@pytest.fixture
def system(tmp_path: Path) -> Iterator[Ros1System]:
    system = Ros1System(tmp_path)
    system.node("talker.py", TALKER)
    system.node("listener.py", LISTENER)
    yield system
    system.close()


@pytest.fixture
def watching(system: Ros1System) -> Iterator[Callable[..., Watching]]:
    started = []

    def start(*args: str | Path) -> Watching:
        started.append(Watching(system.environment, *args))
        return started[-1]

    yield start
    for each in started:
        each.close()


def test_what_was_launched_is_as_expected(system: Ros1System) -> None:
    file = system.launch_file(LAUNCH)
    system.launch(file)
    done = preflight(system.environment, "watch", file, "--once", "--timeout", "60")
    assert (done.code, done.out, done.err) == (0, "no differences, 2 nodes as expected\n", "")


def test_each_kind_of_difference_is_told_with_its_line(system: Ros1System, watching: Callable[..., Watching]) -> None:
    node = system.node
    node("other_talker.py", "rospy.Publisher('chatter', Int32, queue_size=1)\nrospy.Service('~reset', Empty, print)")
    system.launch(
        system.launch_file(
            '<node pkg="pkg" type="other_talker.py" name="talker"/>\n'
            '<node pkg="pkg" type="listener.py" name="listener"><remap from="chatter" to="chater"/></node>\n'
            '<node pkg="pkg" type="listener.py" name="more"/>'
        )
    )
    file = system.launch_file(
        '<node pkg="pkg" type="talker.py" name="talker"/>\n'
        '<node pkg="pkg" type="listener.py" name="listener"/>\n'
        '<node pkg="pkg" type="listener.py" name="gone"/>',
        "expected.launch",
    )
    watching(file, "--settle", "0").until_told(
        "/talker publishes /chatter with the type std_msgs/Int32; expected std_msgs/String",
        "/talker offers the service /talker/reset with the type std_srvs/Empty; expected std_srvs/Trigger",
        "/listener does not subscribe to /chatter (std_msgs/String); it subscribes to /chater",
        "/gone is not running",
        "/more is running but is not in the launch file",
    )
    expected = [
        f"{file}:2: wrong-type: /talker publishes /chatter with the type std_msgs/Int32; "
        f"expected std_msgs/String (made at {system.package / 'talker.py'}:6)",
        f"{file}:2: wrong-type: /talker offers the service /talker/reset with the type std_srvs/Empty; "
        f"expected std_srvs/Trigger (made at {system.package / 'talker.py'}:7)",
        f"{file}:3: missing: /listener does not subscribe to /chatter (std_msgs/String); it subscribes to /chater "
        f"(made at {system.package / 'listener.py'}:6)",
        f"{file}:3: extra (info): /listener subscribes to /chater (std_msgs/String), which is unexpected",
        f"{file}:4: missing: /gone is not running",
        "extra: /more is running but is not in the launch file",
        "5 differences, 0 nodes as expected",
    ]

    def looked(*options: str) -> Done:
        return preflight(system.environment, "watch", file, "--once", "--timeout", "0", *options)

    until(lambda: sorted(looked().out.splitlines()) == sorted(expected))
    assert looked().code == 1
    allowed = [line.replace("extra: /more", "extra (info): /more").replace("5 diff", "4 diff") for line in expected]
    until(lambda: sorted(looked("--allow-extra").out.splitlines()) == sorted(allowed))


def test_the_stream_tells_of_a_start_a_death_an_extra_node_and_a_new_master(
    system: Ros1System, watching: Callable[..., Watching]
) -> None:
    file = system.launch_file(LAUNCH)
    watch = watching(file, "--settle", "0")
    waiting = watch.until(lambda event: event["event"] == "waiting")
    assert waiting == {
        "schema": "ros-preflight/watch/1",
        "event": "waiting",
        "reason": f"the master at http://127.0.0.1:{system.port}/ does not answer: connection refused",
    }
    launch = system.launch(file)
    watch.until(lambda event: event["event"] == "attached")
    same = watch.until_told()
    assert (same["same"], same["issues"], same["topics"]) == (True, [], {"/robot/chatter": "present"})
    assert same["services"] == {"/robot/talker/reset": "present"}
    assert same["nodes"] == {"/robot/talker": "present", "/listener_ANON1": "present"}

    os.kill(system.pid("/robot/talker"), signal.SIGKILL)
    dead = watch.until_told("/robot/talker is registered and does not answer: connection refused")
    (issue,) = dead["issues"]
    assert (issue["kind"], issue["place"]) == ("dead", {"file": str(file), "line": 3, "column": 1})
    assert (dead["nodes"]["/robot/talker"], dead["topics"]) == ("dead", {"/robot/chatter": "dead"})

    listener = system.pid(next(name for name in system.node_names() if name.startswith("/listener_")))
    os.kill(listener, signal.SIGSTOP)
    watch.until(lambda event: any("no answer within" in message for message in differences(event)))
    os.kill(listener, signal.SIGCONT)
    watch.until_told("/robot/talker is registered and does not answer: connection refused")

    system.start(system.package / "talker.py", "__name:=other")
    watch.until_told(
        "/robot/talker is registered and does not answer: connection refused",
        "/other is running but is not in the launch file",
    )
    system.shut_down("/other")
    watch.until_told("/robot/talker is registered and does not answer: connection refused")

    system.stop(launch)
    watch.until(lambda event: event["event"] == "waiting")
    system.launch(file)
    assert watch.until(lambda event: event["event"] != "waiting")["event"] == "restarted"
    assert watch.until_told()["same"]
    code, last = watch.interrupted()
    assert code == (0 if last["same"] else 1)


def test_a_master_that_is_not_there_is_told(system: Ros1System) -> None:
    file = system.launch_file(LAUNCH)
    done = preflight(system.environment, "watch", file, "--once", "--timeout", "0", "--no-run", "--format", "json")
    assert (done.code, json.loads(done.out)["event"]) == (2, "waiting")
    assert "does not answer: connection refused" in done.err
    done = preflight({**system.environment, "ROS_MASTER_URI": "robot:11311"}, "watch", file, "--once", "--no-run")
    assert (done.code, done.out) == (2, "")


GARBAGE = [
    b"",
    b"no XML",
    b"<methodResponse/>",
    b"<methodResponse><params><param><value><struct><member><value/></member></struct></value></param></params>"
    b"</methodResponse>",
    b"<methodResponse><params><param><value><array><data><value><int>1</int></value><value>ok</value>"
    b"<value><int>7</int></value></data></array></value></param></params></methodResponse>",
    b"<methodResponse><params><param><value><array><data><value><int>1</int></value><value>ok</value>"
    b"<value><array><data><value>abc</value></data></array></value></data></array></value></param></params>"
    b"</methodResponse>",
    b"<methodResponse><params><param><value><int>x</int></value></param></params></methodResponse>",
    b"<methodResponse><params><param>" + b"<value><array><data>" * 3000,
    b"<methodResponse></value></data></array></member></methodResponse>",
]


@pytest.mark.parametrize("answer", GARBAGE)
def test_what_is_no_master_is_told(answer: bytes) -> None:
    class Handler(http.server.BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            self.send_response(200)
            self.send_header("Content-Length", str(len(answer)))
            self.end_headers()
            self.wfile.write(answer)

        def log_message(self, *args: object) -> None:
            pass

    server = http.server.HTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    observer = Ros1Observer(f"http://127.0.0.1:{server.server_port}/")
    try:
        with pytest.raises(CannotObserveError, match="does not answer"):
            observer.observe()
    finally:
        observer.close()
        server.shutdown()
        server.server_close()
