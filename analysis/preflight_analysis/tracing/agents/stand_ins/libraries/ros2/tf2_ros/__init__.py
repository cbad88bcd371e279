"""Transforms (https://docs.ros.org/en/jazzy/p/tf2_ros_py/): their topics; there are no transforms."""

from __future__ import annotations

import importlib
from typing import Any

from . import buffer
from .buffer import (
    Buffer,
    BufferInterface,
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


def _profile(**policies: Any) -> Any:
    qos = importlib.import_module("rclpy.qos")
    return qos.QoSProfile(depth=100, **policies)


def _static() -> Any:
    return _profile(durability=importlib.import_module("rclpy.qos").DurabilityPolicy.TRANSIENT_LOCAL)


class TransformListener:
    """Hears transforms."""

    def __init__(
        self,
        buffer: Any,
        node: Any,
        *,
        spin_thread: bool = False,
        qos: Any = None,
        static_qos: Any = None,
        static_only: bool = False,
    ) -> None:
        kind = importlib.import_module("tf2_msgs.msg").TFMessage
        self.buffer, self.node = buffer, node
        if not static_only:
            self.tf_sub = node.create_subscription(kind, "/tf", self._ignore, qos or _profile())
        self.tf_static_sub = node.create_subscription(kind, "/tf_static", self._ignore, static_qos or _static())

    def _ignore(self, message: Any) -> None:
        pass

    def unregister(self) -> None:
        pass


class TransformBroadcaster:
    """Tells transforms."""

    def __init__(self, node: Any, qos: Any = None) -> None:
        kind = importlib.import_module("tf2_msgs.msg").TFMessage
        self.pub_tf = node.create_publisher(kind, "/tf", qos or _profile())

    def sendTransform(self, transform: Any) -> None:
        pass


class StaticTransformBroadcaster:
    """Tells those that do not change."""

    def __init__(self, node: Any, qos: Any = None) -> None:
        policies = importlib.import_module("rclpy.qos")
        kind = importlib.import_module("tf2_msgs.msg").TFMessage
        default = policies.QoSProfile(depth=1, durability=policies.DurabilityPolicy.TRANSIENT_LOCAL)
        self.pub_tf = node.create_publisher(kind, "/tf_static", qos or default)

    def sendTransform(self, transform: Any) -> None:
        pass


__all__ = [
    "Buffer",
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
