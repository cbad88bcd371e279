"""Real rclpy nodes in the sandbox, run from the source of packages that were never built."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.interface import Interface, Range
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.action_package import action_package
from support.ros2_harness import Ros2Harness, ends, node_of, ros2_prefix, uses

pytestmark = pytest.mark.ros

ALL_ENDS = node_of(
    """
    self.create_publisher(String, 'chatter', 10)
    self.create_publisher(String, '~/state', QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL,
                                                        deadline=Duration(seconds=2)))
    self.create_subscription(String, '/scan', print, qos_profile_sensor_data)
    self.create_service(Empty, 'reset', print)
    self.create_client(Empty, '/map/load')
    """,
    "from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data",
    "from rclpy.duration import Duration",
    "from std_srvs.srv import Empty",
)


def test_endpoints_have_the_names_that_the_node_gave(tmp_path: Path) -> None:
    harness = Ros2Harness(tmp_path, talker=ALL_ENDS)
    found = harness.trace("talker", "<remap from='chatter' to='/elsewhere'/>", "name='n' namespace='/robot'")
    assert (found.source, found.outcome.status, found.outcome.answers, found.notes) == ("trace", "spinning", (), ())
    by_name = ends(found)
    assert {key: end.type for key, end in by_name.items()} == {
        ("publisher", "chatter"): "std_msgs/msg/String",
        ("publisher", "~/state"): "std_msgs/msg/String",
        ("subscriber", "/scan"): "std_msgs/msg/String",
        ("service", "reset"): "std_srvs/srv/Empty",
        ("client", "/map/load"): "std_srvs/srv/Empty",
    }
    assert by_name["publisher", "~/state"].qos == {
        "reliability": "reliable",
        "durability": "transient_local",
        "depth": 1,
        "deadline": 2.0,
    }
    assert by_name["subscriber", "/scan"].qos["reliability"] == "best_effort"
    chatter = by_name["publisher", "chatter"]
    line = (harness.package / "pkg/talker.py").read_text().splitlines().index(
        "        self.create_publisher(String, 'chatter', 10)"
    )  # fmt: skip
    assert (chatter.source_file, chatter.source_line) == (str(harness.package / "pkg/talker.py"), line + 1)


def test_jazzy_is_seen_as_kilted(tmp_path: Path) -> None:
    waits = """
    self.declare_parameter('rate', 10.0)
    client = self.create_client(Trigger, 'start')
    client.wait_for_service()
    assert client.call(Trigger.Request()).success
    self.create_publisher(String, 'after', 1)
    """
    harness = Ros2Harness(tmp_path, talker=ALL_ENDS, waits=node_of(waits, "from std_srvs.srv import Trigger"))
    kilted = [harness.trace("talker"), harness.trace("waits")]
    harness.variables["PATH"] = f"{ros2_prefix('jazzy') / 'bin'}:/usr/bin:/bin"
    jazzy = [harness.trace("talker"), harness.trace("waits")]
    for one, other in zip(kilted, jazzy, strict=True):
        assert other.outcome.status == "spinning"
        assert (ends(one), uses(one), one.outcome.answers) == (ends(other), uses(other), other.outcome.answers)


def test_final_names_are_those_of_the_launch(tmp_path: Path) -> None:
    harness = Ros2Harness(tmp_path, talker=ALL_ENDS)
    graph = harness.check(
        "<node pkg='pkg' exec='talker' name='n' namespace='robot'><remap from='chatter' to='/elsewhere'/></node>"
    ).graph
    assert graph is not None
    assert set(graph.topics) >= {"/elsewhere", "/robot/n/state", "/scan"}
    assert "/robot/chatter" not in graph.topics


def test_a_node_in_a_namespace_of_its_own_has_full_names(tmp_path: Path) -> None:
    body = node_of("self.create_publisher(String, 'chatter', 10)\nself.create_publisher(String, '~/own', 10)")
    harness = Ros2Harness(tmp_path, talker=body.replace("__init__('own')", "__init__('own', namespace='/there')"))
    assert set(ends(harness.trace("talker", attributes=""))) == {
        ("publisher", "/there/chatter"),
        ("publisher", "/there/own/own"),
    }


def test_parameters_are_declared_with_their_defaults(tmp_path: Path) -> None:
    body = """
    self.declare_parameter('rate', 10.0)
    self.declare_parameter('frames', ['a', 'b'])
    self.declare_parameter('typed', Parameter.Type.INTEGER)
    self.declare_parameters('wheel', [('radius', 0.1), ('count', 4)])
    topic = self.declare_parameter('topic', 'chatter').value
    self.create_publisher(String, topic, 10)
    """
    harness = Ros2Harness(tmp_path, talker=node_of(body, "from rclpy.parameter import Parameter"))
    found = harness.trace("talker", "<param name='topic' value='given'/>")
    assert {name: (use.default, use.has_default, use.mandatory) for name, use in uses(found).items()} == {
        "~rate": (10.0, True, False),
        "~frames": (["a", "b"], True, False),
        "~typed": (None, False, False),
        "~wheel.radius": (0.1, True, False),
        "~wheel.count": (4, True, False),
        "~topic": ("chatter", True, False),
    }
    assert ("publisher", "given") in ends(found)


DESCRIBED = """
self.declare_parameter('rate', 10, ParameterDescriptor(integer_range=[IntegerRange(from_value=0, to_value=50, step=5)]))
self.declare_parameter('gain', 0.5, ParameterDescriptor(
    read_only=True, floating_point_range=[FloatingPointRange(from_value=0.0, to_value=1.0)]))
self.declare_parameter('any', 'x', ParameterDescriptor(dynamic_typing=True))
self.declare_parameter('typed', Parameter.Type.STRING_ARRAY)
self.declare_parameters('', [('plain', True), ('nothing', [])])
"""
DESCRIBING = (
    "from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor",
    "from rclpy.parameter import Parameter",
)


def test_descriptors_of_parameters(tmp_path: Path) -> None:
    harness = Ros2Harness(tmp_path, talker=node_of(DESCRIBED, *DESCRIBING))
    harness.cache = TraceCache(tmp_path / "cache")
    found = [harness.trace("talker"), harness.trace("talker")]
    for interface in found:
        assert {n.removeprefix("~"): (u.type, u.dynamic, u.read_only, u.range) for n, u in uses(interface).items()} == {
            "rate": ("integer", False, False, Range(0, 50, 5)),
            "gain": ("double", False, True, Range(0.0, 1.0, 0.0)),
            "any": (None, True, False, None),
            "typed": ("string array", False, False, None),
            "plain": ("bool", False, False, None),
            "nothing": ("byte array", False, False, None),
        }
    assert [interface.cached for interface in found] == [False, True]


@pytest.mark.parametrize(
    ("params", "rule"),
    [
        ("<param name='rate' value='51'/>", "PRM017"),
        ("<param name='rate' value='12'/>", "PRM017"),
        ("<param name='gain' value='1.5'/>", "PRM017"),
        ("<param name='typed' value='[1]'/>", "PRM014"),
        ("<param name='nothing' value='[1.5]'/>", "PRM014"),
        ("<param name='gain' value='0.25'/><param name='rate' value='45'/><param name='any' value='1.5'/>", None),
    ],
)
def test_a_descriptor_is_kept_to(tmp_path: Path, params: str, rule: str | None) -> None:
    harness = Ros2Harness(tmp_path, talker=node_of(DESCRIBED, *DESCRIBING))
    analysis = harness.check(f"<node pkg='pkg' exec='talker' name='n'>{params}</node>")
    assert analysis.graph is not None
    status = analysis.graph.interfaces[0].outcome.status
    assert status == ("spinning" if rule is None else "crashed")
    assert {f.rule for f in analysis.findings if f.rule.startswith("PRM")} == ({rule} if rule is not None else set())


@pytest.mark.parametrize(
    ("xml", "python"),
    [("'5'", 5), ("'5.5'", 5.5), ("'yes sir: # &quot;x&quot;'", 'yes sir: # "x"'), ("'true'", True), ("'é😀'", "é😀")],
)
def test_parameters_arrive_as_launch_gives_them(tmp_path: Path, xml: str, python: object) -> None:
    body = f"""
    value = self.declare_parameter('value', {python!r}).value
    self.create_publisher(String, 'equal' if value == {python!r} else 'other', 10)
    """
    harness = Ros2Harness(tmp_path, talker=node_of(body))
    assert set(ends(harness.trace("talker", f"<param name='value' value={xml}/>"))) == {("publisher", "equal")}


def test_a_value_of_another_type_ends_the_node_and_says_so(tmp_path: Path) -> None:
    harness = Ros2Harness(tmp_path, talker=node_of("self.declare_parameter('rate', 10.0)"))
    analysis = harness.check("<node pkg='pkg' exec='talker' name='n'><param name='rate' value='5'/></node>")
    assert analysis.graph is not None
    outcome = analysis.graph.interfaces[0].outcome
    assert outcome.status == "crashed"
    assert "InvalidParameterTypeException" in (outcome.reason or "")
    assert {"PRM014", "TRC001"} <= {finding.rule for finding in analysis.findings}


def test_undeclared_parameters_are_no_mistake_where_the_node_takes_any(tmp_path: Path) -> None:
    body = node_of("self.create_publisher(String, 'a', 1)").replace(
        "__init__('own')", "__init__('own', automatically_declare_parameters_from_overrides=True)"
    )
    harness = Ros2Harness(tmp_path, any=body, none=node_of("self.declare_parameter('rate', 1.0)"))
    launch = "<node pkg='pkg' exec='{}' name='n'><param name='rte' value='1.0'/></node>"
    assert "PRM013" not in {finding.rule for finding in harness.check(launch.format("any")).findings}
    assert "PRM013" in {finding.rule for finding in harness.check(launch.format("none")).findings}


@pytest.mark.parametrize(("option", "rules"), [(True, set()), (False, {"PRM014", "TRC001"})])
def test_a_parameter_that_is_declared_from_overrides_has_any_type(
    tmp_path: Path, option: bool, rules: set[str]
) -> None:
    body = """
    for name, default in (('rate', 10), ('gain', 1.0)):
        try:
            self.declare_parameter(name, default)
        except ParameterAlreadyDeclaredException:
            pass
    """
    text = node_of(body, "from rclpy.exceptions import ParameterAlreadyDeclaredException").replace(
        "__init__('own')", f"__init__('own', automatically_declare_parameters_from_overrides={option})"
    )
    launch = "<node pkg='pkg' exec='talker' name='n'><param name='rate' value='30.0'/></node>"
    assert {finding.rule for finding in Ros2Harness(tmp_path, talker=text).check(launch).findings} == rules


def test_what_a_node_waits_for_is_told_and_what_comes_after_is_speculative(tmp_path: Path) -> None:
    body = """
    self.create_publisher(String, 'before', 1)
    client = self.create_client(Trigger, 'start')
    while not client.wait_for_service(timeout_sec=1.0):
        self.get_logger().info('waiting')
    answer = client.call(Trigger.Request())
    assert answer.success
    future = client.call_async(Trigger.Request())
    rclpy.spin_until_future_complete(self, future)
    assert future.result().success
    self.create_publisher(String, 'after', 1)
    """
    harness = Ros2Harness(tmp_path, talker=node_of(body, "from std_srvs.srv import Trigger"))
    found = harness.trace("talker")
    assert found.outcome.status == "spinning"
    assert "it waits for the service /start, and was told that it is there" in found.outcome.answers
    speculative = {name: "made-up answer" in end.evidence.doubts for (_, name), end in ends(found).items()}
    assert speculative == {"before": False, "start": False, "after": True}


def test_a_first_message_is_made_up(tmp_path: Path) -> None:
    body = """
    got, message = wait_for_message(String, self, 'first')
    self.create_publisher(String, 'after' + message.data, 1)
    """
    harness = Ros2Harness(tmp_path, talker=node_of(body, "from rclpy.wait_for_message import wait_for_message"))
    found = harness.trace("talker")
    assert set(ends(found)) == {("subscriber", "first"), ("publisher", "after")}
    assert found.outcome.status == "spinning"


def test_lifecycle_nodes_are_configured_and_activated(tmp_path: Path) -> None:
    body = """
import rclpy
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from std_msgs.msg import String

class Own(LifecycleNode):
    def on_configure(self, state):
        self.create_lifecycle_publisher(String, 'made', 1)
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, state):
        self.create_subscription(String, 'active', print, 1)
        return super().on_activate(state)

def main():
    rclpy.init()
    rclpy.spin(Own('own'))
"""
    found = Ros2Harness(tmp_path, managed=body).trace("managed")
    assert set(ends(found)) == {("publisher", "made"), ("subscriber", "active")}
    assert found.outcome.status == "spinning"


def test_a_lifecycle_node_that_refuses_to_be_configured_is_not_known_to_the_end(tmp_path: Path) -> None:
    body = """
import rclpy
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from std_msgs.msg import String

class Own(LifecycleNode):
    def on_configure(self, state):
        self.create_lifecycle_publisher(String, 'made', 1)
        return TransitionCallbackReturn.FAILURE

def main():
    rclpy.init()
    rclpy.spin(Own('own'))
"""
    found = Ros2Harness(tmp_path, managed=body).trace("managed")
    assert set(ends(found)) == {("publisher", "made")}
    assert found.outcome.answers == ("it was asked to configure, as a manager of lifecycle nodes would, and did not",)
    assert not found.complete


@pytest.mark.parametrize(
    "loop",
    [
        "while rclpy.ok():\n        rclpy.spin_once(node)",
        "rclpy.executors.SingleThreadedExecutor().spin()",
        "executor = rclpy.executors.MultiThreadedExecutor()\n    executor.add_node(node)\n    executor.spin()",
        "import threading\n    threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()\n"
        "    rate = node.create_rate(20)\n    while rclpy.ok():\n        rate.sleep()",
        "import time\n    while True:\n        time.sleep(0.05)",
    ],
)
def test_event_loops(tmp_path: Path, loop: str) -> None:
    body = node_of("self.create_publisher(String, 'a', 1)", "import rclpy.executors")
    body = body.replace("rclpy.spin(Own())", f"node = Own()\n    {loop}")
    found = Ros2Harness(tmp_path, talker=body).trace("talker")
    assert (found.outcome.status, set(ends(found))) == ("spinning", {("publisher", "a")})


def test_a_package_that_is_not_built_has_its_share_folder(tmp_path: Path) -> None:
    body = """
    with open(get_package_share_directory('pkg') + '/config/topic.txt') as file:
        self.create_publisher(String, file.read(), 1)
    """
    imported = "from ament_index_python.packages import get_package_share_directory"
    harness = Ros2Harness(tmp_path, talker=node_of(body, imported))
    harness.write("config/topic.txt", "from_file")
    assert set(ends(harness.trace("talker"))) == {("publisher", "from_file")}


def test_a_node_that_needs_messages_that_are_not_built_is_run_without_them(tmp_path: Path) -> None:
    own, foreign = (node_of("pass", f"from {package}.msg import Own") for package in ("own_msgs", "foreign_msgs"))
    harness = Ros2Harness(tmp_path, own=own, foreign=foreign)
    manifest = (harness.package / "package.xml").read_text().replace(">pkg<", ">own_msgs<")
    harness.write("../own_msgs/package.xml", manifest.replace("ament_python", "ament_cmake"))
    for name in ("own", "foreign"):
        found = harness.trace(name)
        assert (found.outcome.status, f"{name}_msgs" in found.stand_ins) == ("spinning", True)


def test_a_trace_is_kept_until_what_it_depends_on_changes(tmp_path: Path) -> None:
    body = "self.create_publisher(String, self.declare_parameter('topic', 'a').value, 1)"
    harness = Ros2Harness(tmp_path / "ws", talker=node_of(body, "from pkg import helper"))
    harness.write("pkg/helper.py", "")
    harness.cache = TraceCache(tmp_path / "cache")
    assert not harness.trace("talker", "<param name='topic' value='b'/>").cached
    assert harness.trace("talker", "<param name='topic' value='b'/><param name='other' value='1'/>").cached
    assert harness.trace("talker", "<param name='topic' value='b'/><remap from='b' to='c'/>").cached
    assert not harness.trace("talker", "<param name='topic' value='c'/>").cached
    harness.write("pkg/helper.py", "x = 1")
    assert not harness.trace("talker", "<param name='topic' value='c'/>").cached


def test_traces_of_two_entry_points_of_one_module_are_told_apart(tmp_path: Path) -> None:
    body = node_of("self.create_publisher(String, os.environ.pop('TOPIC', 'a'), 1)", "import os")
    body += "\n\ndef other():\n    os.environ['TOPIC'] = 'b'\n    main()\n"
    harness = Ros2Harness(tmp_path / "ws", talker=body)
    setup = (harness.package / "setup.py").read_text()
    harness.write("setup.py", setup.replace("['talker", "['second = pkg.talker:other', 'talker"))
    harness.cache = TraceCache(tmp_path / "cache")
    assert set(ends(harness.trace("talker"))) == {("publisher", "a")}
    assert set(ends(harness.trace("second"))) == {("publisher", "b")}


def test_what_depends_on_the_name_is_traced_anew(tmp_path: Path) -> None:
    harness = Ros2Harness(
        tmp_path / "ws",
        asks=node_of("self.create_publisher(String, '/of_' + self.get_name(), 1)"),
        there=node_of("self.create_publisher(String, 'a', 1)").replace("'own')", "'own', namespace='/there')"),
    )
    harness.cache = TraceCache(tmp_path / "cache")
    assert set(ends(harness.trace("asks"))) == {("publisher", "/of_n")}
    assert set(ends(harness.trace("asks", attributes="name='m'"))) == {("publisher", "/of_m")}
    assert set(ends(harness.trace("there"))) == {("publisher", "/there/a")}
    assert set(ends(harness.trace("there", attributes="name='n' namespace='robot'"))) == {("publisher", "a")}


def test_a_crash_is_not_kept_when_its_parameters_change(tmp_path: Path) -> None:
    harness = Ros2Harness(tmp_path / "ws", talker=node_of("assert self.declare_parameter('n', 1).value == 2"))
    harness.cache = TraceCache(tmp_path / "cache")
    assert harness.trace("talker", "<param name='n' value='1'/>").outcome.status == "crashed"
    assert harness.trace("talker", "<param name='n' value='2'/>").outcome.status == "spinning"


def test_without_rclpy_nodes_are_run_all_the_same(tmp_path: Path) -> None:
    harness = Ros2Harness(tmp_path, talker=ALL_ENDS)
    launch = harness.write("launch/a.launch.xml", "<launch><node pkg='pkg' exec='talker' name='n'/></launch>")
    bare = detect_environment(str(tmp_path), {"PATH": "/usr/bin:/bin"}, root=str(tmp_path / "nothing"))
    assert bare.ros2_python is None
    workspace = Workspace(bare, Sources())
    assert None not in workspace.requests(workspace.static(str(launch)))


def test_rclpy_is_found_where_it_is(tmp_path: Path) -> None:
    prefix = ros2_prefix()
    assert detect_environment(None, {"PATH": f"/bin:{prefix}/bin"}).ros2_python == f"{prefix}/bin/python3"
    root = tmp_path / "root"
    kilted = root / "opt" / "ros" / "kilted"
    for made in (kilted / "share/ament_index/resource_index/packages/rclpy",
                 kilted / "lib/python3.12/site-packages/rclpy/__init__.py", root / "usr/bin/python3.12"):  # fmt: skip
        made.parent.mkdir(parents=True, exist_ok=True)
        made.touch(0o755)
    assert detect_environment(None, {"PATH": "/bin"}, root=str(root)).ros2_python == str(root / "usr/bin/python3.12")


@pytest.mark.parametrize("distribution", ["kilted", "jazzy"])
def test_actions_are_one_end_each_and_their_servers_are_waited_for(tmp_path: Path, distribution: str) -> None:
    body = """
    self.create_publisher(String, 'before', 1)
    self.server = ActionServer(self, Fib, 'count', print)
    self.client = ActionClient(self, Fib, '~/other')
    while not self.client.wait_for_server(timeout_sec=1.0):
        self.get_logger().info('waiting')
    self.create_publisher(String, 'after', 1)
    """
    imports = ("from rclpy.action import ActionClient, ActionServer", "from fib.action import Fib")
    harness = Ros2Harness(tmp_path, counter=node_of(body, *imports))
    package = action_package(distribution)
    harness.variables |= {
        "PATH": f"{ros2_prefix(distribution) / 'bin'}:/usr/bin:/bin",
        "PYTHONPATH": str(package.folder),
        "LD_LIBRARY_PATH": str(package.libraries),
    }
    found = harness.trace("counter")
    assert (found.outcome.status, found.notes) == ("spinning", found.outcome.answers)
    assert found.outcome.answers == ("it waits for the action server ~/other, and was told that it is there",)
    assert {key: (end.type, "made-up answer" in end.evidence.doubts) for key, end in ends(found).items()} == {
        ("publisher", "before"): ("std_msgs/msg/String", False),
        ("action_server", "count"): ("fib/action/Fib", False),
        ("action_client", "~/other"): ("fib/action/Fib", False),
        ("publisher", "after"): ("std_msgs/msg/String", True),
    }


TWO = """
import rclpy
from rclpy.node import Node


def main():
    rclpy.init()
    nodes = [Node('front'), Node('rear'), Node('kept', cli_args=['--ros-args', '-r', '__node:=kept'])]
    print([node.get_name() for node in nodes])
    executor = rclpy.executors.SingleThreadedExecutor()
    for node in nodes:
        executor.add_node(node)
    executor.spin()
"""


@pytest.mark.parametrize(("attributes", "told"), [("name='scanner'", True), ("", False)])
def test_a_name_for_a_process_with_several_nodes(tmp_path: Path, attributes: str, told: bool) -> None:
    analysis = Ros2Harness(tmp_path, both=TWO).check(f"<node pkg='pkg' exec='both' {attributes}/>")
    assert analysis.graph is not None
    (interface,) = analysis.graph.processes
    assert [(node.given, node.name) for node in interface.nodes] == [
        ("front", "scanner" if told else "front"),
        ("rear", "scanner" if told else "rear"),
        ("kept", "kept"),
    ]
    found = [finding for finding in analysis.findings if finding.rule == "LCH037"]
    assert [f.message.partition(":")[0] for f in found] == (
        ["'name' renames all nodes of this process ('front' and 'rear')"] if told else []
    )


APART = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String


def main():
    rclpy.init()
    front, rear = Node('front'), Node('rear', namespace='/back')
    front.declare_parameter('rate', 1.0)
    rear.declare_parameter('rate', 2)
    for node in (front, rear):
        node.create_publisher(String, 'scan', 10)
    executor = rclpy.executors.SingleThreadedExecutor()
    executor.add_node(front)
    executor.spin()
"""


def test_two_nodes_of_a_process_are_told_apart(tmp_path: Path) -> None:
    harness = Ros2Harness(tmp_path, both=APART)
    analysis = harness.check("<node pkg='pkg' exec='both'><remap from='scan' to='out'/></node>")
    assert analysis.graph is not None
    assert [node.name for node in analysis.graph.tree.nodes] == ["/front", "/back/rear"]
    providers = {name: [c.node.name for c in topic.providers] for name, topic in analysis.graph.topics.items()}
    assert (providers["/out"], providers["/back/out"]) == (["/front"], ["/back/rear"])
    file = harness.write(
        "p.yaml", "/back/rear:\n  ros__parameters: {rate: 2.5}\nfront:\n  ros__parameters: {rat: 1.0}\n"
    )
    analysis = harness.check(f"<node pkg='pkg' exec='both'><param from='{file}'/></node>")
    said = {f.rule: f.message.partition(";")[0] for f in analysis.findings if f.rule.startswith("PRM")}
    assert said == {
        "PRM013": "parameter 'rat' is not declared by /front",
        "PRM014": "type mismatch of parameter 'rate': got a double, /back/rear declares an integer",
    }


def test_a_node_that_asks_who_is_there_is_not_fully_known(tmp_path: Path) -> None:
    harness = Ros2Harness(tmp_path, asks=node_of("self.count_publishers('scan')"), plain=node_of("self.get_clock()"))
    assert (harness.trace("asks").looks, harness.trace("asks").complete) == (True, False)
    assert (harness.trace("plain").looks, harness.trace("plain").complete) == (False, True)


def test_a_node_without_a_name_has_that_of_its_code(tmp_path: Path) -> None:
    harness = Ros2Harness(tmp_path, talker=node_of("self.declare_parameter('rate', 1.0)"))
    own = harness.write("own.yaml", "/there/own:\n  ros__parameters: {rate: 2.5, rat: 1}\n")
    other = harness.write("other.yaml", "/there/talker:\n  ros__parameters: {rate: 2.5}\n")
    analysis = harness.check(
        f"<node pkg='pkg' exec='talker' namespace='there'><param from='{own}'/></node>"
        f"<node pkg='pkg' exec='talker' namespace='there'><param from='{other}'/></node>"
        "<node pkg='pkg' exec='talker' namespace='elsewhere'/>"
    )
    assert analysis.graph is not None
    first, second, _ = analysis.tree.nodes
    assert [node.name for node in analysis.graph.tree.nodes] == ["/there/own", "/there/own", "/elsewhere/own"]
    assert ([p.value for p in first.params], second.params) == ([2.5, 1], ())
    said = sorted(
        {
            (f.rule, f.message.partition("; its")[0].partition(":")[0])
            for f in analysis.findings
            if f.severity in ("warning", "error")
        }
    )
    assert said == [
        ("LCH016", "duplicate node name '/there/own'"),
        ("PRM011", "no section of this file applies to /there/own; it has sections for '/there/talker'"),
        ("PRM011", "section '/there/talker' applies to no node that gets this file (only /there/own)"),
        ("PRM013", "parameter 'rat' is not declared by /there/own"),
    ]


def test_a_node_without_a_name_gets_what_files_have_for_the_name_that_it_gives_itself(tmp_path: Path) -> None:
    harness = Ros2Harness(
        tmp_path / "ws", talker=node_of("self.create_publisher(String, self.declare_parameter('topic', 'a').value, 1)")
    )
    harness.cache = TraceCache(tmp_path / "cache")

    def trace(*sections: str) -> Interface:
        texts = [f"{key}:\n  ros__parameters:\n    {param}\n" for key, _, param in (s.partition("=") for s in sections)]
        harness.write("launch/p.yaml", "".join(texts))
        return harness.trace("talker", "<param from='$(dirname)/p.yaml'/>", "")

    assert set(ends(trace("own=topic: b", "other=topic: c"))) == {("publisher", "b")}
    assert set(ends(trace("own=topic: b", "/**=topic: c"))) == {("publisher", "c")}, "the key below counts"
    assert set(ends(trace("/**=topic: c", "own=topic: b"))) == {("publisher", "b")}
    assert set(ends(trace("own=topic: d"))) == {("publisher", "d")}, "it was read"
    # What it does not read makes no difference, nor does what is for others.
    assert trace("own=topic: d", "other=topic: c").cached
    assert trace("own={topic: d, more: 1}").cached
    assert set(ends(trace("other=topic: d"))) == {("publisher", "a")}


def test_a_name_that_comes_with_a_parameter_is_no_reason_to_run_on(tmp_path: Path) -> None:
    body = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String


def main():
    rclpy.init()
    first = Node('first')
    name = first.declare_parameter('name', 'left').value
    first.destroy_node()
    node = Node(name)
    node.create_publisher(String, '/' + name, 1)
    rclpy.spin(node)
"""
    harness = Ros2Harness(tmp_path / "ws", talker=body.replace("Node('first')", "Node('_first')"))
    harness.cache = TraceCache(tmp_path / "cache")
    harness.write("launch/p.yaml", "/**/left: {ros__parameters: {x: 1}}\n/left: {ros__parameters: {name: right}}\n")
    found = harness.trace("talker", "<param from='$(dirname)/p.yaml'/>", "")
    assert set(ends(found)) == {("publisher", "/right")}
    assert found.outcome.status == "spinning"


def test_a_parameter_that_a_callback_declares_later_is_possible(tmp_path: Path) -> None:
    """The run ends when the node is quiet, which may be before a timer fires; one that nothing declares is told."""
    constructor = 'self.declare_parameter("rate", 1.0)\nself.create_timer(60.0, self.more)'
    later = node_of(constructor).replace(
        "\n\n\ndef main", '\n\n    def more(self):\n        self.declare_parameter("gain", 2.0)\n\n\ndef main'
    )
    harness = Ros2Harness(tmp_path, later=later)

    def told(name: str) -> list[tuple[str, str]]:
        analysis = harness.check(f"<node pkg='pkg' exec='later' name='later'><param name='{name}' value='3.0'/></node>")
        assert analysis.graph is not None
        assert analysis.graph.processes[0].source == "trace"
        return [(finding.rule, finding.severity) for finding in analysis.findings]

    assert told("gain") == []
    assert told("other") == [("PRM013", "warning")]
