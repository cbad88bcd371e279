"""What rclpy nodes do, read from their source."""

from __future__ import annotations

from pathlib import Path

from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.tracing.interface import CHANGE_STATE, KINDS, NOT_RUN, Interface, Range
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

NODE = """
import rclpy
from rclpy.action import ActionServer
from rclpy.node import Node
from rclpy.parameter import Parameter
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from geometry_msgs.msg import Twist
from nav_msgs.msg import OccupancyGrid
from nav2_msgs.action import NavigateToPose
from sensor_msgs.msg import LaserScan
from std_srvs.srv import Empty
from robot.base import Base, TOPIC


class Driver(Base):
    def __init__(self):
        super().__init__('driver')
        self.declare_parameters('limits', [('speed', 1.5), ('turn',)])
        self.topic = self.declare_parameter('cmd_topic', 'cmd_vel').value
        limits = [FloatingPointRange(from_value=0.0, to_value=2.0, step=0.5)]
        fixed = ParameterDescriptor(description='d', read_only=True, floating_point_range=limits)
        self.declare_parameter('gain', 1.0, fixed)
        self.declare_parameter('typed', Parameter.Type.INTEGER_ARRAY)
        anything = ParameterDescriptor()
        anything.dynamic_typing = True
        self.declare_parameter('any', 1, descriptor=anything)
        self.create_subscription(Twist, self.topic, self.on_command, 10)
        self.create_subscription(LaserScan, 'scan', self.on_scan, qos_profile_sensor_data)
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.maps = self.create_publisher(OccupancyGrid, TOPIC, latched)
        self.server = ActionServer(self, NavigateToPose, 'navigate', self.execute)
        if self.get_parameter('service').get_parameter_value().bool_value:
            self.create_service(Empty, '~/reset', self.reset)
        self.timer = self.create_timer(0.1, self.tick)

    def tick(self):
        self.client = self.create_client(Empty, '/global/reset')


def main(args=None):
    rclpy.init(args=args)
    rclpy.spin(Driver())
"""
BASE = """
from rclpy.lifecycle import LifecycleNode
TOPIC = 'map'


class Base(LifecycleNode):
    def __init__(self, name):
        super().__init__(name)
        self.declare_parameter('service', True)
"""
LAUNCH = """<launch>
  <node pkg="robot" exec="driver" name="driver">
    <param name="cmd_topic" value="drive"/>
    <remap from="scan" to="/front/scan"/>
  </node>
</launch>
"""
MANIFEST = "<package><name>robot</name><export><build_type>ament_python</build_type></export></package>"
SETUP = "from setuptools import setup\nsetup(entry_points={'console_scripts': ['driver = robot.driver:main']})\n"


def interface(
    tmp_path: Path, launch: str = LAUNCH, base: str = BASE, setup: str = SETUP, modules: str = "", node: str = NODE
) -> Interface:
    files = {
        "package.xml": MANIFEST,
        "setup.py": setup,
        f"{modules}robot/__init__.py": "",
        f"{modules}robot/base.py": base,
        f"{modules}robot/driver.py": node,
        "launch/robot.launch.xml": launch,
    }
    for name, text in files.items():
        path = tmp_path / "src" / "robot" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    environment = detect_environment(str(tmp_path), {}, root=str(tmp_path / "nothing"))
    workspace = Workspace(environment, Sources())
    analysis = workspace.static(str(tmp_path / "src/robot/launch/robot.launch.xml"))
    done = workspace.with_interfaces(analysis, [NOT_RUN], "not run here")
    assert done.graph is not None
    assert node is not NODE or "/front/scan" in done.graph.topics
    return done.graph.interfaces[0]


def test_a_node_of_a_class_of_its_own(tmp_path: Path) -> None:
    found = interface(tmp_path)
    assert found.source == "source"
    assert sorted((e.role, e.name, e.type) for e in found.endpoints if not e.builtin) == [
        ("action_server", "navigate", "nav2_msgs/action/NavigateToPose"),
        ("client", "/global/reset", "std_srvs/srv/Empty"),
        ("publisher", "map", "nav_msgs/msg/OccupancyGrid"),
        ("service", "~/reset", "std_srvs/srv/Empty"),
        ("subscriber", "drive", "geometry_msgs/msg/Twist"),
        ("subscriber", "scan", "sensor_msgs/msg/LaserScan"),
    ]
    assert {u.name: u.default for u in found.params} == {
        "~service": True,
        "~limits.speed": 1.5,
        "~limits.turn": None,
        "~cmd_topic": "cmd_vel",
        "~gain": 1.0,
        "~typed": None,
        "~any": 1,
    }
    about = {u.name: u for u in found.params}
    assert (about["~gain"].read_only, about["~gain"].range) == (True, Range(0.0, 2.0, 0.5))
    assert (about["~typed"].type, about["~any"].dynamic) == ("integer array", True)
    qos = {e.name: dict(e.qos) for e in found.endpoints if e.qos}
    assert qos == {
        "drive": {"reliability": "reliable", "durability": "volatile", "depth": 10},
        "scan": {"reliability": "best_effort", "durability": "volatile", "depth": 5},
        "map": {"reliability": "reliable", "durability": "transient_local", "depth": 1},
    }
    line = next(e.source_line for e in found.endpoints if e.name == "map")
    assert NODE.splitlines()[(line or 0) - 1].strip().startswith("self.maps")


def test_modules_in_a_folder_of_their_own_find_each_other(tmp_path: Path) -> None:
    setup = SETUP.replace("setup(", "setup(package_dir={'': 'src'}, ")
    found = interface(tmp_path / "a", setup=setup, modules="src/")
    plain = interface(tmp_path / "b")
    assert [(e.role, e.name) for e in found.endpoints] == [(e.role, e.name) for e in plain.endpoints]
    assert found.params


def test_who_is_given_the_node_may_make_more_with_it(tmp_path: Path) -> None:
    made = {"known": "Part()", "unknown": "object.__subclasses__()[0]()"}
    whole = {}
    for name, part in made.items():
        gives = f"        self.declare_parameter('service', True)\n        part = {part}\n        part.node = self\n"
        base = BASE.replace("        self.declare_parameter('service', True)\n", gives)
        whole[name] = interface(tmp_path / name, base=base + "\n\nclass Part:\n    pass\n").whole
    assert whole == {"known": KINDS, "unknown": ()}


def test_what_the_launch_file_sets_decides(tmp_path: Path) -> None:
    found = interface(tmp_path, LAUNCH.replace('name="cmd_topic" value="drive"', 'name="service" value="false"'))
    assert not any(e.role == "service" and not e.builtin for e in found.endpoints)
    assert any(e.name == "cmd_vel" for e in found.endpoints)


def test_parameters_that_are_declared_from_overrides_have_their_type(tmp_path: Path) -> None:
    for option, dynamic in (
        ("automatically_declare_parameters_from_overrides", True),
        ("allow_undeclared_parameters", False),
    ):
        found = interface(tmp_path, base=BASE.replace("__init__(name)", f"__init__(name, {option}=True)"))
        assert {use.dynamic for use in found.params if use.name in ("~service", "~gain", "~cmd_topic")} == {dynamic}
        assert "list" in {use.access for use in found.params}


BRIDGE = """
import rclpy
from rclpy.node import Node
{imports}
from bridge import Protocol

class Bridge(Node):
    def __init__(self):
        super().__init__("bridge")
        Protocol.timeout = self.declare_parameter("timeout", Protocol.timeout).value

if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(Bridge())
"""


def test_modules_that_cmake_installs_are_followed_each_once(tmp_path: Path) -> None:
    """However often they are imported: what is bounded is how many there are."""
    files = {
        "package.xml": "<package><name>bridge</name><export><build_type>ament_cmake</build_type></export></package>",
        "CMakeLists.txt": "project(bridge)\nament_python_install_package(${PROJECT_NAME} PACKAGE_DIR src/bridge)\n"
        "install(PROGRAMS scripts/run.py DESTINATION lib/${PROJECT_NAME})\n",
        "src/bridge/__init__.py": "from .protocol import Protocol\n",
        "src/bridge/protocol.py": "class Protocol(Unknown):\n    timeout = 10.0\n",
        "src/bridge/other.py": "",
        "scripts/run.py": BRIDGE.format(imports="from bridge.other import a\n" * 40),
        "launch/a.launch.xml": '<launch><node pkg="bridge" exec="run.py"/></launch>',
    }
    for name, text in files.items():
        path = tmp_path / "src" / "bridge" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    environment = detect_environment(str(tmp_path), {}, root=str(tmp_path / "nothing"))
    workspace = Workspace(environment, Sources())
    analysis = workspace.static(str(tmp_path / "src/bridge/launch/a.launch.xml"))
    done = workspace.with_interfaces(analysis, [NOT_RUN], "not run here")
    assert done.graph is not None
    assert {use.name: use.default for use in done.graph.interfaces[0].params} == {"~timeout": 10.0}


LIFECYCLE = """
import rclpy
from rclpy.lifecycle import {}


class Managed({}):
    def __init__(self):
        super().__init__('managed')
        self.create_timer(1.0, self.start)

    def start(self):
        {}


def main():
    rclpy.init()
    rclpy.spin(Managed())
"""


def test_lifecycle_nodes_and_the_transitions_that_they_make_by_themselves(tmp_path: Path) -> None:
    own = "self.trigger_configure(); self.trigger_activate()"
    for name, body, transitions in (
        ("LifecycleNode", "pass", ()),
        ("Node", "self.trigger_configure()", ("configure",)),
        ("Node", own, ("activate", "configure")),
    ):
        found = interface(tmp_path / f"{name}{len(body)}", base="", node=LIFECYCLE.format(name, name, body))
        assert [end.type for end in found.endpoints if end.name == "~/change_state"] == [CHANGE_STATE]
        assert found.transitions == transitions


def test_what_is_declared_after_a_check_that_raises(tmp_path: Path) -> None:
    check = """self.path = self.declare_parameter('path', '').value
        if not self.path:
            raise RuntimeError('path is required')
        self.declare_parameter('late', 1.0)
        self.timer ="""
    found = interface(tmp_path, node=NODE.replace("self.timer =", check))
    assert {"~path", "~late"} <= {use.name for use in found.params}


def test_what_is_not_come_to_is_not_declared(tmp_path: Path) -> None:
    check = """if not self.declare_parameter('path', '').value:
            return
        self.declare_parameter('late', 1.0)
        self.timer ="""
    found = interface(tmp_path, node=NODE.replace("self.timer =", check))
    assert "~late" not in {use.name for use in found.params}
