"""Topics that the displays of RViz subscribe to, as its configuration says.

Classes and types: plugins_description.xml of rviz_default_plugins (ros2/rviz, f7112b1ae4337363c4d8177bffe7cce6bbcabf29)
and plugin_description.xml of rviz (ros-visualization/rviz, 041273a83316631d7076b483cdcc22053b3f6643). Policies:
qos_profile_property.cpp of rviz_common.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import yaml

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS, compose_fast
from preflight_analysis.evaluation import names
from preflight_analysis.incremental.derived import derived
from preflight_analysis.tracing.interface import Endpoint, Evidence, NamedBy

_EVIDENCE = Evidence("configuration")
_LIBRARIES = ("rviz_default_plugins", "rviz")
_GROUPS = ("rviz_common/Group", "rviz/Group")
_TYPES = {
    "AccelStamped": "geometry_msgs/AccelStamped",
    "Camera": "sensor_msgs/Image",
    "CameraInfo": "sensor_msgs/CameraInfo",
    "DepthCloud": "sensor_msgs/Image",
    "Effort": "sensor_msgs/JointState",
    "FluidPressure": "sensor_msgs/FluidPressure",
    "GridCells": "nav_msgs/GridCells",
    "Illuminance": "sensor_msgs/Illuminance",
    "Image": "sensor_msgs/Image",
    "LaserScan": "sensor_msgs/LaserScan",
    "Map": "nav_msgs/OccupancyGrid",
    "Marker": "visualization_msgs/Marker",
    "MarkerArray": "visualization_msgs/MarkerArray",
    "Odometry": "nav_msgs/Odometry",
    "Path": "nav_msgs/Path",
    "PointCloud": "sensor_msgs/PointCloud",
    "PointCloud2": "sensor_msgs/PointCloud2",
    "PointStamped": "geometry_msgs/PointStamped",
    "Polygon": "geometry_msgs/PolygonStamped",
    "Pose": "geometry_msgs/PoseStamped",
    "PoseArray": "geometry_msgs/PoseArray",
    "PoseWithCovariance": "geometry_msgs/PoseWithCovarianceStamped",
    "Range": "sensor_msgs/Range",
    "RelativeHumidity": "sensor_msgs/RelativeHumidity",
    "Temperature": "sensor_msgs/Temperature",
    "TwistStamped": "geometry_msgs/TwistStamped",
    "Wrench": "geometry_msgs/WrenchStamped",
    "WrenchStamped": "geometry_msgs/WrenchStamped",
}
_TOPICS = ("Topic", "Marker Topic", "Image Topic", "Depth Map Topic")
"""The property that has the topic, of all displays; ROS 2 has `Topic` where ROS 1 had one by kind."""
_RAW = "raw"
_TRANSPORTS = ("compressed", "compressedDepth", "theora", "zstd", "draco", "zlib", "cloudini")
"""Of images and point clouds, the last part of a topic that has another type than the display."""
_POLICIES = {
    "Reliability Policy": ("reliability", {"Reliable": "reliable", "Best Effort": "best_effort"}),
    "Durability Policy": ("durability", {"Volatile": "volatile", "Transient Local": "transient_local"}),
}


def displayed(config: Document, kinds_in_types: bool) -> tuple[Endpoint, ...]:
    """What the enabled displays of a configuration subscribe to, each topic once. `kinds_in_types`: whether that ROS
    writes `package/msg/Name` for `package/Name`."""
    return _displayed(config, "/msg/" if kinds_in_types else "/")


@derived
def _displayed(config: Document, slash: str) -> tuple[Endpoint, ...]:
    return tuple(_subscribers(config, slash))


def _subscribers(config: Document, slash: str) -> Iterator[Endpoint]:
    try:
        root = compose_fast(config.text)
    except CONSTRUCTION_ERRORS:
        return
    topics = set[str]()
    for display in _enabled(_properties(_properties(root).get("Visualization Manager", (None, None))[1])):
        library, _, kind = _text(display, "Class").rpartition("/")
        type_ = _TYPES.get(kind) if library in _LIBRARIES else None
        name, key, qos = _topic(display)
        raw = (_text(display, "Transport Hint") or _RAW) == _RAW and names.leaf(name) not in _TRANSPORTS
        if type_ is None or key is None or not name or not raw or not names.is_legal(name) or name in topics:
            continue
        topics.add(name)
        place = config.location(Span(key.start_mark.index, key.end_mark.index))
        yield _subscriber(name, type_.replace("/", slash), qos, place, str(key.value), _text(display, "Name") or kind)


def _subscriber(
    name: str, type_: str, qos: Mapping[str, str], place: Location, property_: str, display: str
) -> Endpoint:
    named_by = NamedBy(property_, place, display)
    return Endpoint("subscriber", name, type_, None, qos, evidence=_EVIDENCE, named_by=named_by)


_Properties = Mapping[str, tuple[yaml.Node, yaml.Node]]
"""Keys and values of a mapping, by the text of the key."""


def _properties(node: yaml.Node | None) -> _Properties:
    pairs = node.value if isinstance(node, yaml.MappingNode) else ()
    return {key.value: (key, value) for key, value in pairs if isinstance(key, yaml.ScalarNode)}


def _text(properties: _Properties, name: str) -> str:
    value = properties[name][1] if name in properties else None
    return str(value.value) if isinstance(value, yaml.ScalarNode) else ""


def _enabled(group: _Properties) -> Iterator[_Properties]:
    """The displays of a group that are on, and those of the groups in it."""
    listed = group["Displays"][1] if "Displays" in group else None
    for item in listed.value if isinstance(listed, yaml.SequenceNode) else ():
        display = _properties(item)
        if _text(display, "Enabled").lower() != "true":
            continue
        if _text(display, "Class") in _GROUPS:
            yield from _enabled(display)
        else:
            yield display


def _topic(display: _Properties) -> tuple[str, yaml.Node | None, Mapping[str, str]]:
    """The topic of a display, the key that has it for its value, and the QoS as far as it is set (ROS 2)."""
    name = next((each for each in _TOPICS if each in display), None)
    if name is None:
        return "", None, {}
    inner = _properties(display[name][1])
    if not inner:
        return _text(display, name), display[name][0], {}
    if "Value" not in inner:
        return "", None, {}
    given = {policy: values.get(_text(inner, key)) for key, (policy, values) in _POLICIES.items()}
    return _text(inner, "Value"), inner["Value"][0], {policy: value for policy, value in given.items() if value}
