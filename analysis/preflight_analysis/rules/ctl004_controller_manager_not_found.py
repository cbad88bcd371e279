"""CTL004: a spawner asks a controller manager that the launch has under another name.

https://control.ros.org/jazzy/doc/ros2_control/controller_manager/doc/userdoc.html#helper-scripts
"""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.moveit import MOVE_GROUP
from preflight_analysis.evaluation.ros2.spawners import asked_of, is_spawner
from preflight_analysis.findings.finding import Finding
from preflight_analysis.robot.of_launch import DESCRIPTION
from preflight_analysis.rules.controllers import controllers_of, managers_of
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
    spawners = [node for node in tree.nodes if is_spawner(node)]
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
        # The manager that is meant has the types of the controllers, unless the spawner brings them.
        meant = any(types.get(manager, set()).issuperset(asked.controllers) for manager in managers)
        if asked.plain and not meant:
            continue
        yield rule.finding(
            f"controller manager '{asked.manager}' is not in this launch: {node.name} waits for it; the launch has "
            f"{quoted(sorted(managers))}",
            attribute_location(context, node, "args"),
            confidence="likely",
            related=include_chain(node.origin),
        )


def _may_have_manager(context: Context, namespace: str) -> bool:
    """Whether a program in the namespace may have a manager in it, as simulators and drivers do: it gets the
    description of a robot, or parameters for a manager."""
    return any(
        node.namespace == namespace
        and not is_spawner(node)
        and (node.package, node.executable) not in _WITHOUT
        and any(param.name == DESCRIPTION or param.name.endswith(".type") for param in node.params)
        for node in context.tree.nodes
    )


RULE = Rule(
    id="CTL004",
    name="controller-manager-not-found",
    severity="warning",
    what="Checks for a spawner that asks for a controller manager which the launch does not start, while the launch "
    "starts another one, for example in a namespace. There is no finding if not all of the launch is known, "
    "or if another program in that namespace gets a robot description and may have a manager in it. The manager of the "
    "launch must have the types of the controllers, unless the spawner brings them.",
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
