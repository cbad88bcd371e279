"""Subscriptions: they hear nobody."""

from __future__ import annotations

from typing import Any


class Subscription:
    """One end of a topic."""

    def __init__(self, msg_type: Any, topic: str, callback: Any, qos_profile: Any, full_name: str) -> None:
        self.msg_type, self.topic, self.callback, self.qos_profile = msg_type, topic, callback, qos_profile
        self.topic_name = full_name
        self.event_handlers: list[Any] = []

    def get_publisher_count(self) -> int:
        return 0

    def destroy(self) -> None:
        pass


MessageInfo = dict
"""What is known of a message that has come."""
