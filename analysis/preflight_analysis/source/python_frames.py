"""The frames in a Python program: of messages, of the transforms that it broadcasts, and of those that it asks for."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from preflight_analysis.source.collector import Collector
from preflight_analysis.source.python_operators import items_of
from preflight_analysis.source.python_values import UNKNOWN, Class, Instance, known

_MESSAGE = re.compile(r"(geometry_msgs|nav_msgs|sensor_msgs|std_msgs)\.msg\.(?:_\w+\.)?([A-Z]\w*)\Z")
_LOOK_UP: Mapping[str, tuple[tuple[int, str], ...]] = {
    **dict.fromkeys(
        (
            *("lookup_transform", "can_transform", "lookup_transform_async", "wait_for_transform_async"),
            *("lookupTransform", "canTransform", "waitForTransform", "lookupTwist"),
        ),
        ((0, "target_frame"), (1, "source_frame")),
    ),
    **dict.fromkeys(
        (
            *("lookup_transform_full", "can_transform_full", "lookup_transform_full_async"),
            *("lookupTransformFull", "canTransformFull", "waitForTransformFull"),
        ),
        ((0, "target_frame"), (2, "source_frame"), (4, "fixed_frame")),
    ),
    "transform": ((1, "target_frame"),),
    **dict.fromkeys(
        (f"transform{kind}" for kind in ("Point", "Pose", "PointCloud", "Quaternion", "Vector3")),
        ((0, "target_frame"),),
    ),
}
"""Methods of listeners and buffers, with the arguments that are frames."""
_OWNER = re.compile(r"tf2?(?:_ros)?\.(?:\w+\.)*(\w+)\(\)\.(\w+)\Z")
_LISTENS = frozenset(("Buffer", "BufferClient", "Transformer", "TransformerROS", "TransformListener"))
_HAS_TREE = frozenset(("tf.TransformListener", "tf.TransformerROS", "tf2_ros.Buffer", "tf2_ros.BufferClient"))
_BROADCAST = ("sendTransform", "sendTransformMessage")
_STATIC = "StaticTransformBroadcaster"


class Message(Instance):
    """A message with the fields that are set; the name of its class is its type."""

    __slots__ = ()

    def copy(self) -> Message:
        """Another message that says the same."""
        return Message(self.cls, {k: v.copy() if isinstance(v, Message) else v for k, v in self.names.items()})


def message_of(path: str, kwargs: Mapping[str, Any]) -> Message | None:
    """A message that is made; None where `path` is another class."""
    found = _MESSAGE.match(path)
    if found is None:
        return None
    names = dict(kwargs)
    if found[2] != "Header":
        names.setdefault("header", Message(Class("std_msgs/Header", {}, ())))
    return Message(Class(f"{found[1]}/{found[2]}", {}, ()), names)


def has_tree(name: str) -> bool:
    """Whether it is a class that is asked for transforms, by its name without modules: `tf2_ros.Buffer`."""
    return name in _HAS_TREE


def note_frames(
    collected: Collector, path: str, args: Sequence[Any], kwargs: Mapping[str, Any], file: str, line: int
) -> None:
    """Note the frames of a call, if it has any."""
    method = path.rpartition(".")[2]

    def given(index: int, keyword: str) -> Any:
        return known(args[index] if index < len(args) else kwargs.get(keyword, UNKNOWN))

    if method == "publish":
        message = given(0, "msg")
        if isinstance(message, Message):
            collected.use_frame(_ends(message)[0], message.cls.name, False, file, line)
        return
    owner = _OWNER.match(path)
    if owner is None:
        return
    if method in _BROADCAST:
        if path.startswith("tf.") and method == "sendTransform":
            ends = [(given(4, "parent"), given(3, "child"))]
        else:
            first = given(0, "transform")
            ends = [_ends(known(each)) for each in (items_of(first) or [first])]
        for parent, child in ends:
            collected.broadcast(parent, child, owner[1] == _STATIC, file, line)
    elif owner[1] in _LISTENS:
        for index, keyword in _LOOK_UP.get(method, ()):
            collected.use_frame(given(index, keyword), method, True, file, line)


def _ends(value: Any) -> tuple[Any, Any]:
    """The frame of a message's header, and the child frame of a transform."""
    if not isinstance(value, Message):
        return UNKNOWN, UNKNOWN
    header = value.names.get("header")
    parent = header.names.get("frame_id", UNKNOWN) if isinstance(header, Message) else UNKNOWN
    return known(parent), known(value.names.get("child_frame_id", UNKNOWN))


def broadcasts_in(tree: ast.Module) -> Iterator[int]:
    """The lines of a module that broadcast transforms."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr in _BROADCAST:
            yield node.lineno
