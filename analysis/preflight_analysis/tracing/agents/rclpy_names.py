"""Who calls rclpy, and what a name means that a node of rclpy gives."""

from __future__ import annotations

import os
import sys
from types import FrameType
from typing import Any, Optional

from . import channel
from .variables import EXPECTED

LIBRARIES = frozenset(("rclpy", "preflight_agents", "functools", "tf2_ros", "message_filters", "diagnostic_updater"))
"""Frames in these are not the node's own."""


def top_package(frame: FrameType) -> str:
    """The package whose code a frame runs."""
    return str(frame.f_globals.get("__name__", "")).partition(".")[0]


def caller() -> tuple[Optional[str], Optional[int], bool]:
    """File and line of the node's own call, and whether rclpy makes it for each node, when that is constructed."""
    frame: Optional[FrameType] = sys._getframe(1)
    internal = False
    while frame is not None and top_package(frame) in LIBRARIES:
        if top_package(frame) == "rclpy":
            of_node = frame.f_globals.get("__name__") == "rclpy.node"
            internal = internal or (of_node and frame.f_code.co_name == "__init__")
        frame = frame.f_back
    if frame is None:
        return None, None, internal
    return frame.f_code.co_filename, frame.f_lineno, internal


def given_name(node: Any, name: str) -> str:
    """The name as the node gave it, where the launch file's node would come to the same; else the full one."""
    expected = os.environ.get(EXPECTED, "")
    space, _, base = expected.rpartition("/")
    private = name == "~" or name.startswith("~/")
    in_place = (node.get_namespace().rstrip("/") or "") == space and (not private or node.get_name() == base)
    if name.startswith("/") or (in_place and "{" not in name):
        return name
    channel.send("asked", what="name")
    return expanded(node, name)


def expanded(node: Any, name: str) -> str:
    """The full name of one that the node gives, before remaps."""
    expand = sys.modules["rclpy.expand_topic_name"].expand_topic_name  # of those that rclpy.node imports
    return str(expand(name, node.get_name(), node.get_namespace()))


def full_name(node: Any) -> str:
    """The node's own."""
    return f"{str(node.get_namespace()).rstrip('/')}/{node.get_name()}"
