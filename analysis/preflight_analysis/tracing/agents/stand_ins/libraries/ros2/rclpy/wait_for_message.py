"""Waiting for one message."""

from __future__ import annotations

import time
from typing import Any

from .qos import QoSProfile


def wait_for_message(
    msg_type: Any, node: Any, topic: str, *, qos_profile: Any = 1, time_to_wait: Any = -1
) -> tuple[bool, Any]:
    """Whether one came, and which."""
    profile = QoSProfile(depth=qos_profile) if isinstance(qos_profile, int) else qos_profile
    subscription = node.create_subscription(msg_type, topic, lambda message: None, profile)
    end = None if time_to_wait is False or time_to_wait < 0 else time.monotonic() + time_to_wait
    while node.context.ok() and (end is None or time.monotonic() < end):
        time.sleep(0.02)
    node.destroy_subscription(subscription)
    return False, None
