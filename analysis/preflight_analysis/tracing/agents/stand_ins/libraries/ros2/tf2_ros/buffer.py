"""What is known of transforms: nothing."""

from __future__ import annotations

import importlib
from typing import Any

from . import exceptions as tf2
from .exceptions import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)


class BufferInterface:
    """What can be asked."""

    def transform(self, object_stamped: Any, target_frame: Any, timeout: Any = None, new_type: Any = None) -> Any:
        raise LookupException(f'"{target_frame}" passed to lookupTransform argument target_frame does not exist. ')


class Buffer(BufferInterface):
    """What a listener would fill."""

    def __init__(self, cache_time: Any = None, node: Any = None) -> None:
        if node is not None:
            kind = importlib.import_module("tf2_msgs.srv").FrameGraph
            self.srv = node.create_service(kind, "tf2_frames", lambda request, response: response)

    def can_transform(
        self, target_frame: Any, source_frame: Any, time: Any, timeout: Any = None, return_debug_tuple: bool = False
    ) -> Any:
        return (False, "") if return_debug_tuple else False

    def lookup_transform(self, target_frame: Any, source_frame: Any, time: Any, timeout: Any = None) -> Any:
        raise LookupException(f'"{target_frame}" passed to lookupTransform argument target_frame does not exist. ')

    async def lookup_transform_async(self, target_frame: Any, source_frame: Any, time: Any) -> Any:
        raise LookupException(f'"{target_frame}" passed to lookupTransform argument target_frame does not exist. ')

    def wait_for_transform_async(self, target_frame: Any, source_frame: Any, time: Any) -> Any:
        return importlib.import_module("rclpy.task").Future()

    def set_transform(self, transform: Any, authority: Any = "") -> None:
        pass

    set_transform_static = set_transform

    def clear(self) -> None:
        pass


__all__ = [
    "Buffer",
    "BufferInterface",
    "ConnectivityException",
    "ExtrapolationException",
    "InvalidArgumentException",
    "LookupException",
    "TimeoutException",
    "TransformException",
    "tf2",
]
