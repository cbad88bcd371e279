"""The transforms that a rospy node broadcasts: whichever library it uses, it publishes them on a topic."""

from __future__ import annotations

import functools
from typing import Any

from . import channel

_TYPES = ("tf2_msgs/TFMessage", "tf/tfMessage")
_MAX_FRAMES = 200

_reported: set[tuple[str, str, bool]] = set()


def watch(publisher: Any) -> None:
    """Tell the frames of what `publisher` publishes, if that is transforms."""
    if getattr(publisher.data_class, "_type", None) not in _TYPES:
        return
    publish = publisher.publish
    static = publisher.resolved_name.endswith("/tf_static")

    @functools.wraps(publish)
    def published(*args: Any, **kwargs: Any) -> Any:
        try:
            _report(args[0] if args else kwargs.get("transforms"), static)
        except Exception as error:
            channel.send("weave-failed", message=repr(error))
        return publish(*args, **kwargs)

    publisher.publish = published


def _report(message: Any, static: bool) -> None:
    if len(_reported) >= _MAX_FRAMES:
        return
    transforms = getattr(message, "transforms", message)
    if not isinstance(transforms, (list, tuple)):
        return
    for transform in transforms[:_MAX_FRAMES]:
        frame = (str(transform.header.frame_id), str(transform.child_frame_id), static)
        if frame not in _reported:
            _reported.add(frame)
            channel.send("frame", parent=frame[0], child=frame[1], static=static)
