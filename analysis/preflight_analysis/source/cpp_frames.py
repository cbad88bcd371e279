"""The frames in a C++ program: of messages, of the transforms that it broadcasts, and of those that it asks for."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from preflight_analysis.source.collector import Collector
from preflight_analysis.source.cpp_values import Argument, Call, CppType, Message, Unmade, value_at, values
from preflight_analysis.source.python_values import UNKNOWN
from preflight_analysis.tracing.interface import BUFFER

_MESSAGE = re.compile(r"(geometry_msgs|nav_msgs|sensor_msgs|std_msgs)::(?:msg::)?([A-Z]\w*?)_?(?:<\w+>)?\Z")
_TF1 = re.compile(r"tf2?::Stamped(?:Transform)?\Z")
_STATIC = "StaticTransformBroadcaster"
_LOOK_UP = frozenset(
    ("canTransform", "lookupTransform", "lookupTwist", "setTargetFrame", "setTargetFrames", "waitForTransform")
)
"""Methods whose texts are frames."""
_TRANSFORM = re.compile(r"transform(?:Point|Pose|PointCloud|Quaternion|Vector)?\Z")
_HAS_TREE = re.compile(r"tf2?(?:_ros)?::(?:Buffer\w*|Transformer|TransformListener)\Z")
"""Classes that transform by the tree of frames."""
MESSAGE_FILTERS = frozenset(("tf::MessageFilter", "tf2_ros::MessageFilter"))
BROADCAST = "sendTransform"
WORDS = f"{' '.join(_LOOK_UP)} {BROADCAST} frame_id frame_id_ MessageFilter"


def message_of(type_: CppType, args: Sequence[Argument] = ()) -> Message | None:
    """A message that is made of `args`, or one of tf's own types in its place; None of another type."""
    name = type_.name.removeprefix("::")
    if _TF1.match(name):
        parent, child = value_at(args, 2), value_at(args, 3)
        return Message(type_, {"frame_id_": parent, "child_frame_id_": child})
    if _MESSAGE.match(name) is None:
        return None
    first = value_at(args, 0)
    return first.copy() if len(args) == 1 and isinstance(first, Message) else Message(type_)


def note_frames(collected: Collector, owner: Any, call: Call) -> None:
    """Note the frames of a method that is called of an object of a library, if it has any."""
    kind = owner.type.name.removeprefix("::") if isinstance(owner, Unmade) else ""
    file, line = call.place.file, call.place.line
    given = values(call.args)
    if call.name == BROADCAST:
        first = given[0] if given else UNKNOWN
        for each in first if isinstance(first, list) and first else [first]:
            parent, child = _ends(each)
            collected.broadcast(parent, child, _STATIC in kind, file, line)
    elif call.name in _LOOK_UP or (_TRANSFORM.match(call.name) and _HAS_TREE.match(kind)):
        tf2 = f"{BUFFER}::" if kind.startswith(f"tf2_ros::{BUFFER}") else ""
        for frame in _texts(given):
            collected.use_frame(frame, f"{tf2}{call.name}", True, file, line)
    elif call.name == "publish" and given and isinstance(given[0], Message):
        found = _MESSAGE.match(given[0].type.name.removeprefix("::"))
        if found is not None:
            collected.use_frame(_ends(given[0])[0], f"{found[1]}/{found[2]}", False, file, line)


def note_filter(collected: Collector, args: Sequence[Argument], file: str, line: int) -> None:
    """Note the frame that a filter of messages waits for."""
    for frame in _texts(values(args)):
        collected.use_frame(frame, "MessageFilter", True, file, line)


def _texts(given: Sequence[Any]) -> list[str]:
    return [value for value in given if isinstance(value, str) and value]


def _ends(value: Any) -> tuple[Any, Any]:
    """The frame of a message's header, and the child frame of a transform."""
    if not isinstance(value, Message):
        return UNKNOWN, UNKNOWN
    if _TF1.match(value.type.name.removeprefix("::")):
        return value.names.get("frame_id_", UNKNOWN), value.names.get("child_frame_id_", UNKNOWN)
    header = value.names.get("header")
    parent = header.names.get("frame_id", UNKNOWN) if isinstance(header, Message) else UNKNOWN
    return parent, value.names.get("child_frame_id", UNKNOWN)
