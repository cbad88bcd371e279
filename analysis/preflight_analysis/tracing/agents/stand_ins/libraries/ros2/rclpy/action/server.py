"""Servers of actions: no client has goals."""

from __future__ import annotations

import enum
from typing import Any


class GoalResponse(enum.Enum):
    """Whether a goal is taken."""

    REJECT = 1
    ACCEPT = 2


class CancelResponse(enum.Enum):
    """Whether it is given up."""

    REJECT = 1
    ACCEPT = 2


class ServerGoalHandle:
    """A goal."""


def default_handle_accepted_callback(goal_handle: Any) -> None:
    goal_handle.execute()


def default_goal_callback(goal_request: Any) -> GoalResponse:
    return GoalResponse.ACCEPT


def default_cancel_callback(cancel_request: Any) -> CancelResponse:
    return CancelResponse.REJECT


class ActionServer:
    """The end that takes goals."""

    def __init__(
        self,
        node: Any,
        action_type: Any,
        action_name: str,
        execute_callback: Any,
        *,
        callback_group: Any = None,
        goal_callback: Any = None,
        handle_accepted_callback: Any = None,
        cancel_callback: Any = None,
        goal_service_qos_profile: Any = None,
        result_service_qos_profile: Any = None,
        cancel_service_qos_profile: Any = None,
        feedback_pub_qos_profile: Any = None,
        status_pub_qos_profile: Any = None,
        result_timeout: Any = 900,
    ) -> None:
        self._node, self.action_type, self._action_name = node, action_type, action_name

    def register_handle_accepted_callback(self, handle_accepted_callback: Any) -> None:
        pass

    def register_goal_callback(self, goal_callback: Any) -> None:
        pass

    def register_cancel_callback(self, cancel_callback: Any) -> None:
        pass

    def register_execute_callback(self, execute_callback: Any) -> None:
        pass

    def destroy(self) -> None:
        pass
