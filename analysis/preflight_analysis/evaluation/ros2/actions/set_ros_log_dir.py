"""`<set_ros_log_dir>`: `SetROSLogDir`."""

from __future__ import annotations

import os

from preflight_analysis.evaluation.ros2.entity import action_tag
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.walk import LaunchAction, Walk
from preflight_analysis.launch.model import Action
from preflight_analysis.launch.schema import Attribute


def evaluate(walk: Walk, performer: Performer, action: Action) -> None:
    """A relative one is below the one before."""
    value = action.value("new_log_dir")
    if value is not None:
        result = performer.value(value)
        folder = os.path.join(walk.context.variable("ROS_LOG_DIR") or "", result.text)
        if result.known and os.path.isabs(folder):
            walk.context.set_variable("ROS_LOG_DIR", folder)


ENTITIES = (
    LaunchAction(
        kind="set_ros_log_dir",
        tag=action_tag(
            "Sets the folder of the logs.",
            Attribute("new_log_dir", "The folder.", "file", required=True),
            named_by=("new_log_dir",),
        ),
        evaluate=evaluate,
        offered=300,
    ),
)
