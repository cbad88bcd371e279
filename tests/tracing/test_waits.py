"""Nodes that wait for somebody who is not there: what comes after a made-up answer is found, and marked."""

from __future__ import annotations

import textwrap
from pathlib import Path

import pytest
from preflight_analysis.tracing.interface import Interface
from tracing_desk import trace, write_node

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
    return {e.name: e.speculative for e in interface.endpoints if e.role == "publisher" and not e.builtin}


SERVICE = "it waits for the service start, and was told that it is there"
MESSAGE = "it waits for a message on goal, and was given an empty one"
CALL = "it calls the service /start, and was given an empty answer"


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
