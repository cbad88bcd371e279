"""The coordinate frames that a node broadcasts."""

from __future__ import annotations

import itertools
import re
import shlex
from collections.abc import Sequence

from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.tracing.interface import Frame, Interface

_PACKAGES = ("tf", "tf2_ros")
_NUMBERS = (6, 7)
"""How many numbers stand before the frames: a translation, and Euler angles or a quaternion."""
_NUMBER = re.compile(r"\s*[-+]?(?:\d|\.\d|inf|nan)", re.IGNORECASE)
_PARENT, _CHILD = "--frame-id", "--child-frame-id"
_PARENT_PARAM, _CHILD_PARAM = "frame_id", "child_frame_id"


def frames_of(node: LaunchNode, interface: Interface) -> tuple[Frame, ...]:
    """Those that a run saw or the source tells, and for `static_transform_publisher` what its arguments say."""
    given = frame_in_arguments(node)
    known = tuple(frame for frame in interface.frames if frame.parent and frame.child)
    if given is None:
        return known
    return tuple(sorted({given, *(f for f in known if (f.parent, f.child) != (given.parent, given.child))}))


def frame_in_arguments(node: LaunchNode) -> Frame | None:
    """What the arguments of a static transform publisher say: `x y z yaw pitch roll frame_id child_frame_id`, with a
    period at the end for tf's, which is not static; in ROS 2 also by options, and by parameters of the component."""
    if node.package not in _PACKAGES or node.unknowns:
        return None
    if node.plugin is not None:
        values = {param.name: param.value for param in node.params}
        parent, child = values.get(_PARENT_PARAM), values.get(_CHILD_PARAM)
        named = (
            isinstance(parent, str)
            and isinstance(child, str)
            and node.plugin.endswith("StaticTransformBroadcasterNode")
        )
        return Frame(str(parent), str(child), True) if named else None
    words = static_transform_words(node)
    if words is None:
        return None
    if _PARENT in words or _CHILD in words:
        parent, child = _option(words, _PARENT), _option(words, _CHILD)
        return Frame(parent, child, True) if parent and child else None
    static = node.package == "tf2_ros"
    # With a period that tf2's takes for a frame: what is meant, FRM006 reports it.
    if not static or (len(words) - 2 == max(_NUMBERS) and not begins_with_number(words[-3])):
        words = words[:-1]
    if len(words) - 2 not in _NUMBERS:
        return None
    return Frame(words[-2], words[-1], static)


def static_transform_words(node: LaunchNode) -> list[str] | None:
    """The command line of a static transform publisher; None of another node, and where a part of it is not known."""
    if node.package not in _PACKAGES or node.plugin is not None or node.executable != "static_transform_publisher":
        return None
    if "$(" in node.args:
        return None  # a part of them is not known
    try:
        words = shlex.split(node.args)
    except ValueError:
        return None
    # What follows is for the client library.
    return [*itertools.takewhile(lambda word: word != "--ros-args" and ":=" not in word, words)]


def begins_with_number(word: str) -> bool:
    """Whether `atof` and `std::stod` make a number of it: they read as far as it goes."""
    return _NUMBER.match(word) is not None


def _option(words: Sequence[str], name: str) -> str:
    return next((value for word, value in itertools.pairwise(words) if word == name), "")
