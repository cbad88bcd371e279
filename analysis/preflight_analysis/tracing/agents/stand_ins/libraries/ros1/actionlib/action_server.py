"""Servers of actions."""

from __future__ import annotations

import importlib
from typing import Any

import rospy  # type: ignore[import-not-found]

from .action_client import _size, spec


class ActionServer:
    """The end that takes goals."""

    def __init__(
        self,
        ns: str,
        ActionSpec: Any,
        goal_cb: Any = None,
        cancel_cb: Any = None,
        auto_start: bool = True,
    ) -> None:
        self.ns, self.ActionSpec = ns, ActionSpec
        self.ActionGoal, self.ActionResult, self.ActionFeedback = spec(ActionSpec)
        self.started = False
        if auto_start:
            self.start()

    def start(self) -> None:
        self.initialize()
        self.started = True

    def initialize(self) -> None:
        messages, full = importlib.import_module("actionlib_msgs.msg"), rospy.remap_name(self.ns)
        out = _size(rospy.get_param("actionlib_server_pub_queue_size", 50), 50)
        self.status_pub = rospy.Publisher(full + "/status", messages.GoalStatusArray, latch=True, queue_size=out)
        self.result_pub = rospy.Publisher(full + "/result", self.ActionResult, queue_size=out)
        self.feedback_pub = rospy.Publisher(full + "/feedback", self.ActionFeedback, queue_size=out)
        into = _size(rospy.get_param("actionlib_server_sub_queue_size", -1), None)
        self.goal_sub = rospy.Subscriber(full + "/goal", self.ActionGoal, callback=self._ignore, queue_size=into)
        self.cancel_sub = rospy.Subscriber(full + "/cancel", messages.GoalID, callback=self._ignore, queue_size=into)
        own = full + "/status_frequency"
        name = own if rospy.has_param(own) else rospy.search_param("actionlib_status_frequency")
        self.status_frequency = 5.0 if name is None else rospy.get_param(name, 5.0)
        rospy.get_param(full + "/status_list_timeout", 5.0)
        if self.status_frequency > 0:
            self.status_timer = rospy.Timer(rospy.Duration(1.0 / self.status_frequency), self._ignore)

    def stop(self) -> None:
        for each in (self.goal_sub, self.cancel_sub, self.status_pub, self.feedback_pub, self.result_pub):
            each.unregister()

    def _ignore(self, message: Any) -> None:
        pass
