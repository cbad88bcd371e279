"""What is known of transforms: nothing."""

from __future__ import annotations

import importlib
import time as system
from typing import Any

from . import exceptions as tf2
from .exceptions import LookupException


class BufferInterface:
    """What can be asked."""

    def transform(self, object_stamped: Any, target_frame: Any, timeout: Any = None, new_type: Any = None) -> Any:
        self.lookup_transform(target_frame, object_stamped.header.frame_id, object_stamped.header.stamp, timeout)  # type: ignore[attr-defined]
        return object_stamped

    def registration(self) -> Any:
        return None


class Buffer(BufferInterface):
    """What a listener would fill."""

    def __init__(self, cache_time: Any = None, debug: bool = True) -> None:
        if debug:
            rospy = importlib.import_module("rospy")
            kind = importlib.import_module("tf2_msgs.srv").FrameGraph
            rospy.get_master().lookupService(rospy.names.resolve_name("~tf2_frames"))
            self.frame_server = rospy.Service("~tf2_frames", kind, lambda request: None)

    def can_transform(
        self, target_frame: Any, source_frame: Any, time: Any, timeout: Any = None, return_debug_tuple: bool = False
    ) -> Any:
        seconds = timeout.to_sec() if hasattr(timeout, "to_sec") else 0
        system.sleep(max(0.0, min(seconds, 10.0)))
        return (False, "") if return_debug_tuple else False

    def lookup_transform(self, target_frame: Any, source_frame: Any, time: Any, timeout: Any = None) -> Any:
        self.can_transform(target_frame, source_frame, time, timeout)
        raise LookupException(f'"{target_frame}" passed to lookupTransform argument target_frame does not exist. ')

    def set_transform(self, transform: Any, authority: Any = "") -> None:
        pass

    set_transform_static = set_transform

    def clear(self) -> None:
        pass


__all__ = ["Buffer", "BufferInterface", "tf2"]
