"""Clients of actions."""

from __future__ import annotations

import importlib
from typing import Any

import rospy  # type: ignore[import-not-found]

from .exceptions import ActionException


class _States:
    @classmethod
    def to_string(cls, value: int) -> str:
        return next((name for name, each in vars(cls).items() if each == value and name.isupper()), "")


class CommState(_States):
    """States of a goal."""

    WAITING_FOR_GOAL_ACK, PENDING, ACTIVE, WAITING_FOR_RESULT, WAITING_FOR_CANCEL_ACK = range(5)
    RECALLING, PREEMPTING, DONE, LOST = range(5, 9)


class TerminalState(_States):
    """How a goal ended."""

    RECALLED, REJECTED, PREEMPTED, ABORTED, SUCCEEDED, LOST = range(6)


def spec(kind: Any) -> Any:
    """Types of goal, result and feedback of an action. Raises `ActionException` for what is none."""
    try:
        made = kind()
        return type(made.action_goal), type(made.action_result), type(made.action_feedback)
    except AttributeError:
        raise ActionException(f"Type is not an action spec: {kind}") from None


class _StateMachine:
    def __init__(self, action_goal: Any) -> None:
        self.action_goal = action_goal


class ClientGoalHandle:
    """A goal that was sent."""

    def __init__(self, action_goal: Any) -> None:
        self.comm_state_machine = _StateMachine(action_goal)
        self.status, self.result = 0, None

    def cancel(self) -> None:
        pass

    def get_comm_state(self) -> int:
        return CommState.DONE if self.status else CommState.WAITING_FOR_GOAL_ACK

    def get_goal_status(self) -> int:
        return self.status

    def get_goal_status_text(self) -> str:
        return ""

    def get_result(self) -> Any:
        return self.result

    def get_terminal_state(self) -> int:
        return TerminalState.SUCCEEDED if self.status else TerminalState.LOST


class ActionClient:
    """The end that sends goals."""

    def __init__(self, ns: str, ActionSpec: Any) -> None:
        self.ns, self.ActionSpec = ns, ActionSpec
        self.ActionGoal, self.ActionResult, self.ActionFeedback = spec(ActionSpec)
        messages, full = importlib.import_module("actionlib_msgs.msg"), rospy.remap_name(ns)
        out = _size(rospy.get_param("actionlib_client_pub_queue_size", 10), 10)
        self.pub_goal = rospy.Publisher(full + "/goal", self.ActionGoal, queue_size=out)
        self.pub_cancel = rospy.Publisher(full + "/cancel", messages.GoalID, queue_size=out)
        into = _size(rospy.get_param("actionlib_client_sub_queue_size", -1), None)
        self.status_sub = rospy.Subscriber(
            full + "/status", messages.GoalStatusArray, callback=self._status_cb, queue_size=into
        )
        self.result_sub = rospy.Subscriber(
            full + "/result", self.ActionResult, callback=self._result_cb, queue_size=into
        )
        self.feedback_sub = rospy.Subscriber(
            full + "/feedback", self.ActionFeedback, callback=self._status_cb, queue_size=into
        )
        self._goals: list[tuple[ClientGoalHandle, Any]] = []

    def stop(self) -> None:
        for each in (self.pub_goal, self.pub_cancel, self.status_sub, self.result_sub, self.feedback_sub):
            each.unregister()

    def send_goal(self, goal: Any, transition_cb: Any = None, feedback_cb: Any = None) -> ClientGoalHandle:
        made = ClientGoalHandle(self.ActionGoal(goal=goal))
        self._goals.append((made, transition_cb))
        return made

    def cancel_all_goals(self) -> None:
        pass

    def cancel_goals_at_and_before_time(self, time: Any) -> None:
        pass

    def wait_for_server(self, timeout: Any = rospy.Duration(0.0)) -> bool:  # noqa: B008
        """Nobody comes."""
        seconds = timeout.to_sec() if hasattr(timeout, "to_sec") else float(timeout)
        end = rospy.get_time() + seconds
        while not rospy.is_shutdown() and (seconds <= 0 or rospy.get_time() < end):
            rospy.rostime.wallsleep(0.05)
        return False

    def _status_cb(self, message: Any) -> None:
        pass

    def _result_cb(self, message: Any) -> None:
        for handle, callback in self._goals:
            handle.status, handle.result = 3, message.result
            if callback is not None:
                callback(handle)
        self._goals.clear()


def _size(given: Any, default: Any) -> Any:
    return default if given < 0 else given
