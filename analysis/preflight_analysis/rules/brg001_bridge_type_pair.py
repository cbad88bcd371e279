"""BRG001: types of ROS and Gazebo that the bridge does not convert into each other.

https://github.com/gazebosim/ros_gz/blob/ros2/ros_gz_bridge/ros_gz_bridge/mappings.py
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.knowledge.conversions import gazebo_types
from preflight_analysis.model.context import Context
from preflight_analysis.model.gazebo_bridges import type_pairs
from preflight_analysis.model.gazebo_side import gazebo_of, to_gazebo
from preflight_analysis.model.nearest import is_slip, nearest
from preflight_analysis.model.problems import include_chain, quoted, rename
from preflight_analysis.rules.further_reading import ROS_GZ_BRIDGE
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    yield from _of_gazebo(rule, context)
    pairs = gazebo_types()
    every = {name for names in pairs.values() for name in names}
    for pair in type_pairs(context):
        prefix, _, name = pair.gazebo.rpartition(".")
        convertible = pairs.get(pair.ros.replace("/msg/", "/"), ())
        if name in convertible and "/msg/" in pair.ros:
            continue
        meant = _meant(pair.ros, pairs)
        if meant is not None:
            yield rule.claim(
                f"the bridge does not know '{pair.ros}'; did you mean '{meant}'?",
                pair.ros_place,
                subject=Subject("type", pair.ros),
                kind="near",
                candidates=(meant,),
                related=include_chain(pair.node.origin),
                fixes=rename(context, pair.ros_place, pair.ros, meant),
            )
            continue
        # A package of one's own may convert further types, hardly other pairs of the known ones.
        near = nearest(name, convertible) or (convertible[0] if len(convertible) == 1 else None)
        known = bool(convertible) and (name in every or nearest(name, convertible) is not None)
        instead = quoted(f"{prefix}.{each}" for each in convertible)
        yield rule.claim(
            f"the bridge cannot convert '{pair.ros}' and '{pair.gazebo}'"
            + (f"; it converts '{pair.ros}' and {instead}" if instead else f"; it does not know '{pair.ros}'"),
            pair.place,
            subject=Subject("type", pair.gazebo),
            doubts=doubts(OTHER_VERSION=not known),
            candidates=(f"{prefix}.{near}",) if known and near is not None else (),
            related=include_chain(pair.node.origin),
            fixes=rename(context, pair.place, pair.gazebo, f"{prefix}.{near}") if known and near is not None else (),
        )


def _of_gazebo(rule: Rule, context: Context) -> Iterator[Finding]:
    """The types that the bridge has right, and Gazebo has another one for the topic."""
    gazebo = gazebo_of(context)
    if gazebo is None:
        return
    pairs = gazebo_types()
    for bridge in to_gazebo(context):
        prefix, _, name = bridge.gazebo.rpartition(".")
        makers = gazebo.named(bridge.gazebo_topic, bridge.direction)
        convertible = pairs.get(bridge.ros.replace("/msg/", "/"), ())
        types = dict.fromkeys(each.type for each in makers)
        if not makers or name not in convertible or name in types or "*" in types:
            continue
        meant = next(iter(types))
        # Where Gazebo has several topics on one name, a plugin that is not known may have one more.
        sure = len(types) == 1 and makers[0].is_certain
        yield rule.claim(
            f"the bridge expects '{bridge.gazebo}' on '{bridge.gazebo_topic}', but {makers[0].maker} has "
            f"'{prefix}.{meant}'",
            bridge.gazebo_place,
            subject=Subject("type", bridge.gazebo),
            doubts=doubts(PARTLY_READ=not sure),
            candidates=(f"{prefix}.{meant}",),
            related=(*gazebo.related, *include_chain(bridge.node.origin)),
        )


def _meant(ros: str, known: Mapping[str, object]) -> str | None:
    """The type that the bridge knows of which this one is a slip, or that it is without `msg/`."""
    package, _, name = ros.replace("/msg/", "/").partition("/")
    if "/msg/" not in ros and f"{package}/{name}" in known:
        return f"{package}/msg/{name}"
    near = [each for each in known if each.startswith(f"{package}/") and is_slip(name, each.partition("/")[2])]
    return near[0].replace("/", "/msg/") if f"{package}/{name}" not in known and len(near) == 1 else None


RULE = Rule(
    id="BRG001",
    name="bridge-type-pair",
    effect="breaks",
    kind="conflict",
    always=(Reason.LIBRARY,),
    sometimes=(Reason.OTHER_VERSION, Reason.PARTLY_READ),
    what="Checks for a ROS type and a Gazebo type that `ros_gz_bridge` of Humble to Kilted does not convert into each "
    "other. It also checks for a type that differs from that of the sensor or plugin in Gazebo.",
    why="The bridge does not create this topic: `Failed to create a bridge`. The others work, and nothing arrives on "
    "this one.",
    example="arguments=['/scan@sensor_msgs/msg/LaserScan[gz.msgs.PointCloudPacked']",
    instead="arguments=['/scan@sensor_msgs/msg/LaserScan[gz.msgs.LaserScan']",
    references=(ROS_GZ_BRIDGE,),
    generations=(2,),
    check=_check,
)
