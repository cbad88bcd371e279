"""The coordinate frames that a node broadcasts."""

from __future__ import annotations

import shlex

from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.tracing.interface import Frame, Interface

_PACKAGES = ("tf", "tf2_ros")
_NUMBERS = (6, 7)
"""How many numbers stand before the frames: a translation, and Euler angles or a quaternion."""


def frames_of(node: LaunchNode, interface: Interface) -> tuple[Frame, ...]:
    """Those that a run saw, and for `static_transform_publisher` what its arguments say."""
    given = _given(node)
    if given is None:
        return interface.frames
    return tuple(sorted({given, *(f for f in interface.frames if (f.parent, f.child) != (given.parent, given.child))}))


def _given(node: LaunchNode) -> Frame | None:
    """`x y z yaw pitch roll frame_id child_frame_id`, with a period at the end for tf's, which is not static."""
    if node.executable != "static_transform_publisher" or node.package not in _PACKAGES or node.unknowns:
        return None
    try:
        words = shlex.split(node.args)
    except ValueError:
        return None
    static = node.package == "tf2_ros"
    if not static:
        words = words[:-1]
    if len(words) - 2 not in _NUMBERS:
        return None
    return Frame(words[-2], words[-1], static)
