"""Topics that bridges between ROS and Gazebo carry: the command line or a file says which, in which direction.

https://docs.ros.org/en/jazzy/p/ros_gz_bridge/: `/topic@ros_type@gz_type` goes both ways, `[` in the place of the second
`@` to ROS, `]` to Gazebo. A file is a list of bridges; a bridge with one name has it on both sides.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.ros2.bridges import Argument, arguments_of, is_bridge
from preflight_analysis.evaluation.ros2.types import loaded
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.tracing.interface import Endpoint, Role

_TYPE = re.compile(r"\w+/(?:msg/)?\w+\Z")
_ROLES: dict[str, tuple[Role, ...]] = {
    "@": ("publisher", "subscriber"),
    "[": ("publisher",),
    "]": ("subscriber",),
    "BIDIRECTIONAL": ("publisher", "subscriber"),
    "GZ_TO_ROS": ("publisher",),
    "ROS_TO_GZ": ("subscriber",),
}
_NAMES = ("ros_topic_name", "topic_name", "gz_topic_name", "ign_topic_name")


def bridged(node: LaunchNode, config: Document | None, kinds_in_types: bool) -> Iterator[Endpoint]:
    """The ends of the bridge on the side of ROS; none of other nodes. `config` is its file. `kinds_in_types`: whether
    that ROS writes `package/msg/Name` for `package/Name`."""
    if not is_bridge(node):
        return
    rows = [(each.topic, each.ros, each.direction) for each in arguments_of(node) if _is_topic(each)]
    for name, type_, direction in (*rows, *_configured(config)):
        package, _, rest = type_.partition("/")
        kind = "msg/" if kinds_in_types else ""
        for role in _ROLES.get(direction, ()) if names.is_legal(name) else ():
            yield Endpoint(role, name, f"{package}/{kind}{rest.removeprefix('msg/')}")


def _is_topic(given: Argument) -> bool:
    return not given.refused and _TYPE.match(given.ros) is not None


def _configured(config: Document | None) -> Iterator[tuple[str, str, str]]:
    """Name, type and direction of each bridge of a file."""
    found = config.once(_data) if config is not None else None
    for row in found if isinstance(found, list) else ():
        if not isinstance(row, dict):
            continue
        name = next((row[key] for key in _NAMES if isinstance(row.get(key), str)), None)
        type_, direction = row.get("ros_type_name"), row.get("direction", "BIDIRECTIONAL")
        if name is not None and isinstance(type_, str) and _TYPE.match(type_) and isinstance(direction, str):
            yield name, type_, direction


def _data(document: Document) -> Any:
    try:
        return loaded(document.text)
    except CONSTRUCTION_ERRORS:
        return None
