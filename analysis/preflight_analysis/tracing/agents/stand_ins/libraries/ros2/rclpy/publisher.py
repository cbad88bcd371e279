"""Publishers: nobody hears them."""

from __future__ import annotations

from typing import Any

from .duration import Duration


class Publisher:
    """One end of a topic."""

    def __init__(self, node: Any, msg_type: Any, topic: str, qos_profile: Any, full_name: str) -> None:
        self.msg_type, self.topic, self.qos_profile = msg_type, topic, qos_profile
        self.topic_name = full_name
        self.event_handlers: list[Any] = []
        self._node = node

    def publish(self, msg: Any) -> None:
        """Raises `TypeError` for another type."""
        if not isinstance(msg, (self.msg_type, bytes)) and not hasattr(msg, "_preflight_name"):
            raise TypeError(f"Expected {self.msg_type}, got {type(msg)}")

    def get_subscription_count(self) -> int:
        return 0

    def assert_liveliness(self) -> None:
        pass

    def wait_for_all_acked(self, timeout: Any = Duration(seconds=-1)) -> bool:  # noqa: B008
        return True

    def destroy(self) -> None:
        pass
