"""Names that are served or used from outside of most launches: that nobody does so in this one means nothing."""

from __future__ import annotations

from preflight_analysis.evaluation import names
from preflight_analysis.tracing.interface import Endpoint

_TOPICS = frozenset(
    {
        "/clock",  # a simulator or `rosbag play --clock`
        "/diagnostics",
        "/diagnostics_agg",
        "/diagnostics_toplevel_state",
        "/rosout",
        "/rosout_agg",
        "/statistics",
        "/tf",
        "/tf_static",
    }
)
_FROM_RVIZ = frozenset({"clicked_point", "initialpose", "move_base_simple/goal"})
_TO_TOOLS = ("/parameter_descriptions", "/parameter_updates")
"""dynamic_reconfigure's, read by its own graphical client."""
IMAGE_TRANSPORTS = ("/compressed", "/compressedDepth", "/theora")
"""What an image_transport publisher makes beside its image. Who reads one of them reads the image."""

_TO_ACTION_SERVER = ("ActionGoal", "actionlib_msgs/GoalID")
_FROM_ACTION_SERVER = ("ActionFeedback", "ActionResult", "actionlib_msgs/GoalStatusArray")
_BESIDE_ACTION_RESULT = ("ActionFeedback", "actionlib_msgs/GoalStatusArray")

_OF_PLANNING = frozenset(
    {"planning_plugin", "planning_plugins", "planning_pipelines", "request_adapters", "response_adapters"}
)
_PARAMS = frozenset(
    {
        "/enable_statistics",
        "/robot_description",
        "/robot_description_semantic",
        "/rosdistro",
        "/rosversion",
        "/run_id",
        "/tcp_keepalive",
        "/use_sim_time",
    }
)


def may_dangle(name: str, endpoint: Endpoint) -> bool:
    """Whether it means nothing that the topic has no other end in the launch.

    So it is for what tools and simulators talk to, for the topics of an action server, whose clients come and go, and
    for four of an action client's five, since the fifth, its result, tells the same.
    """
    if "$(" in name:
        return True  # a name that the launch file did not resolve is that of nothing
    if endpoint.builtin or name in _TOPICS or name.endswith(("/tf", "/tf_static")):
        return True
    kind = endpoint.type or ""
    if kind == "bond/Status":
        return True  # between processes that watch each other: a nodelet's manager and its loaders
    if endpoint.role == "subscriber":
        if any(name.endswith("/" + topic) for topic in _FROM_RVIZ):
            return True
        return kind.endswith((*_TO_ACTION_SERVER, *_BESIDE_ACTION_RESULT))
    if name.endswith((*_TO_TOOLS, *IMAGE_TRANSPORTS)):
        return True
    return kind.endswith((*_TO_ACTION_SERVER, *_FROM_ACTION_SERVER))


def describes_robot(parameter: str) -> bool:
    """Whether a parameter, of whatever namespace, has the description of a robot, which is mostly set once for several
    launches."""
    return names.leaf(parameter) in ("robot_description", "robot_description_semantic")


def is_transform(name: str) -> bool:
    """Whether it is one of tf's topics, which a listener that is made later on uses."""
    return names.leaf(name) in ("tf", "tf_static", "tf2")


def is_of_planning(parameter: str) -> bool:
    """Whether it is one of MoveIt's planning pipelines, which any node may have by MoveIt's library
    (https://moveit.picknik.ai/main/doc/examples/planning_adapters/planning_adapters_tutorial.html)."""
    return names.leaf(parameter.replace(".", "/")) in _OF_PLANNING


def is_for_tools(parameter: str) -> bool:
    """Whether a parameter is read by ROS itself, by tools or by ros_control in Gazebo rather than by the nodes of the
    launch."""
    return parameter in _PARAMS or parameter.startswith("/roslaunch/") or "/gazebo_ros_control/" in parameter
