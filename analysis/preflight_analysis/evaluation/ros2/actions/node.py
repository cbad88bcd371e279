"""`<node>` and `<lifecycle_node>`: `launch_ros.actions.Node` and `LifecycleNode`."""

from __future__ import annotations

from preflight_analysis.evaluation.ros2.entity import NAMESPACE, action_tag, flag, required
from preflight_analysis.evaluation.ros2.nodes import evaluate_node
from preflight_analysis.evaluation.ros2.processes import PROCESS
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.walk import LaunchAction, Walk
from preflight_analysis.launch.model import Action
from preflight_analysis.launch.schema import Attribute

NODE = (
    Attribute("pkg", "The package of the node.", "package"),
    Attribute("exec", "The executable of the package.", "executable", required=True),
    Attribute("name", "The name of the node; without it the one that its code gives.", "node"),
    NAMESPACE,
    Attribute("args", "Command-line arguments for the node.", taken="command-line"),
    Attribute("ros_args", "Arguments that follow `--ros-args`.", taken="command-line"),
    Attribute("exec_name", "What the process is called in the logs."),
    *PROCESS,
)
NAMED_NODE = tuple(required(a) if a.name in ("name", "namespace") else a for a in NODE)
CHILDREN = ("param", "remap", "env")
DETAIL = ("pkg", "exec")
KEYWORDS = {"pkg": "package", "exec": "executable", "launch-prefix": "prefix"}
UNRUN = ("pkg", "exec", "name", "namespace")


def evaluate(walk: Walk, performer: Performer, action: Action) -> None:
    """Start a node."""
    evaluate_node(performer, action, deferred=walk.deferred)


def evaluate_lifecycle(walk: Walk, performer: Performer, action: Action) -> None:
    """Start a lifecycle node."""
    evaluate_node(performer, action, kind="lifecycle", deferred=walk.deferred)


ENTITIES = (
    LaunchAction(
        kind="node",
        tag=action_tag(
            "Starts a node.",
            *NODE,
            children=CHILDREN,
            named_by=("name", "exec"),
            starts=True,
        ),
        evaluate=evaluate,
        offered=10,
        starts_process=True,
        is_part=True,
    ),
    LaunchAction(
        kind="lifecycle_node",
        tag=action_tag(
            "Starts a lifecycle node. Of a launch_ros of 2025 or newer; Python launch files have it since long.",
            *NAMED_NODE,
            flag("autostart", "Configure and activate the node once it is there."),
            children=CHILDREN,
            named_by=("name", "exec"),
            starts=True,
        ),
        evaluate=evaluate_lifecycle,
        offered=140,
        starts_process=True,
        is_part=True,
    ),
)
