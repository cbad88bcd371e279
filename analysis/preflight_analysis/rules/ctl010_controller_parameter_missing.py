"""CTL010: a controller without a parameter that it does not go on without.

`on_configure` of each controller refuses an empty one: `'command_interfaces' parameter is empty`
(https://github.com/ros-controls/ros2_controllers, humble and jazzy).
"""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.evaluation.ros2.spawners import asked_of
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.model.context import Context
from preflight_analysis.model.controllers import controllers_of
from preflight_analysis.model.problems import include_chain, quoted
from preflight_analysis.model.sections import files_of
from preflight_analysis.rules.further_reading import ROS2_CONTROLLERS
from preflight_analysis.rules.rule import Rule

_NEEDED = {
    "diff_drive_controller/DiffDriveController": ("left_wheel_names", "right_wheel_names"),
    "effort_controllers/JointGroupEffortController": ("joints",),
    "forward_command_controller/ForwardCommandController": ("joints", "interface_name"),
    "forward_command_controller/MultiInterfaceForwardCommandController": ("joint", "interface_names"),
    "joint_trajectory_controller/JointTrajectoryController": ("command_interfaces", "state_interfaces"),
    "position_controllers/JointGroupPositionController": ("joints",),
    "velocity_controllers/JointGroupVelocityController": ("joints",),
}
"""The parameters that a type of controller needs, each without a default."""
_ONLY_LOADED = "--load-only"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    managers = {node.name: node for node in context.tree.nodes_and_simulated}
    for each in controllers_of(context):
        needed, manager = _NEEDED.get(each.type, ()), managers.get(each.given_to)
        package = context.environment.packages.get(each.type.partition("/")[0])
        if package is not None and package.is_within(context.environment.workspace):
            continue  # a controller of one's own that is called so
        if not needed or each.spawner is None or manager is None or not _is_known(context, manager, each.spawner):
            continue
        own = {param.name for param in each.params if param.value not in ("", [])}
        missing = [name for name in needed if name not in own]
        if not missing:
            continue
        apart = None if own.intersection(needed) else _apart(context, manager, missing[0])
        reason = f"; section '{apart[0]}' sets it, and applies to no node" if apart is not None else ""
        yield rule.claim(
            f"controller '{each.name}' has no parameter {quoted(missing)}, which {each.type} requires{reason}",
            each.spawner.location,
            subject=Subject("controller", each.name),
            kind="absent",
            related=(*((apart[1],) if apart is not None else ()), *include_chain(each.spawner.origin)),
        )


def _is_known(context: Context, manager: LaunchNode, spawner: LaunchNode) -> bool:
    """Whether all is known that the controller may get, and the spawner configures it."""
    asked = asked_of(spawner)
    if asked is None or manager.unknowns or _ONLY_LOADED in spawner.args or "--controller-ros-args" in spawner.args:
        return False
    given = (source.path for source in manager.param_sources if source.path is not None)
    return all(path in context.documents for path in (*given, *asked.files))


def _apart(context: Context, manager: LaunchNode, name: str) -> tuple[str, Related] | None:
    """The only section of the manager's files that has the parameter and applies to no node."""
    found = [
        (each.section.key, Related("the section", context.location(used.path, each.section.spans[-1])))
        for used in files_of(context, manager)
        for each in used.sections
        if each.section.exact and not each.nodes and any(param.name == name for param in each.section.params)
    ]
    return found[0] if len(found) == 1 else None


RULE = Rule(
    id="CTL010",
    name="controller-parameter-missing",
    effect="breaks",
    kind="absent",
    always=(Reason.LIBRARY,),
    what="Checks for a controller that a spawner configures and that lacks a parameter which its type requires, such "
    "as `command_interfaces`. A section of another name is the usual cause.",
    why="The controller refuses to be configured: `'command_interfaces' parameter is empty`. The spawner exits.",
    example="controller_manager:\n  ros__parameters:\n    arm: {type: joint_trajectory_controller/"
    "JointTrajectoryController}\narm_controller:\n  ros__parameters:\n    command_interfaces: [position]",
    instead="controller_manager:\n  ros__parameters:\n    arm: {type: joint_trajectory_controller/"
    "JointTrajectoryController}\narm:\n  ros__parameters:\n    command_interfaces: [position]",
    references=(ROS2_CONTROLLERS,),
    generations=(2,),
    check=_check,
    every_root=True,
)
