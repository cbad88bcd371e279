"""FRM004: a frame with a slash in front, which tf2 refuses.

https://github.com/ros2/geometry2/blob/rolling/tf2/src/buffer_core.cpp (`BufferCore::validateFrameId`)
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from preflight_analysis.findings.finding import Finding, Severity
from preflight_analysis.rules.frames import frames_of, place_of_use
from preflight_analysis.rules.further_reading import FRAMES, TF2
from preflight_analysis.rules.problems import include_chain, rename
from preflight_analysis.rules.rule import Context, Rule
from preflight_analysis.tracing.interface import BUFFER

_REFUSE = re.compile(rf"{BUFFER}::|[a-z]+_")
"""What gets a frame in the source of a node of ROS 1 and is of tf2: its methods in Python have underscores."""
_REFUSE_ROS1 = ("move_base", frozenset(("melodic", "noetic")))
"""The package of ROS 1 whose parameters name frames that it asks tf2 for, and the distributions since it does
(https://github.com/ros-planning/navigation/blob/noetic-devel/costmap_2d/src/costmap_2d_ros.cpp)."""
_STRIP = frozenset(("MessageFilter", "setTargetFrame", "setTargetFrames"))
"""What takes the slash off itself (`tf2_ros::MessageFilter::stripSlash`)."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    told: set[tuple[int, str]] = set()  # the default of one parameter may be the value of another
    for use in frames_of(context).uses:
        if not use.written.startswith("/") or (id(use.node), use.written) in told or use.call in _STRIP:
            continue
        severity: Severity | None = None if use.sure and (use.looked_up or not use.call) else "info"
        if not context.tree.ros.own_parameters:
            package, distributions = _REFUSE_ROS1
            of_package = use.node.package == package and not use.call
            if not use.looked_up or not (of_package or _REFUSE.match(use.call)):
                continue  # tf takes it off
            if of_package and (distro := context.environment.distro) not in distributions:
                if distro is not None:
                    continue
                severity = "info"
        told.add((id(use.node), use.written))
        place = place_of_use(context, use)
        yield rule.finding(
            f"frame '{use.written}' begins with '/', which tf2 refuses: {use.node.name} uses it ({use.what})",
            place,
            severity=severity,
            confidence="likely" if use.sure else "possible",
            related=include_chain(use.node.origin) if use.param is None else (),
            fixes=rename(context, place, use.written, use.frame) if use.param is not None else (),
        )


RULE = Rule(
    id="FRM004",
    name="leading-slash",
    severity="warning",
    what="Checks for a frame that begins with `/` in the parameters of a ROS 2 node, in a transform that it looks "
    "up, or in the configuration of RViz. Of nodes of ROS 1 it checks what their source asks of tf2, and "
    "the frames of the costmaps of `move_base`: a warning in Melodic and Noetic, information where the distribution is "
    "unknown.",
    why="tf2 refuses the frame: `Invalid frame ID: frame_ids cannot start with a '/'`. The tf library of ROS 1 removed "
    "the slash.",
    example="slam_toolbox:\n  ros__parameters:\n    base_frame: /base_link",
    instead="slam_toolbox:\n  ros__parameters:\n    base_frame: base_link",
    references=(TF2, FRAMES),
    check=_check,
    in_branches=True,
)
