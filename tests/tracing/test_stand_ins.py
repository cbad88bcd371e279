"""Nodes without what they import: they do the same with the stand-ins as with the real libraries."""

from __future__ import annotations

import ast
import dataclasses
import os
import textwrap
import threading
from pathlib import Path

import pytest
from preflight_analysis.environment.model import Package, Packages
from preflight_analysis.tracing import stand_ins
from preflight_analysis.tracing.agents.stand_ins.finder import LIBRARIES
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.interface import KINDS, Interface, Outcome
from preflight_analysis.tracing.records import Gathered
from preflight_analysis.tracing.trace import Tracer
from support.internals import shown_internals
from support.ros2_harness import Ros2Harness, checked, node_of, ros2_prefix
from support.stand_in_harness import bare_python, both_of_ros1, both_of_ros2, seen, without_rclpy, without_rospy
from support.tracing_harness import ROS1_FIXTURES, SYSTEM_PYTHON, environment, own, request, write_node

pytestmark = pytest.mark.ros

TUTORIALS = sorted((ROS1_FIXTURES / "tutorials" / "scripts").glob("*.py"))


def trace_without(script: Path, **more: object) -> Interface:
    return Tracer(without_rospy(script.parent), None).trace(request(script), threading.Event())


@pytest.mark.parametrize("script", TUTORIALS, ids=lambda path: path.stem)
def test_a_tutorial_does_the_same(script: Path) -> None:
    real, stood_in = both_of_ros1(script)
    assert seen(stood_in) == seen(real)
    assert (real.stand_ins, "rospy" in stood_in.stand_ins) == ((), True)


ROS1_NODES = {
    "ends": """
        import rospy
        from std_msgs.msg import String, Header
        from std_srvs.srv import Trigger, TriggerResponse
        rospy.init_node('n', anonymous=True)
        rospy.Publisher('~state', String, queue_size=3, latch=True)
        rospy.Subscriber('/scan', rospy.AnyMsg, print)
        rospy.Service('reset', Trigger, lambda r: TriggerResponse(success=True))
        rospy.ServiceProxy('~load', Trigger)
        gone = rospy.Publisher('gone', String, queue_size=1)
        gone.unregister()
        rospy.Timer(rospy.Duration(0.1), lambda event: rospy.get_param('~late', 3))
        rospy.loginfo('%s at %s', rospy.get_name(), rospy.Time.now() - rospy.Duration(1))
        rospy.spin()
    """,
    "parameters": """
        import rospy
        rospy.init_node('n')
        rospy.get_param('~rate', 10), rospy.get_param('/camera', {}), rospy.has_param('x'), rospy.search_param('y')
        rospy.set_param('~made', [1, 2.5, 'x'])
        assert rospy.get_param('~made') == [1, 2.5, 'x'] and rospy.get_param('~given') == 7
        assert rospy.get_param_names()
        rospy.delete_param('~made')
        rospy.get_param('~required')
    """,
    "waits": """
        import rospy
        from std_msgs.msg import String
        from std_srvs.srv import Trigger
        rospy.init_node('n')
        rospy.wait_for_message('first', String)
        rospy.wait_for_service('start')
        assert rospy.ServiceProxy('start', Trigger)().success
        rospy.Publisher('after', String, queue_size=1)
        rate = rospy.Rate(20)
        while not rospy.is_shutdown():
            rate.sleep()
    """,
    "polls": """
        import rospy
        from std_msgs.msg import String
        rospy.init_node('n')
        heard = []
        rospy.Subscriber('words', String, heard.append)
        rate = rospy.Rate(20)
        while not rospy.is_shutdown() and not heard:
            rate.sleep()
        rospy.Publisher('echo', String, queue_size=1)
        rospy.spin()
    """,
    "action": """
        import rospy, actionlib
        from actionlib_tutorials.msg import FibonacciAction, FibonacciGoal
        rospy.init_node('n')
        server = actionlib.SimpleActionServer('offered', FibonacciAction, lambda goal: None, auto_start=False)
        server.start()
        client = actionlib.SimpleActionClient('used', FibonacciAction)
        client.wait_for_server()
        client.send_goal(FibonacciGoal(order=3))
        rospy.spin()
    """,
    "transforms": """
        import rospy, tf2_ros
        from geometry_msgs.msg import TransformStamped
        rospy.init_node('n')
        buffer = tf2_ros.Buffer()
        listener = tf2_ros.TransformListener(buffer)
        sent = TransformStamped()
        sent.header.frame_id, sent.child_frame_id, sent.transform.rotation.w = 'odom', 'base', 1.0
        tf2_ros.TransformBroadcaster().sendTransform(sent)
        tf2_ros.StaticTransformBroadcaster().sendTransform(sent)
        while not rospy.is_shutdown():
            try:
                buffer.lookup_transform('map', 'base', rospy.Time(0))
                break
            except tf2_ros.TransformException:
                rospy.sleep(0.05)
        rospy.Publisher('found', rospy.Header, queue_size=1) if False else rospy.spin()
    """,
}


@pytest.mark.parametrize("name", ROS1_NODES)
def test_a_node_of_rospy_does_the_same(name: str, tmp_path: Path) -> None:
    script = write_node(tmp_path, ROS1_NODES[name])
    params = {"/robot/node/given": 7, "/robot/node/other": 1}
    real, stood_in = both_of_ros1(script, node="/robot/node", params=params, remaps=(("scan", "/laser"),))
    assert own(real) or name == "parameters"
    assert seen(stood_in) == seen(real)


ROS2_NODES = {
    "ends": node_of(
        """
        self.create_publisher(String, 'chatter', 10)
        self.create_publisher(String, '~/state', QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL,
                              deadline=Duration(seconds=2)))
        self.create_publisher(String, 'tuned', 3,
                              qos_overriding_options=QoSOverridingOptions.with_default_policies())
        self.create_subscription(String, '/scan', print, qos_profile_sensor_data)
        self.create_service(Empty, 'reset', print)
        self.create_client(Empty, '/map/load')
        self.create_timer(0.1, print)
        self.get_logger().info(f'{self.get_clock().now() - Time(clock_type=ClockType.ROS_TIME)}')
        """,
        "from rclpy.clock import ClockType",
        "from rclpy.duration import Duration",
        "from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data",
        "from rclpy.qos_overriding_options import QoSOverridingOptions",
        "from rclpy.time import Time",
        "from std_srvs.srv import Empty",
    ),
    "parameters": node_of(
        """
        assert self.declare_parameter('rate', 10.0).value == 5.0
        ranged = ParameterDescriptor(integer_range=[IntegerRange(from_value=0, to_value=10, step=2)], read_only=True)
        self.declare_parameter('size', 4, ranged)
        self.declare_parameters('a', [('b', True), ('c', ['x']), ('d', Parameter.Type.STRING)])
        self.declare_parameter('any', None, ParameterDescriptor(dynamic_typing=True))
        self.add_on_set_parameters_callback(lambda params: SetParametersResult(successful=True))
        assert self.set_parameters([Parameter('a.b', value=False)])[0].successful
        assert not self.get_parameter('a.b').get_parameter_value().bool_value
        """,
        "from rcl_interfaces.msg import IntegerRange, ParameterDescriptor, SetParametersResult",
        "from rclpy.parameter import Parameter",
    ),
    "only names": node_of(
        """
        self.declare_parameter('name')
        self.declare_parameter('other', None)
        assert self.declare_parameter('rate').value == 5.0 and self.get_parameter('other').value is None
        self.create_publisher(String, 'after', 1)
        """
    ),
    "refuses": node_of("self.declare_parameter('rate', 1)"),
    "unset": node_of(
        "self.declare_parameter('name', Parameter.Type.STRING)\nself.get_parameter('name')",
        "from rclpy.parameter import Parameter",
    ),
    "waits": node_of(
        """
        client = self.create_client(Trigger, 'start')
        client.wait_for_service()
        future = client.call_async(Trigger.Request())
        rclpy.spin_until_future_complete(self, future)
        assert future.result().success
        self.create_publisher(String, 'after', 1)
        """,
        "from std_srvs.srv import Trigger",
    ),
    "several": textwrap.dedent("""
        import rclpy
        from rclpy.executors import MultiThreadedExecutor
        from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
        from std_msgs.msg import String

        class Managed(LifecycleNode):
            def on_configure(self, state):
                self.out = self.create_lifecycle_publisher(String, 'managed', 1)
                assert not self.out.is_activated and state == (state.label, state.state_id)
                return super().on_configure(state)

        def main():
            rclpy.init()
            executor = MultiThreadedExecutor()
            executor.add_node(Managed('managed'))
            executor.add_node(rclpy.create_node('other', namespace='deep'))
            executor.spin()
    """),
}


@pytest.mark.parametrize("name", [each for each in ROS2_NODES if each != "several"])
def test_a_node_of_rclpy_does_the_same(name: str, tmp_path: Path) -> None:
    harness = Ros2Harness(tmp_path, **ROS2_NODES)
    real, stood_in = both_of_ros2(harness, name, "<param name='rate' value='5.0'/>")
    assert seen(stood_in) == seen(real)
    assert "rclpy" in stood_in.stand_ins


_ONLY_FOR_TYPES = ("Dict", "Dictionary", "KWargs", "T", "Type", "Args", "Callback", "Attributes", "Result")
"""The end of the names that are in rclpy for the sake of annotations."""
_INNER = {
    "__init__.py": {"InitContextManager"},
    "action/server.py": {"GoalEvent", "RCLError"},
    "callback_groups.py": {"Entity"},
    "client.py": {"SrvTypeRequest", "SrvTypeResponse"},
    "context.py": {"g_logging_configure_lock", "g_logging_ref_count"},
    "executors.py": {"YieldedCallback"},
    "lifecycle/node.py": {"CallbackNames"},
    "event_handler.py": {"EventHandlerData"},
    "node.py": {"SrvTypeRequest", "SrvTypeResponse"},
    "parameter.py": {"AllowableParameterValue"},
    "service.py": {"SrvTypeRequest", "SrvTypeResponse"},
    "subscription.py": {"RCLError"},
    "task.py": {"FutureState"},
    "utilities.py": {"g_context_lock", "g_default_context"},
}
"""What nodes have no use for."""


def test_the_stand_in_of_rclpy_has_the_names_of_the_real_one() -> None:
    (real,) = ros2_prefix().glob("lib/python3*/site-packages/rclpy")
    ours = Path(LIBRARIES) / "ros2" / "rclpy"
    for file in sorted(ours.rglob("*.py")):
        below = file.relative_to(ours).as_posix()
        if (real / below).exists():
            lacking = _names(real / below, imported=False) - _names(file, imported=True) - _INNER.get(below, set())
            assert not {name for name in lacking if not name.endswith(_ONLY_FOR_TYPES)}, below


def _names(file: Path, *, imported: bool) -> set[str]:
    """The public names that a module defines, and those that it imports."""
    found: set[str] = set()
    for node in ast.parse(file.read_text(encoding="utf-8")).body:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)):
            found.add(node.name)
        elif isinstance(node, (ast.Assign, ast.AnnAssign)):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            found |= {each.id for target in targets for each in ast.walk(target) if isinstance(each, ast.Name)}
        elif imported and isinstance(node, ast.ImportFrom):
            found |= {each.asname or each.name for each in node.names}
    return {name for name in found if not name.startswith("_")}


def test_lifecycle_nodes_are_activated(tmp_path: Path) -> None:
    harness = Ros2Harness(tmp_path, several=ROS2_NODES["several"])
    real, stood_in = both_of_ros2(harness, "several")
    assert stood_in.outcome.status == "spinning"
    assert own(stood_in) == own(real)
    assert {end.name.rpartition("/")[2] for end in stood_in.endpoints if end.builtin} >= {"change_state", "get_state"}


LIFECYCLE = """
import rclpy
from rclpy.lifecycle import Node, Publisher, SimpleManagedEntity, State, TransitionCallbackReturn
from std_msgs.msg import String

class Part(SimpleManagedEntity):
    @SimpleManagedEntity.when_enabled
    def make(self, node):
        node.create_publisher(String, 'made_by_part', 1)

class Managed(Node):
    def __init__(self):
        super().__init__('managed')
        self.part = Part()
        self.add_managed_entity(self.part)

    def on_configure(self, state: State):
        self.out = self.create_lifecycle_publisher(String, 'out', 1)
        assert isinstance(self.out, Publisher) and not self.out.is_activated
        self.part.make(self)
        return {configured}

    def on_activate(self, state: State):
        result = super().on_activate(state)
        self.create_subscription(String, 'active' if self.out.is_activated else 'never', print, 1)
        self.part.make(self)
        return result

    def on_error(self, state):
        self.create_publisher(String, 'mended', 1)
        return TransitionCallbackReturn.SUCCESS

def main():
    rclpy.init()
    node = Managed()
    {itself}
    rclpy.spin(node)
"""
_SUCCESS = "TransitionCallbackReturn.SUCCESS"


@pytest.mark.parametrize(
    ("configured", "itself", "transitions", "made"),
    [
        (_SUCCESS, "", (), {"out", "active", "made_by_part"}),
        (_SUCCESS, "node.trigger_configure()", ("configure",), {"out", "active", "made_by_part"}),
        (
            _SUCCESS,
            "node.trigger_configure(); node.trigger_activate()",
            ("activate", "configure"),
            {"out", "active", "made_by_part"},
        ),
        ("TransitionCallbackReturn.FAILURE", "", (), {"out"}),
        ("1 / 0", "", (), {"out", "mended"}),
    ],
)
def test_what_a_lifecycle_node_does_in_its_transitions(
    tmp_path: Path, configured: str, itself: str, transitions: tuple[str, ...], made: set[str]
) -> None:
    body = LIFECYCLE.replace("{configured}", configured).replace("{itself}", itself)
    real, stood_in = both_of_ros2(Ros2Harness(tmp_path, managed=body), "managed")
    assert seen(stood_in) == seen(real)
    assert stood_in.transitions == real.transitions == transitions
    assert {end.name for end in real.endpoints if not (end.builtin or end.evidence.inferred)} == made
    assert [end.type for end in real.endpoints if end.name == "~/change_state"] == ["lifecycle_msgs/srv/ChangeState"]


def test_actions_of_ros2_have_their_type(tmp_path: Path) -> None:
    body = node_of(
        "ActionServer(self, Fibonacci, 'offered', print)\nActionClient(self, Fibonacci, 'used').wait_for_server()\n"
        "assert Fibonacci.Goal(order=3).order == 3",
        "from example_interfaces.action import Fibonacci",
        "from rclpy.action import ActionClient, ActionServer",
        "from rclpy.action.client import ClientGoalHandle, GoalStatus",
        "from rclpy.action.server import GoalInfo",
    )
    harness = Ros2Harness(tmp_path, act=body)
    _, stood_in = both_of_ros2(harness, "act")
    assert own(stood_in) == {
        ("action_server", "offered", "example_interfaces/action/Fibonacci"),
        ("action_client", "used", "example_interfaces/action/Fibonacci"),
    }


def test_modules_have_what_the_real_ones_import_and_anything_else(tmp_path: Path) -> None:
    """As `rclpy.node` has the messages of its parameters. A program that provides for what is missing does without."""
    body = node_of(
        """
        assert hasattr(nodes, 'Node') and not hasattr(nodes, 'of_tomorrow') and absent
        self.declare_parameter('size', 4, ParameterDescriptor(integer_range=[IntegerRange(to_value=10)]))
        self.create_subscription(String, 'in', print, 1, callback_group=ReentrantCallbackGroup())
        assert issubclass(SingleThreadedExecutor, Executor)
        OfTomorrow().configure(self)
        nodes.of_tomorrow(self)
        self.create_publisher(String, 'after', 1)
        """,
        "from rclpy import node as nodes",
        "from rclpy.executors import SingleThreadedExecutor",
        "from rclpy.node import Executor, IntegerRange, ParameterDescriptor, ReentrantCallbackGroup",
        "from rclpy.qos import OfTomorrow",
        "try:\n    from rclpy.qos import OfNextWeek\nexcept ImportError:\n    absent = True",
    )
    harness = Ros2Harness(tmp_path, newer=body)
    path = harness.write("launch/a.launch.xml", "<launch><node pkg='pkg' exec='newer' name='n'/></launch>")
    found = checked(path, without_rclpy(harness), None).graph
    assert found is not None
    (interface,) = found.processes
    assert interface.outcome.status == "spinning", interface.outcome
    assert own(interface) == {
        ("subscriber", "in", "std_msgs/msg/String"),
        ("publisher", "after", "std_msgs/msg/String"),
    }
    (size,) = (each for each in interface.params if each.name.endswith("size"))
    assert size.range is not None and (size.range.low, size.range.high) == (0, 10)


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("import rospy, sys, cv9\nrospy.init_node('n')\nsys.exit(cv9.run())", "<cv9.run()>"),
        ("import rospy, cv9\nrospy.init_node('n')\n'a'.replace('a', cv9.x)", "must be str, not unknown value"),
        ("import rospy\nrospy.init_node('n')\nraise SystemExit(rospy.__file__)", "__init__.py"),
    ],
)
def test_how_a_run_is_made_is_not_told(tmp_path: Path, body: str, said: str) -> None:
    outcome = trace_without(write_node(tmp_path, body)).outcome
    assert said in (outcome.reason or "")
    assert shown_internals((outcome.reason or "", outcome.lacks or "", *outcome.stderr_tail)) == []


# Messages


def test_messages_of_the_workspace_are_made_of_their_definitions(tmp_path: Path) -> None:
    share = tmp_path / "robot_msgs"
    (share / "scripts").mkdir(parents=True)
    (share / "msg").mkdir()
    (share / "srv").mkdir()
    (share / "msg" / "State.msg").write_text("uint8 IDLE=1  # no motion\nHeader header\nPart[2] parts\nstring name\n")
    (share / "msg" / "Part.msg").write_text("float64[3] at\nbool ok\n")
    (share / "srv" / "Ask.srv").write_text("int32 a\n---\nState state\n")
    script = write_node(
        share / "scripts",
        """
        import rospy
        from robot_msgs.msg import State
        from robot_msgs.srv import Ask, AskRequest
        state = State(name='x')
        assert (State.IDLE, state.header.frame_id, len(state.parts), state.parts[0].at) == (1, '', 2, [0.0] * 3)
        assert AskRequest(3).a == 3
        rospy.init_node('n')
        rospy.Publisher('state', State, queue_size=1).publish(state)
        rospy.Service('ask', Ask, lambda request: None)
        rospy.spin()
    """,
    )
    package = Package("robot_msgs", str(share), str(share / "package.xml"))
    for machine in (without_rospy(tmp_path), environment(tmp_path)):
        tracer = Tracer(dataclasses.replace(machine, packages=Packages({"robot_msgs": package})), None)
        found = tracer.trace(request(script), threading.Event())
        assert (found.outcome.status, found.outcome.reason) == ("spinning", None)
        assert own(found) == {
            ("publisher", "state", "robot_msgs/State"),
            ("service", "ask", "robot_msgs/Ask"),
        }
        assert "robot_msgs" in found.stand_ins


def test_messages_that_nobody_knows_have_any_field(tmp_path: Path) -> None:
    """With the real rospy as without it."""
    body = """
        import rospy
        from far_msgs.msg import Reading, MoveAction
        from far_msgs.srv import Ask, AskResponse
        rospy.init_node('n')
        made = Reading(name='x')
        made.pose.position.x = 3.0
        made.list.append(1)
        made.status = Reading.STATUS_OK
        rospy.Publisher('reading', Reading, queue_size=1).publish(made)
        rospy.Subscriber('goal', type(MoveAction().action_goal), print)
        rospy.Service('ask', Ask, lambda request: AskResponse(ok=True))
        rospy.spin()
    """
    script = write_node(tmp_path, body)
    real, stood_in = both_of_ros1(script)
    expected = {
        ("publisher", "reading", "far_msgs/Reading"),
        ("subscriber", "goal", "far_msgs/MoveActionGoal"),
        ("service", "ask", "far_msgs/Ask"),
    }
    assert (own(real), own(stood_in)) == (expected, expected)
    assert real.stand_ins == ("far_msgs",)


@pytest.mark.parametrize("order", ["rclpy first", "messages first"])
def test_messages_that_are_missing_beside_the_real_rclpy(order: str, tmp_path: Path) -> None:
    """rclpy takes no classes but generated ones, so the stand-in takes its place."""
    messages = "from far_msgs.msg import Reading"
    body = node_of("self.create_publisher(Reading, 'reading', 7)\nself.create_publisher(String, 'text', 7)")
    body = f"{messages}\n{body}" if order == "messages first" else body.replace("class Own", f"{messages}\nclass Own")
    harness = Ros2Harness(tmp_path, mixed=body)
    found = harness.trace("mixed")
    assert found.outcome.status == "spinning"
    assert own(found) == {
        ("publisher", "reading", "far_msgs/msg/Reading"),
        ("publisher", "text", "std_msgs/msg/String"),
    }
    assert found.stand_ins[0] == "far_msgs"
    assert "std_msgs" not in found.stand_ins


def test_messages_of_common_packages_have_their_fields(tmp_path: Path) -> None:
    script = write_node(
        tmp_path,
        """
        import rospy
        from geometry_msgs.msg import PoseStamped, Twist
        from sensor_msgs.msg import JointState, PointField
        assert Twist().linear.x == 0.0 and PoseStamped().header.stamp.is_zero() and PointField.FLOAT32 == 7
        assert JointState(name=['a']).position == []
        rospy.init_node('n')
        rospy.Publisher('cmd', Twist, queue_size=1).publish(Twist())
        rospy.spin()
    """,
    )
    found = trace_without(script)
    assert (found.outcome.status, own(found)) == ("spinning", {("publisher", "cmd", "geometry_msgs/Twist")})


# Other modules


def test_other_modules_give_themselves_for_anything(tmp_path: Path) -> None:
    script = write_node(
        tmp_path,
        """
        import rospy
        import far_vision as vision
        from far_serial import Serial
        from std_msgs.msg import String
        rospy.init_node('n')
        out = rospy.Publisher('out', String, queue_size=1)
        camera = vision.Camera(0)
        width, height = camera.size
        port = Serial('/dev/ttyUSB0', 9600)
        with port as opened:
            out.publish(str(opened.read(3)))
        rospy.spin()
    """,
    )
    found = Tracer(environment(tmp_path), None).trace(request(script), threading.Event())
    assert (found.outcome.status, own(found)) == ("spinning", {("publisher", "out", "std_msgs/String")})
    assert found.stand_ins == ("far_serial", "far_vision")
    assert found.complete


def test_an_import_that_the_node_can_do_without_fails_as_it_does_outside(tmp_path: Path) -> None:
    script = write_node(
        tmp_path,
        """
        import rospy
        try:
            import far_vision
        except ImportError:
            far_vision = None
        rospy.init_node('n')
        rospy.Publisher('seeing' if far_vision else 'blind', rospy.msg.AnyMsg, queue_size=1)
        rospy.spin()
    """,
    )
    found = Tracer(environment(tmp_path), None).trace(request(script), threading.Event())
    assert {name for _, name, _ in own(found)} == {"blind"}
    assert found.stand_ins == ()


def test_a_crash_after_a_value_that_is_not_known_lacks_the_module(tmp_path: Path) -> None:
    script = write_node(tmp_path, "import rospy, far_vision\nrospy.init_node('n')\n{}[far_vision.key()]\n")
    found = Tracer(environment(tmp_path), None).trace(request(script), threading.Event())
    assert (found.outcome.status, found.outcome.lacks) == ("crashed", "the Python module far_vision")


def test_a_node_whose_work_is_in_a_missing_module_is_not_done(tmp_path: Path) -> None:
    found = trace_without(write_node(tmp_path, "import far_node\nfar_node.main()\n"))
    assert (found.outcome.lacks, found.likely_complete) == ("the Python module far_node", False)


def test_a_crash_of_another_cause_is_the_nodes_own(tmp_path: Path) -> None:
    script = write_node(tmp_path, "import rospy\nrospy.init_node('n')\nopen('/nowhere/model.json')\n")
    found = trace_without(script)
    assert (found.outcome.status, found.outcome.lacks) == ("crashed", None)
    assert found.outcome.reason is not None and "FileNotFoundError" in found.outcome.reason


@pytest.mark.parametrize("interpreter", ["python", "python2"])
def test_what_is_written_in_python_2_lacks_that(interpreter: str, tmp_path: Path) -> None:
    script = write_node(tmp_path, "import rospy\nrospy.init_node('n')\nprint 'on'\n")
    script.write_text(script.read_text().replace("env python3", f"env {interpreter}"))
    found = trace_without(script)
    assert (found.outcome.status, found.outcome.lacks) == ("crashed", "Python 2")


def test_a_slip_in_python_3_is_the_nodes_own(tmp_path: Path) -> None:
    found = trace_without(write_node(tmp_path, "import rospy\nprint 'on'\n"))
    assert (found.outcome.status, found.outcome.lacks) == ("crashed", None)


def test_a_node_for_any_python_is_run_by_python_3(tmp_path: Path) -> None:
    script = write_node(tmp_path, ROS1_NODES["polls"])
    script.write_text(script.read_text().replace("env python3", "env python"))
    assert trace_without(script).outcome.status == "spinning"


def test_a_mismatch_that_a_stand_in_shows_is_likely(tmp_path: Path) -> None:
    """With the real rclpy it is certain."""
    harness = Ros2Harness(
        tmp_path,
        talker=node_of("self.create_publisher(String, 'words', 10)"),
        listener=node_of("self.create_subscription(Bool, 'words', print, 10)", "from std_msgs.msg import Bool"),
    )
    launch = "<node pkg='pkg' exec='talker' name='t'/><node pkg='pkg' exec='listener' name='l'/>"
    analyses = (harness.check(launch), checked(harness.package / "launch/a.launch.xml", without_rclpy(harness), None))
    found = [next(f for f in each.findings if f.rule == "TOP003") for each in analyses]
    assert [(f.severity, f.confidence) for f in found] == [("error", "certain"), ("error", "likely")]


# The real thing


def test_a_trace_is_replaced_once_the_real_module_is_there(tmp_path: Path) -> None:
    package = tmp_path / "pkg"
    package.mkdir()
    script = write_node(package, "import rospy, far_vision\nrospy.init_node('n')\nrospy.spin()\n")
    os.utime(script, (0, 0))
    tracer = Tracer(environment(package), TraceCache(tmp_path / "cache"))
    assert tracer.trace(request(script), threading.Event()).stand_ins == ("far_vision",)
    kept = tracer.lookup(request(script))
    assert kept is not None and kept.stand_ins == ("far_vision",)
    (package / "far_vision.py").write_text("")
    assert tracer.lookup(request(script)) is None
    assert tracer.trace(request(script), threading.Event()).stand_ins == ()


def test_nodes_are_run_where_no_client_library_is_installed(tmp_path: Path) -> None:
    """By the first interpreter of the PATH."""
    harness = Ros2Harness(tmp_path, talker=node_of("self.create_publisher(String, 'chatter', 10)"))
    launch = harness.write("launch/a.launch.xml", "<launch><node pkg='pkg' exec='talker'/></launch>")
    machine = dataclasses.replace(without_rclpy(harness), ros2_python=None)
    graph = checked(launch, machine, None).graph
    assert graph is not None
    assert own(graph.processes[0]) == {("publisher", "chatter", "std_msgs/msg/String")}
    script = write_node(tmp_path, ROS1_NODES["polls"])
    alone = Tracer(dataclasses.replace(without_rospy(tmp_path), python=None), None)
    path = os.pathsep.join((str(bare_python()), "/usr/bin", "/bin"))
    alone.environment.variables["PATH"] = path  # type: ignore[index]
    found = alone.trace(request(script), threading.Event())
    assert own(found) == {("subscriber", "words", "std_msgs/String"), ("publisher", "echo", "std_msgs/String")}


def test_a_node_that_is_made_by_a_missing_module_is_not_known(tmp_path: Path) -> None:
    made = "import rclpy, {0}\n\ndef main():\n    rclpy.init()\n    rclpy.spin({0}.Bridge())\n"
    whole = node_of("self.declare_parameter('rate', 2)")
    harness = Ros2Harness(tmp_path, talker=made.format("far_node"), whole=whole)
    tag = "<launch><node pkg='pkg' exec='talker' name='a'/><node pkg='pkg' exec='whole' name='b'/></launch>"
    graph = checked(harness.write("launch/a.launch.xml", tag), without_rclpy(harness), None).graph
    assert graph is not None
    talker, other = graph.processes
    assert (talker.outcome.status, talker.tells_all(*KINDS), talker.likely_complete) == ("spinning", False, False)
    assert other.tells_all(*KINDS)


def test_python_packages_that_cmake_installs_are_imported(tmp_path: Path) -> None:
    """Scripts of a package in C++ import modules of the package, wherever it keeps them."""
    harness = Ros2Harness(tmp_path, other=node_of(""))
    package = harness.folder / "src" / "bridge"
    manifest = (harness.package / "package.xml").read_text()
    files = {
        "package.xml": manifest.replace("<name>pkg<", "<name>bridge<").replace("ament_python", "ament_cmake"),
        "CMakeLists.txt": "project(bridge)\nament_python_install_package(${PROJECT_NAME})\n"
        "ament_python_install_package(bridge_tools PACKAGE_DIR python/bridge_tools)\n"
        "install(PROGRAMS scripts/run DESTINATION lib/${PROJECT_NAME})\n",
        "bridge/__init__.py": "",
        "bridge/nodes.py": node_of("from bridge_tools import NAME\nself.declare_parameter(NAME, '')"),
        "python/bridge_tools/__init__.py": "NAME = 'path'\n",
        "scripts/run": "#!/usr/bin/env python3\nfrom bridge.nodes import main\nmain()\n",
    }
    for name, text in files.items():
        (package / name).parent.mkdir(parents=True, exist_ok=True)
        (package / name).write_text(text)
    (package / "scripts/run").chmod(0o755)
    launch = package / "a.launch.xml"
    launch.write_text("<launch><node pkg='bridge' exec='run'/></launch>")
    graph = checked(launch, without_rclpy(harness), None).graph
    assert graph is not None
    (node,) = graph.processes
    assert [use.name for use in node.params if not use.builtin] == ["~path"]
    assert node.tells_all(*KINDS)


@pytest.mark.parametrize(
    ("end", "lacks"),
    [
        ("raise RuntimeError('pip3 install far_vision')", "the Python module far_vision"),
        ("raise RuntimeError('no such map')", None),
        ("raise RuntimeError('No vision engine available')", "the Python module far_vision"),
        ("rospy.logerr('far_Vision not available')\nraise RuntimeError('stop')", "the Python module far_vision"),
        ("rospy.logerr('map not available')\nraise RuntimeError('stop')", None),
    ],
)
def test_a_crash_without_a_module_that_the_program_provides_for(tmp_path: Path, end: str, lacks: str | None) -> None:
    imports = "try:\n    import far_vision\nexcept ImportError:\n    far_vision = None\n"
    found = trace_without(write_node(tmp_path, f"{imports}import rospy\nrospy.init_node('n')\n{end}\n"))
    assert (found.outcome.status, found.outcome.lacks) == ("crashed", lacks)


def test_what_debian_has_for_nodes_of_ros1_is_nothing_for_those_of_ros2(tmp_path: Path) -> None:
    constructor = """
        self.listener = TransformListener(Buffer(), self)
        self.create_service(Trigger, 'reset', print)
    """
    imports = "from std_srvs.srv import Trigger", "from tf2_ros import Buffer, TransformListener"
    harness = Ros2Harness(tmp_path, n=node_of(constructor, *imports))
    launch = harness.write("launch/a.launch.xml", "<launch><node pkg='pkg' exec='n'/></launch>")
    graph = checked(launch, without_rclpy(harness, Path(SYSTEM_PYTHON)), None).graph
    assert graph is not None
    (interface,) = graph.processes
    assert interface.outcome.status == "spinning"
    assert {"rclpy", "std_srvs", "tf2_ros"} <= {*interface.stand_ins}
    assert ("service", "reset", "std_srvs/srv/Trigger") in own(interface)


def test_a_key_of_a_configuration_that_the_build_makes(tmp_path: Path) -> None:
    start = "import rospy\nfrom dynamic_reconfigure.server import Server\nrospy.init_node('n')\n"
    text = "Server(object, lambda config, level: '{speed}'.format(**config))\n"
    assert trace_without(write_node(tmp_path, start + text)).outcome.lacks == "the Python module dynamic_reconfigure"
    assert trace_without(write_node(tmp_path, start + "rospy.get_param('speed')\n")).outcome.lacks is None


def test_a_package_of_python_2_that_imports_its_own_module(tmp_path: Path) -> None:
    package = tmp_path / "piksi"
    package.mkdir()
    (package / "__init__.py").write_text("from piksi import Kml\n")
    (package / "piksi.py").write_text("class Kml: pass\n")
    script = write_node(tmp_path, "import rospy\nimport piksi\n")
    script.write_text(script.read_text().replace("env python3", "env python"))
    assert trace_without(script).outcome.lacks == "Python 2"


LAYOUT = """
import glob, os, pathlib, rclpy
from ament_index_python.packages import get_package_share_directory
from rclpy.node import Node
from std_msgs.msg import String


def main():
    rclpy.init()
    node = Node('own')
    share = get_package_share_directory('pkg')
    paths = [os.path.join(share, 'cfg', 'topics.txt'), os.path.join(share, 'renamed', 'topics.txt')]
    for path in paths:
        with open(path) as file:
            node.create_publisher(String, file.read().strip(), 1)
    if os.path.exists(paths[0]) and pathlib.Path(share, 'cfg').is_dir() and glob.glob(share + '/cfg/*.txt'):
        node.create_publisher(String, 'all_there', 1)
    if os.path.exists(share + '/cfg/no_such.txt'):
        node.create_publisher(String, 'too_much', 1)
    rclpy.spin(node)
"""


@pytest.mark.parametrize("build_type", ["ament_python", "ament_cmake"])
def test_a_node_finds_files_where_the_build_installs_them(tmp_path: Path, build_type: str) -> None:
    harness = Ros2Harness(tmp_path, own=LAYOUT)
    harness.write("config/topics.txt", "scan")
    if build_type == "ament_python":
        setup = harness.package / "setup.py"
        files = "[('share/pkg/cfg', ['config/topics.txt']), ('share/pkg/renamed', ['config/topics.txt'])]"
        setup.write_text(setup.read_text().replace("data_files=[]", f"data_files={files}"))
    else:
        manifest = harness.package / "package.xml"
        manifest.write_text(manifest.read_text().replace("ament_python", "ament_cmake"))
        (harness.package / "setup.py").unlink()
        harness.write(
            "CMakeLists.txt",
            "project(pkg)\nfind_package(ament_cmake REQUIRED)\nament_python_install_package(pkg)\n"
            "install(PROGRAMS scripts/own DESTINATION lib/pkg)\ninstall(DIRECTORY config/ DESTINATION share/pkg/cfg)\n"
            "install(DIRECTORY config/ DESTINATION share/${PROJECT_NAME}/renamed)\nament_package()\n",
        )
        program = harness.write("scripts/own", f"#!/usr/bin/env python3\n{LAYOUT}\nmain()\n")
        program.chmod(0o755)
    launch = harness.write("launch/a.launch.xml", "<launch><node pkg='pkg' exec='own' name='own'/></launch>")
    graph = checked(launch, without_rclpy(harness), None).graph
    assert graph is not None
    assert own(graph.processes[0]) == {
        ("publisher", "scan", "std_msgs/msg/String"),
        ("publisher", "all_there", "std_msgs/msg/String"),
    }


@pytest.mark.parametrize(("attribute", "is_own"), [("count", True), ("get_parametr", True), ("executor.none", False)])
def test_an_object_of_an_own_class_lacks_what_no_library_gives_it(tmp_path: Path, attribute: str, is_own: bool) -> None:
    text = (
        "import rclpy\nfrom rclpy.node import Node\n\n\nclass Sensor(Node):\n    def __init__(self):\n"
        f"        super().__init__('sensor')\n        self.total = self.{attribute}\n\n\n"
        "def main():\n    rclpy.init()\n    rclpy.spin(Sensor())\n"
    )
    harness = Ros2Harness(tmp_path, n=text)
    launch = harness.write("launch/a.launch.xml", "<launch><node pkg='pkg' exec='n'/></launch>")
    graph = checked(launch, without_rclpy(harness), None).graph
    assert graph is not None
    outcome = graph.processes[0].outcome
    assert "AttributeError" in (outcome.reason or "")
    assert (outcome.lacks is None) == is_own


@pytest.mark.parametrize("place", ["elsewhere/secret.py", "node/pipe.py", "node/../elsewhere/secret.py"])
def test_what_a_node_says_of_itself_leads_to_no_file_of_others(tmp_path: Path, place: str) -> None:
    """A path in its last words is believed as far as its own folder goes, and never one that would keep us waiting."""
    (tmp_path / "node").mkdir()
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "elsewhere/secret.py").write_text("class Sensor: pass\n")
    os.mkfifo(tmp_path / "node/pipe.py")
    said = "AttributeError: 'Sensor' object has no attribute 'count'"
    outcome = Outcome("crashed", stderr_tail=(f'  File "{tmp_path}/{place}", line 1, in x', said), reason=said)
    found = Gathered(stand_ins={"rclpy"})
    assert stand_ins.explained(outcome, found, str(tmp_path / "node/sensor.py")).lacks == "the Python module rclpy"
