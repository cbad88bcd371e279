"""BRG002: a bridge that carries a topic in the direction in which nobody sends it (ROS 2).

https://docs.ros.org/en/jazzy/p/ros_gz_bridge/
"""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.evaluation.ros2.bridges import is_bridge
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.model import Channel, Connection, Graph
from preflight_analysis.rules.further_reading import ROS_GZ_BRIDGE
from preflight_analysis.rules.gazebo_bridges import Bridge, bridges
from preflight_analysis.rules.near_miss import not_analysed
from preflight_analysis.rules.places import related_endpoint
from preflight_analysis.rules.problems import include_chain, rename
from preflight_analysis.rules.rule import Context, Rule

_SENSED = frozenset(
    [
        "rosgraph_msgs/Clock",
        "sensor_msgs/FluidPressure",
        "sensor_msgs/Imu",
        "sensor_msgs/LaserScan",
        "sensor_msgs/MagneticField",
        "sensor_msgs/NavSatFix",
        "ros_gz_interfaces/Altimeter",
        "ros_gz_interfaces/Contacts",
        "marine_acoustic_msgs/Dvl",
    ]
)
"""What sensors of Gazebo publish, and nothing in it subscribes to."""
_MEASURED = _SENSED | {
    "nav_msgs/Odometry",
    "ros_gz_interfaces/LogicalCameraImage",
    "sensor_msgs/BatteryState",
    "sensor_msgs/CameraInfo",
    "sensor_msgs/Image",
    "sensor_msgs/JointState",
    "sensor_msgs/PointCloud2",
    "tf2_msgs/TFMessage",
}
"""What Gazebo publishes, too; plugins may subscribe to an image, such as that of a light."""
_COMMANDED = frozenset(
    [
        "geometry_msgs/Twist",
        "geometry_msgs/TwistStamped",
        "geometry_msgs/Wrench",
        "actuator_msgs/Actuators",
        "std_msgs/Float64",
        "trajectory_msgs/JointTrajectory",
        "ros_gz_interfaces/EntityWrench",
        "ros_gz_interfaces/JointWrench",
    ]
)
"""What plugins of Gazebo subscribe to."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    if graph is None:
        return
    channels = _channels(graph)
    for bridge in bridges(context):
        channel = channels.get((bridge.node.name, bridge.topic))
        if channel is None or channel.external:
            continue
        providers, consumers = _others(channel.providers, bridge), _others(channel.consumers, bridge)
        type_ = bridge.ros.replace("/msg/", "/")
        if bridge.direction == "ROS_TO_GZ" and consumers and not providers:
            way, sure, missing = "from ROS to Gazebo", type_ in _MEASURED, "publisher"
        elif bridge.direction == "GZ_TO_ROS" and providers and not consumers:
            way, sure, missing = "from Gazebo to ROS", type_ in _COMMANDED, "subscriber"
        else:
            continue
        if type_ in (_COMMANDED if bridge.direction == "ROS_TO_GZ" else _MEASURED):
            # A teleoperation that the user starts, or a robot beside the simulated one.
            continue
        known = type_ in _SENSED or (sure and graph.likely_complete)
        written, other = bridge.turned
        ends = consumers or providers
        yield rule.finding(
            f"bridge direction: '{channel.name}' goes {way}, but has no {missing} in ROS ({_named(ends)})"
            f"{not_analysed(graph)}",
            bridge.place,
            severity=None if known else "info",
            confidence="likely" if known else "possible",
            related=(
                *(related_endpoint(each, "publishes" if providers else "subscribes to") for each in ends[:3]),
                *include_chain(bridge.node.origin),
            ),
            fixes=rename(context, bridge.place, written, other) if sure else (),
        )


def _named(ends: tuple[Connection, ...]) -> str:
    more = f" and {len(ends) - 1} more" if len(ends) > 1 else ""
    return f"{ends[0].endpoint.role}: {ends[0].node.name}{more}"


def _channels(graph: Graph) -> dict[tuple[str, str], Channel]:
    """The topics of bridges, by the node and the name as the bridge was given it."""
    return {
        (end.node.name, end.endpoint.name): channel
        for channel in graph.topics.values()
        for end in (*channel.providers, *channel.consumers)
        if is_bridge(end.node)
    }


def _others(ends: tuple[Connection, ...], bridge: Bridge) -> tuple[Connection, ...]:
    return tuple(each for each in ends if each.node.name != bridge.node.name)


RULE = Rule(
    id="BRG002",
    name="bridge-direction",
    severity="warning",
    what="Checks for a topic of `ros_gz_bridge` that goes in the wrong direction. The bridge takes a measurement, such "
    "as a scan, from ROS to Gazebo, while nobody publishes it in ROS and a node subscribes to it. Or it takes a "
    "command, such as a velocity, from Gazebo to ROS, while a node publishes it and nobody subscribes to it. The "
    "finding is information for types that are neither. If nodes are not analysed, it is a warning for data of sensors "
    "alone.",
    why="No message arrives. The bridge does not report it.",
    example="arguments=['/scan@sensor_msgs/msg/LaserScan]gz.msgs.LaserScan']",
    instead="arguments=['/scan@sensor_msgs/msg/LaserScan[gz.msgs.LaserScan']",
    references=(ROS_GZ_BRIDGE,),
    generations=(2,),
    check=_check,
    needs_graph=True,
    every_root=True,
    settings=("external", "nodes"),
)
