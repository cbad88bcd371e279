"""Topics that bridges between ROS and Gazebo carry: the command line or a file says which, in which direction.

https://docs.ros.org/en/jazzy/p/ros_gz_bridge/: `/topic@ros_type@gz_type` goes both ways, `[` in the place of the second
`@` to ROS, `]` to Gazebo. A file is a list of bridges; a bridge with one name has it on both sides.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from preflight_analysis.documents.document import Document
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.ros2.bridges import Argument, arguments_of, is_bridge, rows_of
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.tracing.interface import Endpoint, Evidence, NamedBy, Role

_EVIDENCE = Evidence("configuration")
_TYPE = re.compile(r"\w+/(?:msg/)?\w+\Z")
_ROLES: dict[str, tuple[Role, ...]] = {
    "@": ("publisher", "subscriber"),
    "[": ("publisher",),
    "]": ("subscriber",),
    "BIDIRECTIONAL": ("publisher", "subscriber"),
    "GZ_TO_ROS": ("publisher",),
    "ROS_TO_GZ": ("subscriber",),
}


def bridged(node: LaunchNode, config: Document | None, kinds_in_types: bool) -> Iterator[Endpoint]:
    """The ends of the bridge on the side of ROS; none of other nodes. `config` is its file. `kinds_in_types`: whether
    that ROS writes `package/msg/Name` for `package/Name`."""
    if not is_bridge(node):
        return
    rows = [(each.topic, each.ros, each.direction, None) for each in arguments_of(node) if _is_topic(each)]
    for name, type_, direction, named_by in (*rows, *_configured(config)):
        package, _, rest = type_.partition("/")
        kind = "msg/" if kinds_in_types else ""
        for role in _ROLES.get(direction, ()) if names.is_legal_in_ros2(name) else ():
            full = f"{package}/{kind}{rest.removeprefix('msg/')}"
            yield Endpoint(role, name, full, evidence=_EVIDENCE, named_by=named_by)


def _is_topic(given: Argument) -> bool:
    return not given.refused and _TYPE.match(given.ros) is not None


def _configured(config: Document | None) -> Iterator[tuple[str, str, str, NamedBy]]:
    """Name, type and direction of each bridge of a file, and where its name is written."""
    for row in rows_of(config) if config is not None else ():
        key, (type_, _) = row.ros_topic, row.values.get("ros_type_name", ("", None))
        direction, _ = row.values.get("direction", ("BIDIRECTIONAL", None))
        if config is not None and key is not None and _TYPE.match(type_):
            yield row.values[key][0], type_, direction, NamedBy(key, config.location(row.keys[key]))
