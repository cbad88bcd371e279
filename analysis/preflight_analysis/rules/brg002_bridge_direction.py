"""BRG002: a bridge that carries a topic in the direction in which nobody sends it (ROS 2).

https://docs.ros.org/en/jazzy/p/ros_gz_bridge/
"""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.evaluation.ros2.bridges import is_bridge
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.model import Channel, Connection, Graph
from preflight_analysis.model.context import Context
from preflight_analysis.model.gazebo_bridges import Bridge, bridges
from preflight_analysis.model.gazebo_side import Gazebo, gazebo_of, plain
from preflight_analysis.model.places import related_endpoint
from preflight_analysis.model.problems import include_chain, rename
from preflight_analysis.model.reach import seen
from preflight_analysis.rules.further_reading import ROS_GZ_BRIDGE
from preflight_analysis.rules.rule import Rule

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

_SAID = "bridge direction: '{name}' goes {way}, but has no {missing} in ROS ({role}: {node}{more}){aside}"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    if graph is None:
        return
    channels = _channels(graph)
    gazebo = gazebo_of(context)
    for bridge in bridges(context):
        channel = channels.get((bridge.node.name, bridge.topic))
        if channel is None or channel.external:
            continue
        providers, consumers = _others(channel.providers, bridge), _others(channel.consumers, bridge)
        if bridge.direction == "BIDIRECTIONAL":
            yield from _of_clock(rule, context, bridge)
            continue
        of_gazebo = _of_gazebo(gazebo, bridge, bool(providers), bool(consumers)) if gazebo is not None else None
        if of_gazebo is not None:
            message, doubtful = of_gazebo
            yield rule.claim(
                message,
                bridge.place,
                subject=Subject("topic", bridge.gazebo_topic),
                doubts=doubts(INTENDED=doubtful),
                related=(*(gazebo.related if gazebo is not None else ()), *include_chain(bridge.node.origin)),
                fixes=rename(context, bridge.place, *bridge.turned),
            )
            continue
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
        more = f" and {len(ends) - 1} more" if len(ends) > 1 else ""
        yield rule.claim(
            say(
                _SAID,
                name=channel.name,
                way=way,
                missing=missing,
                role=ends[0].endpoint.role,
                node=ends[0].node.name,
                more=more,
                aside=seen(context, graph).aside,
            ),
            bridge.place,
            subject=Subject("topic", channel.name),
            doubts=doubts(OUTSIDE=not known, NOT_ANALYSED=not known and seen(context, graph).lacks),
            related=(
                *(related_endpoint(each, "publishes" if providers else "subscribes to") for each in ends[:3]),
                *include_chain(bridge.node.origin),
            ),
            fixes=rename(context, bridge.place, written, other) if sure else (),
        )


def _of_clock(rule: Rule, context: Context, bridge: Bridge) -> Iterator[Finding]:
    """Gazebo leaves the time to whoever publishes it already: `Run` in SimulationRunner.cc of gz-sim."""
    if bridge.gazebo.rpartition(".")[2] == "Clock" and plain(bridge.gazebo_topic) == "/clock":
        sign = bridge.turned[0].replace(f"{bridge.ros}@", f"{bridge.ros}[")
        turned = "GZ_TO_ROS" if bridge.turned[0] == bridge.direction else sign
        yield rule.claim(
            "bridge direction: '/clock' goes both ways; Gazebo does not publish it if the bridge starts first",
            bridge.place,
            subject=Subject("topic", "/clock"),
            related=include_chain(bridge.node.origin),
            fixes=rename(context, bridge.place, bridge.turned[0], turned) if turned != bridge.turned[0] else (),
        )


def _of_gazebo(gazebo: Gazebo, bridge: Bridge, has_providers: bool, has_consumers: bool) -> tuple[str, bool] | None:
    """What Gazebo says against a direction: it has the other end of the topic alone. The message, and whether what is
    in ROS speaks for the direction."""
    others = {"GZ_TO_ROS": "ROS_TO_GZ", "ROS_TO_GZ": "GZ_TO_ROS"}
    makers = gazebo.named(bridge.gazebo_topic, others[bridge.direction]) if bridge.direction in others else ()
    if not makers or gazebo.named(bridge.gazebo_topic, bridge.direction):
        return None
    if bridge.direction == "ROS_TO_GZ":
        said, doubtful = "goes from ROS to Gazebo, but {} publishes it there", has_providers
    elif has_consumers and not has_providers:
        # What the window of Gazebo sends to its robot may be of interest in ROS, too.
        return None
    else:
        said, doubtful = "goes from Gazebo to ROS, but {} subscribes to it there", not has_providers
    said = f"bridge direction: '{bridge.gazebo_topic}' {said.format(makers[0].maker)}"
    return said, doubtful


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
    effect="breaks",
    kind="conflict",
    always=(Reason.LIBRARY,),
    sometimes=(Reason.OUTSIDE, Reason.NOT_ANALYSED, Reason.INTENDED),
    what="Checks for a topic of `ros_gz_bridge` that goes in the wrong direction: a measurement from ROS to Gazebo, or "
    "a command from Gazebo to ROS. It also checks for a `/clock` that goes both ways.",
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
