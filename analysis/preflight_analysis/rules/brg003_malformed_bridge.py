"""BRG003: an entry in the file of a bridge that the bridge refuses.

https://github.com/gazebosim/ros_gz/blob/ros2/ros_gz_bridge/src/bridge_config.cpp (`parseEntry`)
"""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.documents.span import Location
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.further_reading import ROS_GZ_BRIDGE
from preflight_analysis.rules.gazebo_bridges import Entry, entries
from preflight_analysis.rules.nearest import nearest
from preflight_analysis.rules.problems import include_chain, quoted, rename
from preflight_analysis.rules.rule import Context, Rule

_DIRECTIONS = ("BIDIRECTIONAL", "GZ_TO_ROS", "ROS_TO_GZ")
_TYPES = ("ros_type_name", "gz_type_name")
_OF_ONE_SIDE = ("ros_topic_name", "gz_topic_name")
_OLD = "ign_"
"""How older versions begin the keys of Gazebo."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for entry in context.once(entries):
        if "service_name" in entry.values or any(key.startswith(_OLD) for key in entry.values):
            continue
        for message, place, near in _refused(entry):
            yield rule.finding(
                message,
                place,
                confidence="likely",
                related=include_chain(entry.node.origin),
                fixes=rename(context, place, entry.values["direction"][0], near) if near is not None else (),
            )


def _refused(entry: Entry) -> Iterator[tuple[str, Location, str | None]]:
    direction, place = entry.values.get("direction", (_DIRECTIONS[0], entry.place))
    if direction not in _DIRECTIONS:
        yield f"'{direction}' is not a direction: {quoted(_DIRECTIONS)} are", place, nearest(direction, _DIRECTIONS)
    for key in _TYPES:
        if not entry.values.get(key, ("", entry.place))[0]:
            yield f"'{key}' is missing: the bridge leaves this entry out", entry.place, None
    if "topic_name" in entry.values:
        for key in _OF_ONE_SIDE:
            if key in entry.values:
                yield f"'{key}' excludes 'topic_name', which this entry also has", entry.values[key][1], None


RULE = Rule(
    id="BRG003",
    name="malformed-bridge",
    severity="error",
    what="Checks for an entry in the configuration file of `ros_gz_bridge` that the bridge refuses: a `direction` that "
    "does not exist, a missing type, or `topic_name` next to `ros_topic_name` or `gz_topic_name`. Entries of services "
    "and entries with the old `ign_` keys are not checked.",
    why="The bridge reports `Could not parse entry` and the topic does not pass.",
    example="- topic_name: /cmd_vel\n  ros_type_name: geometry_msgs/msg/Twist\n  gz_type_name: gz.msgs.Twist\n"
    "  direction: ROS_TO_GAZEBO",
    instead="- topic_name: /cmd_vel\n  ros_type_name: geometry_msgs/msg/Twist\n  gz_type_name: gz.msgs.Twist\n"
    "  direction: ROS_TO_GZ",
    references=(ROS_GZ_BRIDGE,),
    generations=(2,),
    check=_check,
)
