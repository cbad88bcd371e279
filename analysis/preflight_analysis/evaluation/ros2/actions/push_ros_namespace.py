"""`<push_ros_namespace>`: `PushROSNamespace`."""

from __future__ import annotations

from preflight_analysis.evaluation.ros2.entity import NAMESPACE, action_tag, required
from preflight_analysis.evaluation.ros2.nodes import namespace_of
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.walk import LaunchAction, Walk
from preflight_analysis.launch.model import Action


def evaluate(walk: Walk, performer: Performer, action: Action) -> None:
    """Nodes of the scope come below it from now on."""
    ns, valid = namespace_of(performer, action)
    if ns is not None and valid:
        walk.context.push_namespace(ns)


_TAG = action_tag(
    "Puts the nodes that come later in this group into a namespace.", required(NAMESPACE), named_by=("namespace",)
)
ENTITIES = (
    LaunchAction(
        kind="push_ros_namespace",
        tag=_TAG,
        evaluate=evaluate,
        offered=60,
    ),
    LaunchAction(kind="push-ros-namespace", tag=_TAG, evaluate=evaluate, offered=70),
)
