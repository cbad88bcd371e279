"""Nodes that wait for somebody who is not there: what comes after a made-up answer is found, and marked."""

from __future__ import annotations

import textwrap
from pathlib import Path

import pytest
from preflight_analysis.tracing.interface import Interface
from support.tracing_harness import trace, write_node

pytestmark = pytest.mark.ros

HEAD = """
import rospy, threading, time
from std_msgs.msg import Bool, String
from std_srvs.srv import SetBool, Trigger

rospy.init_node("n")
before = rospy.Publisher("before", String, queue_size=1)
"""


def waiting(folder: Path, body: str, after: str = "rospy.spin()", **more: object) -> Interface:
    """The trace of a node that makes `before`, does `body`, then makes `after`."""
    end = f'\nafter = rospy.Publisher("after", String, queue_size=1)\n{after}\n'
    return trace(write_node(folder, HEAD + textwrap.dedent(body) + end), **more)  # type: ignore[arg-type]


def made(interface: Interface) -> dict[str, bool]:
    """Names of the node's publishers and whether they are speculative."""
    return {
        e.name: "made-up answer" in e.evidence.doubts
        for e in interface.endpoints
        if e.role == "publisher" and not e.builtin
    }


SERVICE = "it waits for the service start, and was told that it is there"
MESSAGE = "it waits for a message on goal, and was given an empty one"
CALL = "it calls the service /start again and again, and was given an empty answer"


@pytest.mark.parametrize(
    ("body", "answers"),
    [
        ("rospy.wait_for_service('start')", (SERVICE,)),
        ("rospy.wait_for_service('start', timeout=20)", (SERVICE,)),
        ("rospy.wait_for_service('start', rospy.Duration(20))", (SERVICE,)),
        (
            "rospy.wait_for_service('start')\nassert rospy.ServiceProxy('start', Trigger)().success",
            (SERVICE,),
        ),
        (
            "proxy = rospy.ServiceProxy('start', Trigger)\nproxy.wait_for_service()\nassert proxy().message == ''",
            (SERVICE.replace(" start", " /start"),),
        ),
        ("assert rospy.wait_for_message('goal', String).data == ''", (MESSAGE,)),
        ("rospy.wait_for_message('goal', rospy.AnyMsg)", (MESSAGE,)),
        (
            "rospy.wait_for_service('start')\nrospy.wait_for_message('goal', String)",
            (SERVICE, MESSAGE),
        ),
        (
            """
            while True:
                try:
                    rospy.ServiceProxy("start", Trigger)()
                    break
                except rospy.ServiceException:
                    time.sleep(0.1)
            """,
            (CALL,),
        ),
        (
            """
            goal = None
            while goal is None:
                try:
                    goal = rospy.wait_for_message("goal", String, timeout=0.2)
                except rospy.ROSException:
                    pass
            """,
            (MESSAGE,),
        ),
    ],
)
def test_a_wait_by_call_is_answered(tmp_path: Path, body: str, answers: tuple[str, ...]) -> None:
    found = waiting(tmp_path, body)
    assert (found.outcome.status, found.outcome.reason) == ("spinning", None)
    assert made(found) == {"before": False, "after": True}
    assert found.outcome.answers == answers
    assert set(answers) <= set(found.notes)
    assert not found.complete


def test_who_is_there_needs_no_made_up_answer(tmp_path: Path) -> None:
    found = waiting(
        tmp_path,
        """
        rospy.Service("start", Trigger, lambda request: (True, "mine"))
        latched = rospy.Publisher("goal", String, latch=True, queue_size=1)
        latched.publish("also mine")
        rospy.wait_for_service("start")
        assert rospy.ServiceProxy("start", Trigger)().message == "mine"
        assert rospy.wait_for_message("goal", String).data == "also mine"
        """,
    )
    assert made(found) == {"before": False, "goal": False, "after": False}
    assert found.outcome.answers == ()
    assert found.complete


def test_a_refused_call_is_the_nodes_own_affair(tmp_path: Path) -> None:
    found = waiting(tmp_path, "rospy.ServiceProxy('start', Trigger)()")
    assert found.outcome.status == "crashed"
    assert found.outcome.answers == ()
    assert "service [/start] unavailable" in str(found.outcome.reason)


def test_an_answer_in_another_thread_leaves_the_main_thread_sure(tmp_path: Path) -> None:
    found = waiting(
        tmp_path,
        """
        done = threading.Event()
        def work():
            rospy.wait_for_service("start")
            rospy.Publisher("from_the_thread", String, queue_size=1)
            done.set()
        threading.Thread(target=work).start()
        done.wait()
        """,
    )
    assert made(found) == {"before": False, "from_the_thread": True, "after": False}


def test_what_was_made_before_stays_sure(tmp_path: Path) -> None:
    found = waiting(
        tmp_path,
        """
        for turn in range(2):
            rospy.Publisher("twice", String, queue_size=1)
            if not turn:
                rospy.wait_for_service("start")
        """,
    )
    assert made(found) == {"before": False, "twice": False, "after": True}


def test_an_end_after_an_answer_keeps_what_was_seen(tmp_path: Path) -> None:
    found = waiting(tmp_path, "rospy.wait_for_message('goal', String)", after="raise SystemExit(3)")
    assert (found.outcome.status, found.outcome.exit_code) == ("crashed", 3)
    assert found.outcome.answers == (MESSAGE,)
    assert made(found) == {"before": False, "after": True}


FED = "it waits for messages on /goal, and was given empty ones"
LISTENS = "goal = []\nrospy.Subscriber('goal', Bool, lambda message: message.data and goal.append(message))\n"


@pytest.mark.parametrize(
    "loop",
    [
        "rate = rospy.Rate(10)\nwhile not goal and not rospy.is_shutdown(): rate.sleep()",
        "rate = rospy.Rate(1)\nwhile not goal: rate.sleep()",
        "while not goal: rospy.sleep(0.1)",
        "while not rospy.is_shutdown():\n    if goal: break\n    rospy.sleep(0.5)",
        "while not goal: time.sleep(0.1)",
        "while not goal: rospy.rostime.wallsleep(0.1)",
        "before.publish('hello')\nwhile not goal: rospy.sleep(0.1)",
    ],
)
def test_a_loop_that_polls_for_a_message_gets_one(tmp_path: Path, loop: str) -> None:
    found = waiting(tmp_path, LISTENS + loop)
    assert (found.outcome.status, found.outcome.reason) == ("spinning", None)
    assert made(found) == {"before": False, "after": True}
    assert found.outcome.answers == (FED,)
    assert not found.complete


def test_one_poll_after_another(tmp_path: Path) -> None:
    found = waiting(
        tmp_path,
        f"""
        {LISTENS.replace(chr(10), chr(10) + " " * 8)}
        while not goal: rospy.sleep(0.1)
        while not rospy.has_param("ready"): rospy.sleep(0.1)
        more = []
        rospy.Subscriber("more", String, more.append)
        while len(more) < 5: rospy.sleep(0.1)
        """,
    )
    assert made(found) == {"before": False, "after": True}
    assert found.outcome.answers == (
        FED,
        "it waits for the parameter /ready, and was given a value",
        "it waits for messages on /more, and was given empty ones",
    )


@pytest.mark.parametrize(
    "loop",
    [
        "while not rospy.has_param('ready'): time.sleep(0.1)",
        "while rospy.get_param('ready', None) is None: rospy.sleep(0.1)",
        """
        while True:
            try:
                rospy.get_param("ready")
                break
            except KeyError:
                rospy.sleep(0.1)
        """,
    ],
)
def test_a_loop_that_polls_for_a_parameter_gets_one(tmp_path: Path, loop: str) -> None:
    found = waiting(tmp_path, loop)
    assert (found.outcome.status, found.outcome.reason) == ("spinning", None)
    assert made(found) == {"before": False, "after": True}
    assert found.outcome.answers == ("it waits for the parameter /ready, and was given a value",)


def test_a_loop_whose_work_is_to_call_waits_for_nothing(tmp_path: Path) -> None:
    found = waiting(
        tmp_path,
        """
        while not rospy.is_shutdown():
            try:
                rospy.ServiceProxy("start", Trigger)()
            except rospy.ServiceException:
                pass
            rospy.sleep(0.1)
        """,
    )
    assert (found.outcome.status, found.outcome.answers) == ("spinning", ())
    assert found.complete


def test_a_parameter_is_given_what_the_node_itself_takes_for_it(tmp_path: Path) -> None:
    found = waiting(
        tmp_path,
        """
        assert rospy.get_param("mode", "slow") == "slow"
        while not rospy.has_param("mode"): time.sleep(0.1)
        assert rospy.get_param("mode") == "slow"
        while not rospy.has_param("rate"): time.sleep(0.1)
        rospy.Rate(rospy.get_param("rate"))
        """,
    )
    assert made(found) == {"before": False, "after": True}


@pytest.mark.parametrize(
    "wait",
    [
        "rospy.sleep(1.0)",
        "rospy.Rate(10).sleep()",
        "while rospy.Time.now() == rospy.Time(0): time.sleep(0.1)",
        "while not rospy.get_time(): rospy.rostime.wallsleep(0.1)",
    ],
)
def test_simulated_time_begins(tmp_path: Path, wait: str) -> None:
    found = waiting(tmp_path, wait, params={"/use_sim_time": True})
    assert (found.outcome.status, found.outcome.reason) == ("spinning", None)
    assert made(found) == {"before": False, "after": True}
    assert found.outcome.answers == ("it waits for simulated time on /clock, and was given the time of day",)


@pytest.mark.parametrize(
    ("work", "params"),
    [
        ("while not rospy.is_shutdown():\n    before.publish('x')\n    rate.sleep()", {}),
        ("while not rospy.is_shutdown():\n    before.publish('x')\n    rate.sleep()", {"/use_sim_time": True}),
        ("while True:\n    before.publish('x')\n    rospy.sleep(0.1)", {}),
        ("while not rospy.is_shutdown():\n    rate.sleep()", {}),
        ("while True: time.sleep(0.1)", {}),
        # What it does to an empty message is not its fault where nothing else came of it.
        ("while not rospy.is_shutdown():\n    rate.sleep()\n    if goal: raise SystemExit(1)", {}),
        ("while not rospy.is_shutdown():\n    rospy.get_param('~gain', 1.0)\n    rate.sleep()", {}),
    ],
)
def test_a_loop_that_does_its_work_is_as_before(tmp_path: Path, work: str, params: dict[str, object]) -> None:
    body = LISTENS + "rate = rospy.Rate(10)\nrospy.Publisher('late', String, queue_size=1)\n" + work
    found = waiting(tmp_path, body, params=params)
    assert (found.outcome.status, found.outcome.reason) == ("spinning", None)
    assert found.outcome.answers == found.notes == ()
    assert made(found) == {"before": False, "late": False}
    assert found.complete


@pytest.mark.parametrize("pause", ["time.sleep(1.0)", "rospy.sleep(1.0)", "threading.Event().wait(1.0)"])
def test_a_pause_is_no_wait(tmp_path: Path, pause: str) -> None:
    found = waiting(tmp_path, LISTENS + pause)
    assert made(found) == {"before": False, "after": False}
    assert found.outcome.answers == ()


ACTION = """
import actionlib
from actionlib.msg import TestAction, TestGoal
client = actionlib.SimpleActionClient("go", TestAction)
"""
SERVER = "it waits for the action server go, and was told that it is there"
RESULT = "it waits for the result of the action go, and was given an empty one"
TRANSFORMS = """
import tf2_ros
buffer = tf2_ros.Buffer()
listener = tf2_ros.TransformListener(buffer)
"""
TRANSFORM = "it waits for the transform map <- odom, and was given the identity"
AGAIN = "it asks for the transform map <- odom again and again, and was given the identity"


@pytest.mark.parametrize("simulated", [False, True])
@pytest.mark.parametrize(
    ("body", "answers"),
    [
        (ACTION + "assert client.wait_for_server()", (SERVER,)),
        (ACTION + "assert client.wait_for_server(rospy.Duration(20))", (SERVER,)),
        (
            ACTION + "client.wait_for_server()\nclient.send_goal(TestGoal())\nassert client.wait_for_result()\n"
            "assert (client.get_state(), client.get_result().result) == (3, 0)",
            (SERVER, RESULT),
        ),
        (ACTION + "assert client.send_goal_and_wait(TestGoal()) == 3", (RESULT,)),
        (
            TRANSFORMS + "found = buffer.lookup_transform('map', 'odom', rospy.Time(), rospy.Duration(20))\n"
            "assert found.transform.rotation.w == 1",
            (TRANSFORM,),
        ),
        (
            TRANSFORMS + "assert buffer.can_transform('map', 'odom', rospy.Time(), timeout=rospy.Duration(20))\n"
            "buffer.lookup_transform(target_frame='map', source_frame='odom', time=rospy.Time())",
            (TRANSFORM,),
        ),
        (
            TRANSFORMS + "while not buffer.can_transform('map', 'odom', rospy.Time()): time.sleep(0.1)",
            (AGAIN,),
        ),
        (
            f"""{TRANSFORMS}
while True:
    try:
        buffer.lookup_transform("map", "odom", rospy.Time())
        break
    except tf2_ros.TransformException:
        time.sleep(0.1)
""",
            (AGAIN,),
        ),
    ],
)
def test_a_wait_for_an_action_or_a_transform_is_answered(
    tmp_path: Path, body: str, answers: tuple[str, ...], simulated: bool
) -> None:
    found = waiting(tmp_path, body, params={"/use_sim_time": simulated})
    assert (found.outcome.status, found.outcome.reason) == ("spinning", None)
    publishers = {name: speculative for name, speculative in made(found).items() if not name.startswith("go/")}
    assert publishers == {"before": False, "after": True}
    assert found.outcome.answers == answers


def test_a_transform_that_is_there_needs_no_made_up_one(tmp_path: Path) -> None:
    found = waiting(
        tmp_path,
        f"""{TRANSFORMS}
from geometry_msgs.msg import TransformStamped
made = TransformStamped()
made.header.frame_id, made.child_frame_id = "map", "odom"
made.transform.translation.x, made.transform.rotation.w = 2, 1
tf2_ros.StaticTransformBroadcaster().sendTransform(made)
assert buffer.lookup_transform("map", "odom", rospy.Time(), rospy.Duration(20)).transform.translation.x == 2
""",
    )
    assert found.outcome.answers == ()
    assert made(found)["after"] is False


def test_an_end_without_a_transform_is_the_nodes_own(tmp_path: Path) -> None:
    found = waiting(tmp_path, TRANSFORMS + "buffer.lookup_transform('map', 'odom', rospy.Time())")
    assert (found.outcome.status, found.outcome.answers) == ("crashed", ())
