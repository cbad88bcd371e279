"""`watch` beside real nodes of rclpy, in a domain of their own."""

from __future__ import annotations

import os
import signal
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from support.live_harness import LIMIT_SECONDS, Ros2System, Watching, preflight, private_domain
from support.ros2_harness import node_of

pytestmark = pytest.mark.ros

TALKER = node_of(
    """
    self.create_publisher(String, 'chatter', 10)
    self.create_service(Trigger, '~/reset', print)
    """,
    "from std_srvs.srv import Trigger",
)
LISTENER = node_of("self.create_subscription(String, 'chatter', print, 10)")
OTHER = node_of("self.create_publisher(Int32, 'chatter', qos_profile_sensor_data)", "from std_msgs.msg import Int32",
                "from rclpy.qos import qos_profile_sensor_data")  # fmt: skip
CALLER = node_of("self.create_client(Trigger, 'talker/reset')", "from std_srvs.srv import Trigger")
CAMERA = """
import rclpy
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from std_msgs.msg import String


class Camera(LifecycleNode):
    def __init__(self):
        super().__init__('camera')

    def on_configure(self, state):
        self.image = self.create_lifecycle_publisher(String, 'image', 10)
        return TransitionCallbackReturn.SUCCESS


def main():
    rclpy.init()
    node = Camera()
    {then}
    rclpy.spin(node)
"""
LAUNCH = """<launch>
<node pkg='pkg' exec='talker' name='talker' namespace='robot'/>
<node pkg='pkg' exec='listener'><remap from='chatter' to='/robot/chatter'/></node>
</launch>"""


@pytest.fixture
def system(tmp_path: Path) -> Iterator[Ros2System]:
    with private_domain() as domain:
        modules = {"talker": TALKER, "listener": LISTENER, "other": OTHER, "caller": CALLER}
        system = Ros2System(tmp_path, domain, LAUNCH, camera=CAMERA.format(then="pass"), **modules)
        yield system
        system.close()


@pytest.fixture
def watch(system: Ros2System) -> Iterator[Watching]:
    watching = Watching(system.environment, system.file, "--settle", "0")
    yield watching
    watching.close()


def launched(system: Ros2System) -> subprocess.Popen[bytes]:
    """What `ros2 launch` would start; the one that may be killed."""
    system.start("listener", "chatter:=/robot/chatter")
    return system.start("talker", "__node:=talker", "__ns:=/robot")


def told(message: str) -> Callable[[dict[str, Any]], bool]:
    """Whether a state has exactly this for information."""
    return lambda event: [i["message"] for i in event.get("issues", ()) if not i["counts"]] == [message]


def helpers(domain: str) -> list[str]:
    """The processes that look at this domain for us."""
    found = []
    for process in Path("/proc").glob("[0-9]*"):
        try:
            environment = (process / "environ").read_bytes().split(b"\0")
            command = (process / "cmdline").read_text(errors="replace")
        except OSError:
            continue
        if f"ROS_DOMAIN_ID={domain}".encode() in environment and "ros2_helper" in command:
            found.append(process.name)
    return found


def test_the_stream_tells_of_a_start_a_death_and_extra_nodes(system: Ros2System, watch: Watching) -> None:
    attached = watch.until(lambda event: event["event"] != "waiting")
    assert attached == {
        "schema": "ros-preflight/watch/1",
        "event": "attached",
        "to": f"ROS 2 domain {system.environment['ROS_DOMAIN_ID']}",
    }
    watch.until_told("/robot/talker is not running", "/own is not running")
    talker = launched(system)
    same = watch.until_told()
    assert (same["nodes"], same["topics"], same["services"]) == (
        {"/robot/talker": "present", "/own": "present"},
        {"/robot/chatter": "present"},
        {"/robot/talker/reset": "present"},
    )

    talker.kill()
    gone = watch.until_told("/robot/talker is not running")
    (issue,) = gone["issues"]
    assert issue["place"] == {"file": str(system.file), "line": 2, "column": 1}
    assert gone["topics"] == {"/robot/chatter": "missing"}

    system.start("talker", "__node:=talker", "__ns:=/robot")
    watch.until_told()
    extra = system.start("talker", "__node:=more")
    watch.until_told("/more is running but is not in the launch file")
    extra.send_signal(signal.SIGINT)
    watch.until_told()

    (helper,) = helpers(system.environment["ROS_DOMAIN_ID"])
    os.kill(int(helper), signal.SIGKILL)
    assert watch.process.wait(LIMIT_SECONDS) == 2
    assert helpers(system.environment["ROS_DOMAIN_ID"]) == []


def test_a_wrong_type_and_a_misspelt_topic_are_told(system: Ros2System, watch: Watching) -> None:
    system.start("listener", "chatter:=/robot/chater")
    system.start("other", "__node:=talker", "__ns:=/robot")
    found = (
        "/own does not subscribe to /robot/chatter (std_msgs/msg/String); it subscribes to /robot/chater",
        "/robot/talker does not offer the service /robot/talker/reset (std_srvs/srv/Trigger)",
        "/robot/talker publishes /robot/chatter with the type std_msgs/msg/Int32; expected std_msgs/msg/String",
    )
    watch.until_told(*found)
    system.start("other", "__node:=talker", "__ns:=/robot")
    watch.until_told(*found, "/robot/talker runs 2 times")


def test_clients_are_seen(system: Ros2System, watch: Watching) -> None:
    system.start("caller", "__node:=own")
    watch.until(told("/own calls the service /talker/reset (std_srvs/srv/Trigger), which is unexpected"))


def test_an_action_is_one_thing(system: Ros2System, watch: Watching) -> None:
    # What rcl_action knows an action by; there is no package with one to install.
    parts = node_of(
        """
        self.create_publisher(String, 'go/_action/feedback', 10)
        self.create_publisher(String, 'go/_action/status', 10)
        self.create_service(Trigger, 'go/_action/send_goal', print)
        """,
        "from std_srvs.srv import Trigger",
    )
    system.harness.write("pkg/acting.py", parts)
    system.start("acting")
    watch.until(told("/own offers the action /go (std_msgs/msg/String), which is unexpected"))
    assert watch.seen[-1]["actions"] == {"/go": "extra"}


def test_a_lifecycle_node_that_is_not_active_is_said_to_be_so(system: Ros2System) -> None:
    file = system.harness.write(
        "launch/camera.launch.xml", "<launch><node pkg='pkg' exec='camera' name='camera'/></launch>"
    )
    watch = Watching(system.environment, file, "--settle", "0")
    try:
        camera = system.start("camera")
        watch.until(told("/camera does not publish /image (std_msgs/msg/String); the lifecycle node is unconfigured"))
        assert (watch.seen[-1]["same"], watch.seen[-1]["nodes"]) == (True, {"/camera": "inactive"})
        camera.kill()
        camera.wait()
        watch.until_told("/camera is not running")
        then = "node.trigger_configure(); node.trigger_activate()"
        system.harness.write("pkg/camera_up.py", CAMERA.format(then=then))
        system.start("camera_up")
        active = watch.until_told()
        assert active["nodes"] == {"/camera": "present"}
    finally:
        watch.close()


def test_once_waits_until_the_system_is_as_expected(system: Ros2System) -> None:
    launched(system)
    done = preflight(system.environment, "watch", system.file, "--once", "--timeout", "60")
    assert (done.code, done.out, done.err) == (0, "no differences, 2 nodes as expected\n", "")
    assert helpers(system.environment["ROS_DOMAIN_ID"]) == []


def test_quality_of_service_is_compared(system: Ros2System, watch: Watching) -> None:
    body = (system.harness.package / "pkg/other.py").read_text().replace("Int32", "String")
    system.harness.write("pkg/other.py", body)
    system.start("other", "__node:=talker", "__ns:=/robot")
    event: dict[str, Any] = watch.until(
        lambda event: event["event"] == "state" and any(i["kind"] == "wrong-qos" for i in event["issues"])
    )
    (issue,) = (i for i in event["issues"] if i["kind"] == "wrong-qos")
    assert (issue["expected"], issue["actual"]) == ("reliability reliable", "reliability best_effort")


def test_without_rclpy_that_is_told(system: Ros2System, tmp_path: Path) -> None:
    environment = {**system.environment, "PATH": "/usr/bin:/bin"}
    done = preflight(environment, "watch", system.file, "--once", "--timeout", "60", "--no-run")
    assert (done.code, done.out) == (2, "")
    assert "rclpy was not found" in done.err
