"""What the bridges between ROS and Gazebo of a launch are given: arguments, and entries of their files."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import yaml

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.documents.yaml import span_of
from preflight_analysis.environment.installed_paths import located
from preflight_analysis.evaluation.ros2.bridges import arguments_of, config_file_of, is_bridge, root_of, rows_of
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context
from preflight_analysis.model.places import argument_location


@dataclass(frozen=True, slots=True)
class TypePair:
    """The types of one bridged topic, and where the one of Gazebo and that of ROS are written."""

    node: LaunchNode
    ros: str
    gazebo: str
    place: Location
    ros_place: Location


@dataclass(frozen=True, slots=True)
class Entry:
    """One entry of a bridge's file: its scalars by their keys, their places, and the places of all keys. `is_map`:
    whether it has keys at all."""

    node: LaunchNode
    values: Mapping[str, tuple[str, Location]]
    keys: Mapping[str, Location]
    place: Location
    is_map: bool
    ros_topic: tuple[str, Location] | None
    """The name on the side of ROS, as the bridge takes it."""


@dataclass(frozen=True, slots=True)
class Bridge:
    """One bridged topic, with its name and type in ROS and in Gazebo. `direction` is `GZ_TO_ROS`, `ROS_TO_GZ` or
    `BIDIRECTIONAL`; `place` is where that is written, `turned` what is written there and what the other direction would
    be. `written` is where the bridge is: its argument, or the keys and values of its entry. `gazebo_place` is where
    the name in Gazebo is written, `has_own_name` whether that is not the name in ROS, too."""

    node: LaunchNode
    topic: str
    ros: str
    gazebo_topic: str
    gazebo: str
    direction: str
    place: Location
    turned: tuple[str, str]
    written: tuple[Location, ...]
    gazebo_place: Location
    has_own_name: bool = False


_GAZEBO_NAMES = ("gz_topic_name", "ign_topic_name")
_GAZEBO_TYPES = ("gz_type_name", "ign_type_name")
_DIRECTIONS = {"@": "BIDIRECTIONAL", "[": "GZ_TO_ROS", "]": "ROS_TO_GZ"}
_OTHER = {"[": "]", "]": "[", "GZ_TO_ROS": "ROS_TO_GZ", "ROS_TO_GZ": "GZ_TO_ROS"}


def bridges(context: Context) -> Iterator[Bridge]:
    """The topics of all bridges, those of arguments first."""
    for node in context.tree.nodes:
        for given in arguments_of(node):
            if not given.refused and not given.is_service:
                sign = given.direction
                other = given.word.replace(f"{given.ros}{sign}", f"{given.ros}{_OTHER.get(sign, sign)}")
                place = argument_location(context, node, given.word)
                turned, names = (given.word, other), (given.topic, given.ros, given.topic, given.gazebo)
                yield Bridge(
                    node, *names, _DIRECTIONS[sign], place, turned, (_within(context, place, given.word),), place
                )
    for entry in entries(context):
        topic, ros = entry.ros_topic, entry.values.get("ros_type_name")
        direction, place = entry.values.get("direction", ("BIDIRECTIONAL", entry.place))
        if topic is not None and ros is not None:
            in_gazebo = next((entry.values[key] for key in _GAZEBO_NAMES if key in entry.values), topic)
            gazebo = next((entry.values[key][0] for key in _GAZEBO_TYPES if key in entry.values), "")
            turned = (direction, _OTHER.get(direction, direction))
            written = (*entry.keys.values(), *(at for _, at in entry.values.values()))
            names, has_own = (topic[0], ros[0], in_gazebo[0], gazebo), in_gazebo[1] is not topic[1]
            yield Bridge(entry.node, *names, direction, place, turned, written, in_gazebo[1], has_own)


def _within(context: Context, place: Location, word: str) -> Location:
    """Where a word stands in the text of a place; the place where it is not written there as such."""
    at = context.text(place).find(word)
    start = place.span.start + at
    return context.location(place.file, Span(start, start + len(word))) if at >= 0 else place


def type_pairs(context: Context) -> Iterator[TypePair]:
    """Those of all bridges, arguments first."""
    for node in context.tree.nodes:
        for given in arguments_of(node):
            if not given.refused and not given.is_service:
                place = argument_location(context, node, given.word)
                yield TypePair(node, given.ros, given.gazebo, place, place)
    for entry in entries(context):
        ros, gazebo = entry.values.get("ros_type_name"), entry.values.get("gz_type_name")
        if ros is not None and gazebo is not None:
            yield TypePair(entry.node, ros[0], gazebo[0], gazebo[1], ros[1])


@derived
def entries(context: Context) -> tuple[Entry, ...]:
    """The entries of the files of all bridges, those of one file once."""
    found = []
    for path, node, document in _files(context):
        for row in rows_of(document):
            values = {key: (value, context.location(path, span)) for key, (value, span) in row.values.items()}
            keys = {key: context.location(path, span) for key, span in row.keys.items()}
            topic = values[row.ros_topic] if row.ros_topic is not None else None
            found.append(Entry(node, values, keys, context.location(path, row.span), row.is_map, topic))
    return tuple(found)


def not_listed(context: Context) -> Iterator[tuple[LaunchNode, Location]]:
    """The bridges whose file has something else than a list, and where."""
    for path, node, document in _files(context):
        root = root_of(document)
        if root is not None and not isinstance(root, yaml.SequenceNode):
            first = root.value[0][0] if isinstance(root, yaml.MappingNode) and root.value else root
            yield node, context.location(path, span_of(first))


def is_unread(context: Context, bridge: LaunchNode) -> bool:
    """Whether a bridge is given a file that is not known."""
    given = config_file_of(bridge)
    return given is not None and located(context.disk, context.environment, given) not in context.documents


def _files(context: Context) -> Iterator[tuple[str, LaunchNode, Document]]:
    files = {path: node for node in context.tree.nodes if is_bridge(node) and (path := config_file_of(node))}
    for given, node in files.items():
        path = located(context.disk, context.environment, given)
        document = context.documents.get(path)
        if document is not None:
            yield path, node, document
