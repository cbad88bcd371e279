"""Transforms by the older library, which asks tf2 for them (http://wiki.ros.org/tf)."""

from __future__ import annotations

import importlib
from typing import Any

import tf2_ros  # type: ignore[import-not-found]

Exception = tf2_ros.TransformException
ConnectivityException = tf2_ros.ConnectivityException
LookupException = tf2_ros.LookupException
ExtrapolationException = tf2_ros.ExtrapolationException


def __getattr__(name: str) -> Any:
    if name.startswith("__"):
        raise AttributeError(name)
    return importlib.import_module("preflight_agents.anything").Anything(f"tf.{name}")


def _rospy() -> Any:
    return importlib.import_module("rospy")


class Transformer:
    """What is known of transforms."""

    def __init__(self, interpolate: bool = True, cache_time: Any = None) -> None:
        self._buffer = tf2_ros.Buffer(cache_time, debug=False)

    def canTransform(self, target_frame: Any, source_frame: Any, time: Any) -> Any:
        return self._buffer.can_transform(target_frame.strip("/"), source_frame.strip("/"), time)

    def waitForTransform(
        self, target_frame: Any, source_frame: Any, time: Any, timeout: Any, polling_sleep_duration: Any = None
    ) -> None:
        names = target_frame.strip("/"), source_frame.strip("/")
        if not self._buffer.can_transform(*names, time, timeout):
            raise Exception(f"cannot transform {names[1]} to {names[0]}")

    def lookupTransform(self, target_frame: Any, source_frame: Any, time: Any) -> Any:
        found = self._buffer.lookup_transform(target_frame.strip("/"), source_frame.strip("/"), time).transform
        at, turned = found.translation, found.rotation
        return [at.x, at.y, at.z], [turned.x, turned.y, turned.z, turned.w]

    def frameExists(self, frame_id: Any) -> bool:
        return False

    def getLatestCommonTime(self, source_frame: Any, dest_frame: Any) -> Any:
        return _rospy().Time(0)

    def setTransform(self, *args: Any) -> None:
        pass

    def clear(self) -> None:
        pass


class TransformerROS(Transformer):
    """With messages."""

    def transformPoint(self, target_frame: Any, ps: Any) -> Any:
        self.lookupTransform(target_frame, ps.header.frame_id, ps.header.stamp)
        return ps

    transformPose = transformVector3 = transformQuaternion = transformPointCloud = transformPoint

    def fromTranslationRotation(self, translation: Any, rotation: Any) -> Any:
        return importlib.import_module("preflight_agents.anything").Anything("tf.fromTranslationRotation()")

    asMatrix = fromTranslationRotation


class TransformListener(TransformerROS):
    """Hears transforms."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__()
        self._listener = tf2_ros.TransformListener(self._buffer)
        self.setUsingDedicatedThread(True)

    def setUsingDedicatedThread(self, value: bool) -> None:
        pass


class TransformBroadcaster:
    """Tells transforms."""

    def __init__(self, queue_size: int = 100) -> None:
        self.tf2_broadcaster = tf2_ros.TransformBroadcaster()

    def sendTransform(self, translation: Any, rotation: Any, time: Any, child: str, parent: str) -> None:
        made = importlib.import_module("geometry_msgs.msg").TransformStamped()
        made.header.frame_id, made.header.stamp, made.child_frame_id = parent, time, child
        self.sendTransformMessage(made)

    def sendTransformMessage(self, transform: Any) -> None:
        self.tf2_broadcaster.sendTransform(transform)
