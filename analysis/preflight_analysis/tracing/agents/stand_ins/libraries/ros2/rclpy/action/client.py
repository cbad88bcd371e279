"""Clients of actions: no server answers."""

from __future__ import annotations

import time
from typing import Any

from ..task import Future


class ClientGoalHandle:
    """A goal."""


class ActionClient:
    """The end that sends goals."""

    def __init__(
        self,
        node: Any,
        action_type: Any,
        action_name: str,
        *,
        callback_group: Any = None,
        goal_service_qos_profile: Any = None,
        result_service_qos_profile: Any = None,
        cancel_service_qos_profile: Any = None,
        feedback_sub_qos_profile: Any = None,
        status_sub_qos_profile: Any = None,
    ) -> None:
        self._node, self._action_type, self._action_name = node, action_type, action_name

    def send_goal(self, goal: Any, **kwargs: Any) -> Any:
        while self._node.context.ok():
            time.sleep(0.05)

    def send_goal_async(self, goal: Any, feedback_callback: Any = None, goal_uuid: Any = None) -> Future:
        return Future()

    def server_is_ready(self) -> bool:
        return False

    def wait_for_server(self, timeout_sec: Any = None) -> bool:
        end = None if timeout_sec is None else time.monotonic() + timeout_sec
        while self._node.context.ok() and not self.server_is_ready() and (end is None or time.monotonic() < end):
            time.sleep(0.05)
        return bool(self.server_is_ready())

    def destroy(self) -> None:
        pass
