"""FRM004: a frame with a slash in front, which tf2 refuses.

https://github.com/ros2/geometry2/blob/rolling/tf2/src/buffer_core.cpp (`BufferCore::validateFrameId`)
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from preflight_analysis.evaluation import names
from preflight_analysis.findings.finding import Finding, Severity
from preflight_analysis.rules.frames import frames_of, place_of_mention, place_of_param, place_of_use
from preflight_analysis.rules.further_reading import FRAMES, TF2
from preflight_analysis.rules.problems import include_chain, rename
from preflight_analysis.rules.rule import Context, Rule
from preflight_analysis.rules.well_known import is_transform
from preflight_analysis.tracing.interface import BUFFER

_REFUSE = re.compile(rf"{BUFFER}::|[a-z]+_")
"""What gets a frame in the source of a node of ROS 1 and is of tf2: its methods in Python have underscores."""
_REFUSE_ROS1 = ("move_base", frozenset(("melodic", "noetic")))
"""The package of ROS 1 whose parameters name frames that it asks tf2 for, and the distributions since it does
(https://github.com/ros-planning/navigation/blob/noetic-devel/costmap_2d/src/costmap_2d_ros.cpp)."""
_STRIP = frozenset(("MessageFilter", "setTargetFrame", "setTargetFrames"))
"""What takes the slash off itself (`tf2_ros::MessageFilter::stripSlash`)."""


_OF_COSTMAPS = ("global_frame", "robot_base_frame")


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    yield from _of_uses(rule, context)
    yield from (_of_mentions if context.tree.ros.ament else _of_costmaps)(rule, context)


def _of_costmaps(rule: Rule, context: Context) -> Iterator[Finding]:
    """ROS 1: costmaps of other nodes than move_base."""
    nodes = {node.name for node in context.tree.nodes if node.package != _REFUSE_ROS1[0]}
    severity = _severity_of_costmaps(context)
    for param in context.tree.all_params if severity != "hint" else ():
        above, _, leaf = param.name.rpartition("/")
        written = param.value
        if leaf not in _OF_COSTMAPS or not isinstance(written, str) or not written.startswith("/"):
            continue
        owner, costmap = names.parent(above), names.leaf(above)
        if "costmap" not in costmap or not written.strip("/") or owner.rstrip("/") not in nodes:
            continue
        place = place_of_param(context, param)
        yield rule.finding(
            f"frame '{written}' begins with '/', which tf2 refuses: '{param.name}' has it",
            place,
            severity=severity,
            confidence="possible",
            related=include_chain(param.origin),
            fixes=rename(context, place, written, written.lstrip("/")),
        )


def _severity_of_costmaps(context: Context) -> Severity:
    """A hint where they do not ask tf2. Where the distribution is not known, the project itself may tell."""
    environment = context.environment
    if environment.distro is not None:
        return "warning" if environment.distro in _REFUSE_ROS1[1] else "hint"
    asks = any(name.startswith("tf2") for each in environment.own_packages for name in each.dependencies)
    return "warning" if asks else "info"


def _of_mentions(rule: Rule, context: Context) -> Iterator[Finding]:
    broadcasters = context.once(_broadcasters)
    for mention in frames_of(context).mentions:
        written = str(mention.param.value)
        # Who gets what a node broadcasts takes it off (`BufferCore::setTransform`).
        if written.startswith("/") and mention.node.package != "tf2_ros":
            place = place_of_mention(context, mention)
            yield rule.finding(
                f"frame '{written}' begins with '/', which tf2 refuses: {mention.node.name} gets it as "
                f"'{mention.parameter}'",
                place,
                severity="info" if mention.node.name in broadcasters else None,
                confidence="possible",
                fixes=rename(context, place, written, mention.frame),
            )


def _broadcasters(context: Context) -> frozenset[str]:
    """The names of the nodes that publish transforms."""
    topics = context.graph.topics.values() if context.graph is not None else ()
    of_tf = (channel for channel in topics if is_transform(channel.name))
    return frozenset(end.node.name for channel in of_tf for end in channel.providers)


def _of_uses(rule: Rule, context: Context) -> Iterator[Finding]:
    told: set[tuple[int, str]] = set()  # the default of one parameter may be the value of another
    for use in frames_of(context).uses:
        if not use.written.startswith("/") or (id(use.node), use.written) in told or use.call in _STRIP:
            continue
        # What the user of a node of ROS 2 sets is a frame in any case, whatever is known of the node.
        is_sure = (use.param is not None and context.tree.ros.own_parameters) or (
            use.sure and (use.looked_up or not use.call)
        )
        severity: Severity | None = None if is_sure else "info"
        if not context.tree.ros.own_parameters:
            of_package = use.node.package == _REFUSE_ROS1[0] and not use.call
            if not use.looked_up or not (of_package or _REFUSE.match(use.call)):
                continue  # tf takes it off
            severity = _severity_of_costmaps(context) if of_package else severity
            if severity == "hint":
                continue
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
    "`global_frame` and `robot_base_frame` of costmaps: a warning in Melodic and Noetic. Where the distribution is "
    "unknown, it is information if no package of the workspace depends on tf2. So is a parameter of a node that "
    "broadcasts transforms, if the use of the frame is not known.",
    why="tf2 refuses the frame: `Invalid frame ID: frame_ids cannot start with a '/'`. The tf library of ROS 1 removed "
    "the slash.",
    example="slam_toolbox:\n  ros__parameters:\n    base_frame: /base_link",
    instead="slam_toolbox:\n  ros__parameters:\n    base_frame: base_link",
    references=(TF2, FRAMES),
    check=_check,
    in_branches=True,
)
