"""`why --live` beside real nodes of rclpy: what keeps them apart in the running system."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import pytest
from support.live_harness import Ros2System, preflight, private_domain
from support.ros2_harness import node_of
from support.waiting import until

pytestmark = pytest.mark.ros

SENSOR = "from rclpy.qos import qos_profile_sensor_data"
TALKER = node_of("self.create_publisher(String, 'chatter', qos_profile_sensor_data)", SENSOR)
LISTENER = node_of("self.create_subscription(String, 'chatter', print, 10)")
CAMERA = """
import rclpy
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from std_msgs.msg import String


class Camera(LifecycleNode):
    def __init__(self):
        super().__init__('camera')

    def on_configure(self, state):
        self.image = self.create_lifecycle_publisher(String, 'chatter', 10)
        return TransitionCallbackReturn.SUCCESS


def main():
    rclpy.init()
    node = Camera()
    node.trigger_configure()
    rclpy.spin(node)
"""
LAUNCH = """<launch>
<node pkg='pkg' exec='talker' name='talker'/>
<node pkg='pkg' exec='listener' name='listener'/>
<lifecycle_node pkg='pkg' exec='camera' name='camera' namespace=''/>
</launch>"""


@pytest.fixture
def domains() -> Iterator[tuple[int, int]]:
    with private_domain() as one, private_domain() as other:
        yield one, other


@pytest.fixture
def system(tmp_path: Path, domains: tuple[int, int]) -> Iterator[Ros2System]:
    system = Ros2System(tmp_path, domains[0], LAUNCH, talker=TALKER, listener=LISTENER, camera=CAMERA)
    yield system
    system.close()


def live(system: Ros2System, first: str, wanted: Sequence[str]) -> Any:
    """The chain once exactly these links are broken in the running system."""
    found: list[Any] = []

    def broken() -> bool:
        done = preflight(
            system.environment, "why", system.file, first, "listener", "--live", "--no-run", "--format", "json"
        )
        if done.code not in (0, 1):
            return False
        (chain,) = done.json["chains"]
        found.append(chain)
        return [link["text"] for link in chain["live"] if link["state"] == "broken"] == [*wanted]

    until(broken)
    return found[-1]


def test_qos_of_real_endpoints(system: Ros2System) -> None:
    system.start("talker", "__node:=talker")
    system.start("listener", "__node:=listener")
    text = "QoS reliability: /talker offers best effort, /listener requests reliable"
    chain = live(system, "talker", [text])
    assert [link["text"] for link in chain["links"] if link["state"] == "broken"] == [text]
    assert chain["connected"] is False


def test_a_remap_that_only_the_running_node_has(system: Ros2System) -> None:
    system.start("talker", "__node:=talker", "chatter:=/chater")
    system.start("listener", "__node:=listener")
    live(system, "talker", ["/talker runs and has no publisher '/chatter'; it publishes '/chater'"])


def test_a_node_in_another_domain(system: Ros2System, domains: tuple[int, int]) -> None:
    system.start("talker", "__node:=talker", domain=domains[1])
    system.start("listener", "__node:=listener")
    live(system, "talker", ["/talker does not run"])


def test_an_inactive_lifecycle_node(system: Ros2System) -> None:
    system.start("camera")
    system.start("listener", "__node:=listener")
    live(system, "camera", ["/camera runs and is inactive: activate it"])
