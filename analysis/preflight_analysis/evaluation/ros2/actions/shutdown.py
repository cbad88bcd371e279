"""`<shutdown>`: `Shutdown`; and `EmitEvent`, of which it is one."""

from __future__ import annotations

from preflight_analysis.evaluation.ros2.entity import action_tag
from preflight_analysis.evaluation.ros2.walk import LaunchAction, only_read
from preflight_analysis.launch.python_classes import PythonClass
from preflight_analysis.launch.schema import Attribute

ENTITIES = (
    LaunchAction(
        kind="shutdown",
        tag=action_tag("Ends the launch.", Attribute("reason", "Why, for the log.", "prose"), named_by=("reason",)),
        python=(PythonClass("launch.actions.Shutdown"),),
        evaluate=only_read,
        offered=290,
    ),
    # Handlers wait for it; what they start is deferred.
    LaunchAction(kind="emit_event", tag=None, python=(PythonClass("launch.actions.EmitEvent"),), evaluate=None),
    # A state of a node, not its configuration.
    LaunchAction(
        kind="lifecycle_transition",
        tag=None,
        python=(PythonClass("launch_ros.actions.LifecycleTransition"),),
        evaluate=None,
    ),
)
