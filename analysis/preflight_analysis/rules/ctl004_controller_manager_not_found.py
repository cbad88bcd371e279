"""CTL004: a spawner asks a controller manager that the launch has under another name.

https://control.ros.org/jazzy/doc/ros2_control/controller_manager/doc/userdoc.html#helper-scripts
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.moveit import MOVE_GROUP
from preflight_analysis.evaluation.ros1.spawners import asked_of as asked_of_script
from preflight_analysis.evaluation.ros2.spawners import PACKAGE, asked_of, is_hardware_spawner, is_spawner
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.controllers import (
    GAZEBO_PLUGIN_ROS1,
    SPAWN_ROS1,
    controllers_of,
    managers_of,
    robot_of_manager,
)
from preflight_analysis.model.places import attribute_location
from preflight_analysis.model.problems import include_chain, quoted
from preflight_analysis.model.robots import robots
from preflight_analysis.robot.of_launch import DESCRIPTION, robots_of, unread_of
from preflight_analysis.rules.further_reading import CONTROLLER_MANAGER
from preflight_analysis.rules.rule import Rule

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


_WITHOUT_ROS1 = frozenset(
    {
        PACKAGE,
        "gazebo_ros",
        "joint_state_publisher",
        "joint_state_publisher_gui",
        "joy",
        "moveit_ros_move_group",
        "robot_state_publisher",
        "rqt_gui",
        "rviz",
        "tf",
        "tf2_ros",
        "topic_tools",
        "twist_mux",
    }
)
"""Packages whose programs have no manager in them."""
_NAMESPACE_ROS1 = "robotNamespace"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    yield from (_of_ros2 if context.tree.ros.ament else _of_ros1)(rule, context)


def _of_ros1(rule: Rule, context: Context) -> Iterator[Finding]:
    """The plugin of the only robot of the launch names the namespace of its manager, which no other program has."""
    tree = context.tree
    spawners = [(node, asked) for node in tree.nodes if (asked := asked_of_script(node)) is not None]
    if not spawners or not tree.complete or unread_of(tree):
        return
    if sum((node.package, node.executable) == SPAWN_ROS1 for node in tree.nodes) != 1:
        return
    plugins = [each for robot in robots(context) for each in robot.description.plugins]
    named = [each for each in plugins if GAZEBO_PLUGIN_ROS1 in each.filename]
    space = named[0].params.get(_NAMESPACE_ROS1) if len(named) == 1 else None
    if not space:
        return
    there = names.resolve(PACKAGE, f"/{space.strip('/')}/{PACKAGE}" if space.strip("/") else f"/{PACKAGE}")
    with_others = {names.parent(node.name) for node in tree.nodes if node.package not in _WITHOUT_ROS1}
    for node, asked in spawners:
        manager = f"{asked.namespace}/{PACKAGE}"
        if manager != there and names.parent(manager) not in with_others:
            yield _finding(rule, context, node, manager, [there])


def _of_ros2(rule: Rule, context: Context) -> Iterator[Finding]:
    tree = context.tree
    spawners = [node for node in tree.nodes if _waits(node)]
    managers = managers_of(tree) if spawners else {}
    if not managers or not tree.complete:
        return
    there = {*managers, *(node.name for node in tree.nodes_and_simulated)}
    types: dict[str, set[str]] = {}
    for each in controllers_of(context):
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
        yield _finding(rule, context, node, asked.manager, sorted(managers))


def _finding(rule: Rule, context: Context, spawner: LaunchNode, manager: str, there: list[str]) -> Finding:
    said = "controller manager '{manager}' is not in this launch: {node} waits for it; the launch has {there}"
    return rule.claim(
        say(said, manager=manager, node=spawner.name, there=quoted(there)),
        attribute_location(context, spawner, "args"),
        subject=Subject("node", manager),
        candidates=there,
        related=include_chain(spawner.origin),
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
    effect="breaks",
    kind="absent",
    always=(Reason.LIBRARY,),
    what="Checks for a spawner of controllers or hardware whose controller manager the launch does not start, while "
    "it starts another one. The manager of a simulated robot counts. Other programs in the namespace may have one.",
    why="The spawner waits for the services of that manager until its timeout. No controller is loaded.",
    example='<node pkg="controller_manager" exec="ros2_control_node" name="controller_manager" namespace="robot"/>\n'
    '<node pkg="controller_manager" exec="spawner" args="base -c /controller_manager"/>',
    instead='<node pkg="controller_manager" exec="ros2_control_node" name="controller_manager" namespace="robot"/>\n'
    '<node pkg="controller_manager" exec="spawner" args="base -c /robot/controller_manager"/>',
    references=(CONTROLLER_MANAGER,),
    generations=(1, 2),
    check=_check,
    every_root=True,
)
