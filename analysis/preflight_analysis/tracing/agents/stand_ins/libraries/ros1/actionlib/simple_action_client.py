"""Clients of actions with one goal at a time."""

from __future__ import annotations

from typing import Any

import rospy  # type: ignore[import-not-found]

from .action_client import ActionClient, CommState


class SimpleGoalState:
    """States of its goal."""

    PENDING, ACTIVE, DONE = range(3)

    @classmethod
    def to_string(cls, value: int) -> str:
        return ("PENDING", "ACTIVE", "DONE")[value]


class SimpleActionClient:
    """The end that sends goals."""

    def __init__(self, ns: str, ActionSpec: Any) -> None:
        self.action_client = ActionClient(ns, ActionSpec)
        self.simple_state = SimpleGoalState.DONE
        self.gh: Any = None
        self._done: Any = None

    def wait_for_server(self, timeout: Any = rospy.Duration()) -> bool:  # noqa: B008
        return self.action_client.wait_for_server(timeout)

    def send_goal(self, goal: Any, done_cb: Any = None, active_cb: Any = None, feedback_cb: Any = None) -> None:
        self._done, self.simple_state = done_cb, SimpleGoalState.PENDING
        self.gh = self.action_client.send_goal(goal, self._changed)

    def _changed(self, handle: Any) -> None:
        if handle is self.gh and handle.get_comm_state() == CommState.DONE:
            self.simple_state = SimpleGoalState.DONE
            if self._done is not None:
                self._done(handle.get_goal_status(), handle.get_result())

    def send_goal_and_wait(self, goal: Any, execute_timeout: Any = None, preempt_timeout: Any = None) -> int:
        self.send_goal(goal)
        self.wait_for_result(execute_timeout if execute_timeout is not None else rospy.Duration())
        return self.get_state()

    def wait_for_result(self, timeout: Any = rospy.Duration()) -> bool:  # noqa: B008
        if not self.gh:
            return False
        end = rospy.get_time() + timeout.to_sec()
        while not rospy.is_shutdown() and self.simple_state != SimpleGoalState.DONE:
            if timeout.to_sec() > 0 and rospy.get_time() >= end:
                return False
            rospy.rostime.wallsleep(0.02)
        return True

    def get_result(self) -> Any:
        return self.gh.get_result() if self.gh else None

    def get_state(self) -> int:
        return self.gh.get_goal_status() if self.gh else 9

    def get_goal_status_text(self) -> str:
        return ""

    def cancel_all_goals(self) -> None:
        pass

    def cancel_goal(self) -> None:
        pass

    def cancel_goals_at_and_before_time(self, time: Any) -> None:
        pass

    def stop_tracking_goal(self) -> None:
        self.gh = None
