"""Filters of messages (http://wiki.ros.org/message_filters): only their subscribers do something."""

from __future__ import annotations

import importlib
import os
from typing import Any


class SimpleFilter:
    """What hands messages on."""

    def __init__(self) -> None:
        self.callbacks: dict[int, Any] = {}

    def registerCallback(self, cb: Any, *args: Any) -> int:
        self.callbacks[len(self.callbacks)] = (cb, args)
        return len(self.callbacks) - 1

    def signalMessage(self, *msg: Any) -> None:
        for callback, arguments in list(self.callbacks.values()):
            callback(*(msg + arguments))


class Subscriber(SimpleFilter):
    """A subscriber: of rospy with its arguments; of rclpy with a node before them."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__()
        if "PREFLIGHT_NODE" in os.environ:
            node, kind, topic, *rest = args if len(args) > 2 else (*args, kwargs.pop("topic", kwargs.pop("name", "")))
            profile = rest[0] if rest else kwargs.pop("qos_profile", 10)
            self.topic = topic
            self.sub = node.create_subscription(kind, topic, self.signalMessage, profile, **kwargs)
        else:
            self.topic = str(args[0]) if args else str(kwargs.get("name"))
            self.sub = importlib.import_module("rospy").Subscriber(*args, callback=self.signalMessage, **kwargs)

    def getTopic(self) -> str:
        return str(self.topic)

    def __getattr__(self, name: str) -> Any:
        if name in ("sub", "topic", "callbacks") or name.startswith("__"):
            raise AttributeError(name)
        return getattr(self.sub, name)


class Cache(SimpleFilter):
    """The last messages: there are none."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__()

    def add(self, msg: Any) -> None:
        pass

    def getInterval(self, from_stamp: Any, to_stamp: Any) -> list[Any]:
        return []

    def getElemAfterTime(self, stamp: Any) -> Any:
        return None

    getElemBeforeTime = getElemAfterTime

    def getLast(self) -> Any:
        return None


class TimeSynchronizer(SimpleFilter):
    """Messages of the same time: there are none."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__()


class ApproximateTimeSynchronizer(TimeSynchronizer):
    """Messages of about the same time."""
