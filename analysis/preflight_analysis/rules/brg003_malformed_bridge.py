"""BRG003: what a bridge is given and refuses: an argument, or an entry of its file.

https://github.com/gazebosim/ros_gz/blob/ros2/ros_gz_bridge/src/bridge_config.cpp (`parseEntry`), parameter_bridge.cpp
"""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.ros2.bridges import arguments_of
from preflight_analysis.evaluation.ros2.unknown_text import is_unknown
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.further_reading import ROS_GZ_BRIDGE
from preflight_analysis.rules.gazebo_bridges import Entry, entries, not_listed
from preflight_analysis.rules.nearest import did_you_mean, is_slip, nearest
from preflight_analysis.rules.places import argument_location
from preflight_analysis.rules.problems import include_chain, quoted, rename
from preflight_analysis.rules.rule import Context, Rule

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
        yield rule.finding(
            "the file of the bridge must be a list: no topic passes",
            place,
            confidence="likely",
            related=include_chain(node.origin),
        )
    for entry in context.once(entries):
        old = any(key.startswith(_OLD) for key in entry.keys)
        if "service_name" in entry.keys or (old and context.environment.distro not in _WITHOUT_OLD):
            continue
        for message, place, written, meant in _refused(entry):
            yield rule.finding(
                message,
                place,
                confidence="likely",
                related=include_chain(entry.node.origin),
                fixes=rename(context, place, written, meant) if meant is not None else (),
            )


def _of_arguments(rule: Rule, context: Context) -> Iterator[Finding]:
    for node in context.tree.nodes:
        for given in arguments_of(node):
            wrong = given.refused
            if not wrong and not given.is_service and not names.is_legal(given.topic):
                wrong = "has a topic name that ROS refuses"
            if not wrong:
                continue
            ends = given.ends or not given.refused
            # A name with nothing between two slashes has an argument in it that an includer gives.
            by_others = not given.refused and "//" in given.topic
            yield rule.finding(
                f"bridge argument '{given.word}' {wrong}: " + ("parameter_bridge exits" if ends else "nothing passes"),
                argument_location(context, node, given.word),
                severity="info" if by_others else None if ends else "warning",
                confidence="possible" if by_others else "likely",
                related=include_chain(node.origin),
            )


def _refused(entry: Entry) -> Iterator[tuple[str, Location, str, str | None]]:
    """The message, its place, and what is written there with what was meant, None where that is not known."""
    if not entry.is_map:
        yield "an entry of a bridge must have keys: the bridge leaves this one out", entry.place, "", None
        return
    direction, place = entry.values.get("direction", (_DIRECTIONS[0], entry.place))
    if direction not in _DIRECTIONS:
        near = nearest(direction, _DIRECTIONS)
        yield f"'{direction}' is not a direction: {quoted(_DIRECTIONS)} are", place, direction, near
    for key in _TYPES:
        if key not in entry.keys or not entry.values.get(key, ("unknown", entry.place))[0]:
            near = _meant_for(key, entry)
            place = entry.keys[near] if near is not None else entry.place
            yield f"'{key}' is missing: the bridge leaves this entry out", place, near or "", near and key
    if "topic_name" in entry.values:
        for key in _OF_ONE_SIDE:
            if entry.values.get(key, ("", None))[0]:
                yield f"'{key}' excludes 'topic_name', which this entry also has", entry.values[key][1], "", None
    topic = entry.ros_topic
    if topic is None and not any(key in entry.keys for key in ("topic_name", *_OF_ONE_SIDE)):
        yield "the entry names no topic: the bridge ends", entry.place, "", None
    elif topic is not None and not is_unknown(topic[0]) and not names.is_legal(topic[0]):
        yield f"'{topic[0]}' is a topic name that ROS refuses: the bridge ends", topic[1], "", None
    for key, place in entry.keys.items():
        near = nearest(key, _KEYS)
        if key not in _KEYS and near is not None and near not in (*entry.keys, *_TYPES) and is_slip(key, near):
            yield f"'{key}' is not a key of a bridge" + did_you_mean(near), place, key, near


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
    severity="error",
    what="Checks for what `ros_gz_bridge` refuses. An argument of `parameter_bridge` is `TOPIC@ROS_TYPE@GZ_TYPE`, with "
    "`[` or `]` in place of the second `@` for one direction. An entry of its file has both types, a `direction` "
    "that exists, and one name: `topic_name`, or those of the two sides. The old `ign_` keys are refused from Jazzy "
    "on. Entries of services are not checked. An argument with `//` in its name is information, as an includer may "
    "give the name between.",
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
