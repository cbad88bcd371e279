"""FRM004: a frame with a slash in front, which tf2 refuses.

https://github.com/ros2/geometry2/blob/rolling/tf2/src/buffer_core.cpp (`BufferCore::validateFrameId`)
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from preflight_analysis.evaluation import names
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context
from preflight_analysis.model.distributions import BEFORE_MELODIC, otherwise_in
from preflight_analysis.model.frames import frames_of, place_of_mention, place_of_param, place_of_use
from preflight_analysis.model.parameters import by_namespace
from preflight_analysis.model.problems import include_chain, rename
from preflight_analysis.model.well_known import is_transform
from preflight_analysis.rules.further_reading import FRAMES, TF2
from preflight_analysis.rules.rule import Rule
from preflight_analysis.tracing.interface import BUFFER

_REFUSE = re.compile(rf"{BUFFER}::|[a-z]+_")
"""What gets a frame in the source of a node of ROS 1 and is of tf2: its methods in Python have underscores."""
_REFUSE_ROS1 = ("move_base", frozenset(("melodic", "noetic")))
"""The package of ROS 1 whose parameters name frames that it asks tf2 for, and the distributions since it does
(https://github.com/ros-planning/navigation/blob/noetic-devel/costmap_2d/src/costmap_2d_ros.cpp)."""
_STRIP = frozenset(("MessageFilter", "setTargetFrame", "setTargetFrames"))
"""What takes the slash off itself (`tf2_ros::MessageFilter::stripSlash`)."""


_SAID = "frame '{frame}' begins with '/', which tf2 refuses: {node} {does}"
_OF_COSTMAPS = ("global_frame", "robot_base_frame")


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    yield from _of_uses(rule, context)
    yield from (_of_mentions if context.tree.ros.ament else _of_costmaps)(rule, context)


def _of_costmaps(rule: Rule, context: Context) -> Iterator[Finding]:
    """ROS 1: costmaps of other nodes than move_base."""
    nodes = {node.name for node in context.tree.nodes if node.package != _REFUSE_ROS1[0]}
    asked = _ask_tf2(context)
    groups = by_namespace(context) if asked is not False else {}
    costmaps = [space for space in groups if "costmap" in space and "costmap" in names.leaf(space)]
    for above, param in ((space, param) for space in costmaps for param in groups[space]):
        written = param.value
        if names.leaf(param.name) not in _OF_COSTMAPS or not isinstance(written, str) or not written.startswith("/"):
            continue
        if not written.strip("/") or names.parent(above).rstrip("/") not in nodes:
            continue
        place = place_of_param(context, param)
        yield rule.claim(
            f"frame '{written}' begins with '/', which tf2 refuses: '{param.name}' has it",
            place,
            subject=Subject("frame", written),
            doubts=(
                *doubts(OTHER_VERSION=asked is None, NOT_ANALYSED=names.parent(above)),
                *otherwise_in(context.environment, BEFORE_MELODIC),
            ),
            related=include_chain(param.origin),
            fixes=rename(context, place, written, written.lstrip("/")),
        )


def _ask_tf2(context: Context) -> bool | None:
    """Whether costmaps of ROS 1 ask tf2; None where neither the distribution nor the project itself tells."""
    environment = context.environment
    if environment.distro is not None:
        return environment.distro in _REFUSE_ROS1[1]
    return any(name.startswith("tf2") for each in environment.own_packages for name in each.dependencies) or None


def _of_mentions(rule: Rule, context: Context) -> Iterator[Finding]:
    broadcasters = _broadcasters(context)
    for mention in frames_of(context).mentions:
        written = str(mention.param.value)
        # Who gets what a node broadcasts takes it off (`BufferCore::setTransform`).
        if written.startswith("/") and mention.node.package != "tf2_ros":
            place = place_of_mention(context, mention)
            name = mention.node.name
            yield rule.claim(
                say(_SAID, frame=written, node=name, does=f"gets it as '{mention.parameter}'"),
                place,
                subject=Subject("frame", written),
                doubts=doubts(ASSUMED=name in broadcasters, NOT_ANALYSED=name),
                fixes=rename(context, place, written, mention.frame),
            )


@derived
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
        asked: bool | None = True
        of_costmap = False
        if not context.tree.ros.own_parameters:
            of_costmap = use.node.package == _REFUSE_ROS1[0] and not use.call
            if not use.looked_up or not (of_costmap or _REFUSE.match(use.call)):
                continue  # tf takes it off
            if of_costmap and (asked := _ask_tf2(context)) is False:
                continue
            is_sure = is_sure or of_costmap
        told.add((id(use.node), use.written))
        place = place_of_use(context, use)
        name = use.node.name
        yield rule.claim(
            say(_SAID, frame=use.written, node=name, does=f"uses it ({use.what})"),
            place,
            subject=Subject("frame", use.written),
            doubts=(
                *doubts(ASSUMED=not is_sure, OTHER_VERSION=asked is None, NOT_ANALYSED=name if not use.sure else ""),
                *(otherwise_in(context.environment, BEFORE_MELODIC) if of_costmap else ()),
            ),
            related=include_chain(use.node.origin) if use.param is None else (),
            fixes=rename(context, place, use.written, use.frame) if use.param is not None else (),
        )


RULE = Rule(
    id="FRM004",
    name="leading-slash",
    effect="breaks",
    kind="invalid",
    always=(Reason.LIBRARY,),
    sometimes=(Reason.OTHER_VERSION, Reason.MEANT_FOR_OTHER, Reason.NOT_ANALYSED, Reason.ASSUMED),
    what="Checks for a frame that begins with `/`. It may be in a parameter, in a transform that a node looks up, or "
    "in the configuration of RViz. In ROS 1 it checks what asks tf2, such as costmaps.",
    why="tf2 refuses the frame: `Invalid frame ID: frame_ids cannot start with a '/'`. The tf library of ROS 1 removed "
    "the slash.",
    example="slam_toolbox:\n  ros__parameters:\n    base_frame: /base_link",
    instead="slam_toolbox:\n  ros__parameters:\n    base_frame: base_link",
    references=(TF2, FRAMES),
    check=_check,
    in_branches=True,
)
