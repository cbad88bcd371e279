"""Transforms (http://wiki.ros.org/tf2_ros): their topics; there are no transforms."""

from __future__ import annotations

import importlib
from typing import Any

from . import buffer
from .buffer import Buffer, BufferInterface
from .exceptions import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)


def __getattr__(name: str) -> Any:
    if name.startswith("__"):
        raise AttributeError(name)
    return importlib.import_module("preflight_agents.anything").Anything(f"tf2_ros.{name}")


def _node_library() -> Any:
    return importlib.import_module("rospy")


class TransformListener:
    """Hears transforms."""

    def __init__(self, buffer: Any, queue_size: Any = None, buff_size: int = 65536, tcp_nodelay: bool = False) -> None:
        rospy, kind = _node_library(), importlib.import_module("tf2_msgs.msg").TFMessage
        self.buffer = buffer
        more = {"queue_size": queue_size, "buff_size": buff_size, "tcp_nodelay": tcp_nodelay}
        self.tf_sub = rospy.Subscriber("/tf", kind, self._ignore, **more)
        self.tf_static_sub = rospy.Subscriber("/tf_static", kind, self._ignore, **more)

    def _ignore(self, message: Any) -> None:
        pass

    def unregister(self) -> None:
        self.tf_sub.unregister()
        self.tf_static_sub.unregister()


class TransformBroadcaster:
    """Tells transforms."""

    _topic, _latch = "/tf", False

    def __init__(self) -> None:
        self._kind = importlib.import_module("tf2_msgs.msg").TFMessage
        more = {"latch": True} if self._latch else {}
        self.pub_tf = _node_library().Publisher(self._topic, self._kind, queue_size=100, **more)

    def sendTransform(self, transform: Any) -> None:
        found = transform if isinstance(transform, (list, tuple)) else [transform]
        self.pub_tf.publish(self._kind(transforms=list(found)))


class StaticTransformBroadcaster(TransformBroadcaster):
    """Tells those that do not change."""

    _topic, _latch = "/tf_static", True


class BufferClient(BufferInterface):
    """Asks a server for transforms."""

    def __init__(self, ns: str, check_frequency: Any = None, timeout_padding: Any = None) -> None:
        kind = importlib.import_module("tf2_msgs.msg").LookupTransformAction
        self.client = importlib.import_module("actionlib").SimpleActionClient(ns, kind)


__all__ = [
    "Buffer",
    "BufferClient",
    "BufferInterface",
    "ConnectivityException",
    "ExtrapolationException",
    "InvalidArgumentException",
    "LookupException",
    "StaticTransformBroadcaster",
    "TimeoutException",
    "TransformBroadcaster",
    "TransformException",
    "TransformListener",
    "buffer",
]
