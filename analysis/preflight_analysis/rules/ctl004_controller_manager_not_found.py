"""CTL004: a spawner asks a controller manager that the launch has under another name.

https://control.ros.org/jazzy/doc/ros2_control/controller_manager/doc/userdoc.html#helper-scripts
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.moveit import MOVE_GROUP
from preflight_analysis.evaluation.ros2.spawners import asked_of, is_hardware_spawner, is_spawner
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.finding import Finding
from preflight_analysis.robot.of_launch import DESCRIPTION, robots_of
from preflight_analysis.rules.controllers import controllers_of, managers_of, robot_of_manager
from preflight_analysis.rules.further_reading import CONTROLLER_MANAGER
from preflight_analysis.rules.places import attribute_location
from preflight_analysis.rules.problems import include_chain, quoted
from preflight_analysis.rules.rule import Context, Rule

_WITHOUT = frozenset(
    {
        MOVE_GROUP,
        ("robot_state_publisher", "robot_state_publisher"),
        ("joint_state_publisher", "joint_state_publisher"),
        ("joint_state_publisher_gui", "joint_state_publisher_gui"),
        ("rviz2", "rviz2"),
    }
)
"""Nodes that get a description and have no manager in them."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    tree = context.tree
    spawners = [node for node in tree.nodes if _waits(node)]
    managers = managers_of(tree) if spawners else {}
    if not managers or not tree.complete:
        return
    there = {*managers, *(node.name for node in tree.nodes_and_simulated)}
    types: dict[str, set[str]] = {}
    for each in context.once(controllers_of):
        types.setdefault(each.manager, set()).add(each.name)
    for node in spawners:
        asked = asked_of(node)
        if asked is None or asked.manager in there or _may_have_manager(context, names.parent(asked.manager)):
            continue
        has = _components(context, managers) if is_hardware_spawner(node) else types
        # The manager that is meant has the types of the controllers, unless the spawner brings them, or the hardware.
        meant = any(has.get(manager, set()).issuperset(asked.controllers) for manager in managers)
        if not meant and (asked.plain or is_hardware_spawner(node)):
            continue
        yield rule.finding(
            f"controller manager '{asked.manager}' is not in this launch: {node.name} waits for it; the launch has "
            f"{quoted(sorted(managers))}",
            attribute_location(context, node, "args"),
            confidence="likely",
            related=include_chain(node.origin),
        )


def _waits(node: LaunchNode) -> bool:
    return is_spawner(node) or is_hardware_spawner(node)


def _components(context: Context, managers: Mapping[str, str]) -> Mapping[str, set[str]]:
    """The hardware components of each manager: of its robot, or of the only one of the launch."""
    only = [robot.description for robot in robots_of(context.tree) if robot.description.is_whole]
    found: dict[str, set[str]] = {}
    for manager, node in managers.items():
        robot = robot_of_manager(context, manager, node) or (only[0] if len(only) == 1 else None)
        found[manager] = {system.name for system in robot.systems} if robot is not None else set()
    return found


def _may_have_manager(context: Context, namespace: str) -> bool:
    """Whether a program in the namespace may have a manager in it, as simulators and drivers do: it gets the
    description of a robot, or parameters for a manager."""
    return any(
        node.namespace == namespace
        and not _waits(node)
        and (node.package, node.executable) not in _WITHOUT
        and any(param.name == DESCRIPTION or param.name.endswith(".type") for param in node.params)
        for node in context.tree.nodes
    )


RULE = Rule(
    id="CTL004",
    name="controller-manager-not-found",
    severity="warning",
    what="Checks for a spawner of controllers or hardware that asks for a controller manager which the launch does not "
    "start, while the launch starts another one, for example in a namespace. The manager of a simulated robot counts: "
    "the plugin of the robot description has its name and namespace. There is no finding if not all of the launch is "
    "known, or if another program in that namespace gets a robot description and may have a manager in it. The manager "
    "of the launch must have the types of the controllers, unless the spawner brings them, or the hardware.",
    why="The spawner waits for the services of that manager until its timeout. No controller is loaded.",
    example='<node pkg="controller_manager" exec="ros2_control_node" name="controller_manager" namespace="robot"/>\n'
    '<node pkg="controller_manager" exec="spawner" args="base -c /controller_manager"/>',
    instead='<node pkg="controller_manager" exec="ros2_control_node" name="controller_manager" namespace="robot"/>\n'
    '<node pkg="controller_manager" exec="spawner" args="base -c /robot/controller_manager"/>',
    references=(CONTROLLER_MANAGER,),
    generations=(2,),
    check=_check,
    every_root=True,
)
