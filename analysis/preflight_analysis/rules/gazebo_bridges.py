"""What the bridges between ROS and Gazebo of a launch are given: arguments, and entries of their files."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

import yaml

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location
from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS, compose_fast, span_of
from preflight_analysis.environment.installed_paths import located
from preflight_analysis.evaluation.ros2.bridges import config_file_of, is_bridge
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.rules.places import argument_location
from preflight_analysis.rules.rule import Context
from preflight_analysis.tracing.request import split_args

_ARGUMENT = re.compile(r"[^@\s]+@(\w+/(?:msg/)?\w+)[@\[\]]([\w.]+)\Z")


@dataclass(frozen=True, slots=True)
class TypePair:
    """The types of one bridged topic, and where the one of Gazebo is written."""

    node: LaunchNode
    ros: str
    gazebo: str
    place: Location


@dataclass(frozen=True, slots=True)
class Entry:
    """One entry of a bridge's file: its scalars by their keys, and their places."""

    node: LaunchNode
    values: Mapping[str, tuple[str, Location]]
    place: Location


def type_pairs(context: Context) -> Iterator[TypePair]:
    """Those of all bridges, arguments first."""
    for node in context.tree.nodes:
        for word in split_args(node.args) if is_bridge(node) else ():
            if (found := _ARGUMENT.match(word)) is not None:
                yield TypePair(node, found[1], found[2], argument_location(context, node, word))
    for entry in context.once(entries):
        ros, gazebo = entry.values.get("ros_type_name"), entry.values.get("gz_type_name")
        if ros is not None and gazebo is not None:
            yield TypePair(entry.node, ros[0], gazebo[0], gazebo[1])


def entries(context: Context) -> tuple[Entry, ...]:
    """The entries of the files of all bridges, those of one file once. Ask through `context.once`."""
    files = {path: node for node in context.tree.nodes if is_bridge(node) and (path := config_file_of(node))}
    found = []
    for given, node in files.items():
        path = located(context.disk, context.environment, given)
        document = context.documents.get(path)
        for row in document.once(_rows) if document is not None else ():
            values = {
                key.value: (value.value, context.location(path, span_of(value)))
                for key, value in row.value
                if isinstance(key, yaml.ScalarNode) and isinstance(value, yaml.ScalarNode)
            }
            first = row.value[0][0] if row.value else row
            found.append(Entry(node, values, context.location(path, span_of(first))))
    return tuple(found)


def _rows(document: Document) -> tuple[yaml.MappingNode, ...]:
    try:
        root = compose_fast(document.text)
    except CONSTRUCTION_ERRORS:
        return ()
    rows = root.value if isinstance(root, yaml.SequenceNode) else ()
    return tuple(row for row in rows if isinstance(row, yaml.MappingNode))
