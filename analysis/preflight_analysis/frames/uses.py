"""The frames that a node names: in its parameters, in what a run saw it ask for, in the configuration of RViz."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence

from preflight_analysis.documents.disk import Disk, text_of
from preflight_analysis.documents.reading import Text
from preflight_analysis.evaluation.meanings import Known, KnownMeanings, meant_of_node, own_params
from preflight_analysis.evaluation.rviz import rviz_config_of
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.frames.edges import plain, space_of
from preflight_analysis.frames.model import Mention, Use
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.robot.of_launch import Robot
from preflight_analysis.tracing.interface import FrameUse, Interface

_LEGAL = re.compile(r"/*[A-Za-z_][\w/.-]*\Z")
_NAMES_A_FRAME = re.compile(r"(?:^|[._/])(?:\w*_)?frame(?:_?id|_?name)?$|[a-z]Frame(?:Id|ID|Name)?$")
"""The last part of the name of a parameter that has a frame for its value, whatever node has it."""
_ASKED = re.compile(r"transform (\S+) <- (\S+?)(?: again and again)?, and was given")
_SENSORS = frozenset(
    f"sensor_msgs/{name}"
    for name in (
        *("CameraInfo", "CompressedImage", "Image", "Imu", "LaserScan", "MagneticField", "MultiEchoLaserScan"),
        *("NavSatFix", "PointCloud", "PointCloud2", "Range"),
    )
)
"""Messages of sensors whose place counts."""
_NO_FRAME = frozenset(("sensor_msgs/Joy",))
"""Messages whose header has no frame: drivers write the path of their device into it."""
OF_SENSOR = ("frame_id", "camera_frame_id", "imu_frame", "laser_frame_id", "lidar_frame", "sensor_frame")
"""The parameters by which drivers have the frame of their messages."""
OF_LOCALIZATION = frozenset(("map", "odom", "world", "earth", "utm"))
"""Frames of REP 105, which localization publishes: it is mostly started by itself."""
_FIXED_FRAME = re.compile(r"^ +Fixed Frame: *[\"']?([^\"'\s#]+)", re.MULTILINE)


def uses_of_node(
    node: LaunchNode,
    interface: Interface | None,
    known: Known | None,
    given: Sequence[Param],
    generation: int,
    every: KnownMeanings,
) -> tuple[Use, ...]:
    """What a node names as far as it is known what it does with that."""
    space = space_of(node, generation)
    found = [] if known is None else list(_of_knowledge(node, known, given, space, every))
    for answer in interface.outcome.answers if interface is not None else ():
        if (asked := _ASKED.search(answer)) is not None:
            what = f"transform {asked[1]} <- {asked[2]}"
            found += (Use(plain(frame), frame, node, what, None, space) for frame in asked.groups() if is_frame(frame))
    for use in interface.frame_uses if interface is not None else ():
        if is_frame(use.frame) and use.call not in _NO_FRAME:
            found.append(_of_source(use, node, given, space))
    return tuple(found)


def _of_source(use: FrameUse, node: LaunchNode, given: Sequence[Param], space: str) -> Use:
    """A frame that the source names; where a parameter of the node has it for its value, that is where it is set."""
    what = f"{use.call} in {os.path.basename(use.source_file)}:{use.source_line}"
    params = (param for name, param in own_params(node, given) if param.value == use.frame)
    param = next(params, None)
    return Use(
        plain(use.frame),
        use.frame,
        node,
        what,
        param,
        space,
        use.looked_up,
        not use.evidence.conditional,
        use.call,
        of_sensor=use.call in _SENSORS,
    )


def uses_of_sensors(robot: Robot, node: LaunchNode, space: str) -> Iterator[Use]:
    """The frames that the simulated sensors of a description have; the node is the one that publishes its frames."""
    for each in robot.description.sensor_frames:
        if is_frame(each.frame):
            what = f"<{each.tag}> of '{each.sensor}'"
            yield Use(
                plain(each.frame),
                each.frame,
                node,
                what,
                robot.param,
                space,
                False,
                False,
                of_sensor=True,
                robot=robot,
                tag=each.tag,
            )


def _of_knowledge(
    node: LaunchNode, known: Known, given: Sequence[Param], space: str, every: KnownMeanings
) -> Iterator[Use]:
    for each in meant_of_node(node, known, given, every):
        meaning, value = each.meaning, each.value
        if meaning.kind != "frame" or meaning.role not in ("used", "named") or not is_frame(value):
            continue
        what = f"parameter '{each.parameter}'" + ("" if each.param is not None else " by default")
        used = meaning.role == "used"
        of_sensor = not used and each.parameter in OF_SENSOR and plain(value) not in OF_LOCALIZATION
        yield Use(plain(value), value, node, what, each.param, space, used, known.is_used, of_sensor=of_sensor)


def mentions_of_node(
    node: LaunchNode, known: Known | None, given: Sequence[Param], generation: int
) -> tuple[Mention, ...]:
    """The frames in the parameters of a node of which is not known what it does with them."""
    if known is not None or not given:
        return ()
    space = space_of(node, generation)
    return tuple(
        Mention(plain(param.value), node, name, param, space)
        for name, param in own_params(node, given)
        if _NAMES_A_FRAME.search(name) and is_frame(param.value)
    )


def is_frame(value: object) -> bool:
    """Whether a value can be the name of a frame."""
    return isinstance(value, str) and _LEGAL.match(value) is not None


def fixed_frame(node: LaunchNode, disk: Disk, generation: int) -> Use | None:
    """The fixed frame of the configuration that RViz is started with."""
    path = rviz_config_of(node)
    if path is None:
        return None
    frame = _fixed_frame(disk.db, path)
    if frame is None or not is_frame(frame):
        return None
    return Use(plain(frame), frame, node, f"Fixed Frame of {os.path.basename(path)}", None, space_of(node, generation))


@query
def _fixed_frame(db: Database, path: str) -> str | None:
    text = text_of(db, path)
    found = _FIXED_FRAME.search(text.text) if isinstance(text, Text) else None
    return found[1] if found is not None else None
