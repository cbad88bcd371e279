"""BRG003: what a bridge is given and refuses: an argument, or an entry of its file.

https://github.com/gazebosim/ros_gz/blob/ros2/ros_gz_bridge/src/bridge_config.cpp (`parseEntry`), parameter_bridge.cpp
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.ros2.bridges import arguments_of
from preflight_analysis.evaluation.ros2.unknown_text import is_unknown
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.gazebo_bridges import Entry, entries, not_listed
from preflight_analysis.model.nearest import did_you_mean, is_slip, nearest
from preflight_analysis.model.places import argument_location
from preflight_analysis.model.problems import include_chain, quoted, rename
from preflight_analysis.rules.further_reading import ROS_GZ_BRIDGE
from preflight_analysis.rules.rule import Rule

_DIRECTIONS = ("BIDIRECTIONAL", "GZ_TO_ROS", "ROS_TO_GZ")
_TYPES = ("ros_type_name", "gz_type_name")
_OF_ONE_SIDE = ("ros_topic_name", "gz_topic_name")
_KEYS = (
    *_TYPES,
    *_OF_ONE_SIDE,
    *("topic_name", "direction", "publisher_queue", "subscriber_queue", "lazy", "qos_profile", "frame_id"),
)
_OLD = "ign_"
"""How older versions begin the keys of Gazebo."""
_WITHOUT_OLD = frozenset({"jazzy", "kilted", "lyrical", "rolling"})


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    yield from _of_arguments(rule, context)
    for node, place in not_listed(context):
        yield rule.claim(
            "the file of the bridge must be a list: no topic passes",
            place,
            subject=Subject("file", place.file),
            related=include_chain(node.origin),
        )
    for entry in entries(context):
        old = any(key.startswith(_OLD) for key in entry.keys)
        if "service_name" in entry.keys or (old and context.environment.distro not in _WITHOUT_OLD):
            continue
        for each in _refused(entry):
            yield rule.claim(
                each.said,
                each.place,
                subject=Subject("bridge", each.written),
                kind="near" if each.meant is not None else None,
                effect="stops-node" if each.ends else None,
                candidates=(each.meant,),
                related=include_chain(entry.node.origin),
                fixes=rename(context, each.place, each.written, each.meant) if each.meant is not None else (),
            )


def _of_arguments(rule: Rule, context: Context) -> Iterator[Finding]:
    for node in context.tree.nodes:
        for given in arguments_of(node):
            wrong = given.refused
            if not wrong and not given.is_service and not names.is_legal_in_ros2(given.topic):
                wrong = "has a topic name that ROS refuses"
            if not wrong:
                continue
            ends = given.ends or not given.refused
            # A name with nothing between two slashes has an argument in it that an includer gives.
            by_others = not given.refused and "//" in given.topic
            yield rule.claim(
                f"bridge argument '{given.word}' {wrong}: " + ("parameter_bridge exits" if ends else "nothing passes"),
                argument_location(context, node, given.word),
                subject=Subject("argument", given.word),
                effect="stops-node" if ends else "no-effect",
                doubts=doubts(NOT_SET=by_others),
                related=include_chain(node.origin),
            )


class _Refused(NamedTuple):
    """What is said, its place, and what is written there with what was meant, None where that is not known. `ends`:
    the bridge does, with all its topics."""

    said: str
    place: Location
    written: str = ""
    meant: str | None = None
    ends: bool = False


def _refused(entry: Entry) -> Iterator[_Refused]:
    if not entry.is_map:
        yield _Refused("an entry of a bridge must have keys: the bridge leaves this one out", entry.place)
        return
    direction, place = entry.values.get("direction", (_DIRECTIONS[0], entry.place))
    if direction not in _DIRECTIONS:
        near = nearest(direction, _DIRECTIONS)
        yield _Refused(f"'{direction}' is not a direction: {quoted(_DIRECTIONS)} are", place, direction, near)
    for key in _TYPES:
        if key not in entry.keys or not entry.values.get(key, ("unknown", entry.place))[0]:
            near = _meant_for(key, entry)
            place = entry.keys[near] if near is not None else entry.place
            said = f"'{key}' is missing: the bridge leaves this entry out"
            yield _Refused(said, place, near or "", near and key)
    if "topic_name" in entry.values:
        for key in _OF_ONE_SIDE:
            if entry.values.get(key, ("", None))[0]:
                yield _Refused(f"'{key}' excludes 'topic_name', which this entry also has", entry.values[key][1])
    topic = entry.ros_topic
    if topic is None and not any(key in entry.keys for key in ("topic_name", *_OF_ONE_SIDE)):
        yield _Refused("the entry names no topic: the bridge ends", entry.place, ends=True)
    elif topic is not None and not is_unknown(topic[0]) and not names.is_legal_in_ros2(topic[0]):
        yield _Refused(f"'{topic[0]}' is a topic name that ROS refuses: the bridge ends", topic[1], ends=True)
    for key, place in entry.keys.items():
        near = nearest(key, _KEYS)
        if key not in _KEYS and near is not None and near not in (*entry.keys, *_TYPES) and is_slip(key, near):
            yield _Refused(f"'{key}' is not a key of a bridge" + did_you_mean(near), place, key, near)


def _meant_for(key: str, entry: Entry) -> str | None:
    """A key of the entry that was meant to be the one that is missing."""
    side, _, rest = key.partition("_")
    meant = {f"{side}_{rest.removesuffix('_name')}", f"{side}_message_type", f"{side}_msg_type"}
    if side == "gz":
        meant |= {f"{_OLD}{rest}", f"{_OLD}{rest.removesuffix('_name')}"}
    return next((each for each in entry.keys if each not in _KEYS and (each in meant or is_slip(each, key))), None)


RULE = Rule(
    id="BRG003",
    name="malformed-bridge",
    effect="breaks",
    kind="invalid",
    always=(Reason.FROM_SOURCE,),
    sometimes=("stops-node", "no-effect", Reason.NOT_SET),
    what="Checks for what `ros_gz_bridge` refuses: arguments of `parameter_bridge` that are not "
    "`TOPIC@ROS_TYPE@GZ_TYPE`, and entries of its file. An entry needs both types, a `direction` that exists, and "
    "`topic_name` or the names of the two sides.",
    why="parameter_bridge prints its usage and exits, with all its topics. Of a file it reports "
    "`Could not parse entry`, and the topic does not pass.",
    example="- topic_name: /cmd_vel\n  ros_type_name: geometry_msgs/msg/Twist\n  gz_type_name: gz.msgs.Twist\n"
    "  direction: ROS_TO_GAZEBO",
    instead="- topic_name: /cmd_vel\n  ros_type_name: geometry_msgs/msg/Twist\n  gz_type_name: gz.msgs.Twist\n"
    "  direction: ROS_TO_GZ",
    references=(ROS_GZ_BRIDGE,),
    generations=(2,),
    check=_check,
)
