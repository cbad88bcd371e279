"""Servers of actions with one goal at a time."""

from __future__ import annotations

import threading
from typing import Any

import rospy  # type: ignore[import-not-found]

from .action_server import ActionServer


class SimpleActionServer:
    """The end that takes goals: none come."""

    def __init__(self, name: str, ActionSpec: Any, execute_cb: Any = None, auto_start: bool = True) -> None:
        self.execute_callback = execute_cb
        if execute_cb is not None:
            self.execute_thread = threading.Thread(target=self.executeLoop, daemon=True)
            self.execute_thread.start()
        self.action_server = ActionServer(name, ActionSpec, auto_start=auto_start)

    def executeLoop(self) -> None:
        while not rospy.is_shutdown():
            rospy.rostime.wallsleep(0.1)

    def start(self) -> None:
        self.action_server.start()

    def register_goal_callback(self, cb: Any) -> None:
        pass

    register_preempt_callback = register_goal_callback

    def is_active(self) -> bool:
        return False

    is_preempt_requested = is_new_goal_available = is_active

    def accept_new_goal(self) -> Any:
        return None

    def publish_feedback(self, feedback: Any) -> None:
        pass

    def set_succeeded(self, result: Any = None, text: str = "") -> None:
        pass

    set_aborted = set_preempted = set_succeeded

    def get_default_result(self) -> Any:
        return self.action_server.ActionResult().result
