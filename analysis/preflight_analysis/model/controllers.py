"""The controllers of ros2_control that a launch has: what their parameters ask for, and who starts them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.meanings import Known, Meant, Settings, items_of, meant_by, own_params
from preflight_analysis.evaluation.ros2.params import of_name
from preflight_analysis.evaluation.ros2.simulated import manager_name, plugins_in
from preflight_analysis.evaluation.ros2.spawners import (
    MANAGER,
    PACKAGE,
    asked_of,
    is_spawner,
    with_spawned,
)
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree, Param
from preflight_analysis.evaluation.value_places import value_place
from preflight_analysis.evaluation.words import words_of
from preflight_analysis.findings.doubt import Doubt, doubts
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context
from preflight_analysis.model.robots import robots
from preflight_analysis.robot.model import Description
from preflight_analysis.robot.of_launch import Robot, robots_of, unread_of

_TYPE = ".type"
_NOT_STARTED = frozenset({"--inactive", "--stopped", "--load-only"})
_UNLOADS = "unspawner"
SPAWN_ROS1 = ("gazebo_ros", "spawn_model")
"""What puts a robot description into Gazebo in ROS 1: package and executable."""
GAZEBO_PLUGIN_ROS1 = "gazebo_ros_control"
"""The plugin of Gazebo that has a controller manager of ROS 1, in the name of its library."""
_DEFAULT = "DefaultRobotHWSim"
_JOINTS = ("joint", "joints", "left_wheel", "right_wheel")
_EXTRA = "extra_joints"
_BY_JOINT: Mapping[str, tuple[str, ...]] = {
    "JointTrajectoryController": ("constraints", "gains"),
    "PidController": ("gains",),
}
"""Groups of parameters of which each has the name of a joint of the controller, by the end of its type:
https://github.com/ros-controls/ros2_controllers and https://github.com/ros-controls/ros_controllers."""


class Claim(NamedTuple):
    """A joint that a controller has in its parameters, with the interfaces that it asks for of it."""

    joint: str
    interfaces: tuple[str, ...]
    commands: bool
    param: Param


class NamedJoint(NamedTuple):
    """A joint that the parameters of a controller of ROS 1 name. `is_extra`: it has no hardware, and its state is
    published as it is written."""

    joint: str
    param: Param
    is_extra: bool = False


class Controller(NamedTuple):
    """A controller that a manager has the type of. `spawner` is what loads it, None where nothing of the launch does,
    and `is_active` whether that activates it, too."""

    name: str
    type: str
    manager: str
    given_to: str
    """The name of the manager's node in the launch file."""
    known: Known | None
    claims: tuple[Claim, ...]
    spawner: LaunchNode | None
    is_active: bool
    params: tuple[Param, ...] = ()
    """Its own, by the names by which it asks for them."""

    @property
    def doubts(self) -> tuple[Doubt, ...]:
        """Why a finding about the parameters is not certain: what they mean was read of its source, or of another
        version."""
        is_used = self.known is not None and self.known.is_used
        return doubts(FROM_SOURCE=is_used, OTHER_VERSION=not is_used)


@derived
def controllers_of(context: Context) -> tuple[Controller, ...]:
    """Those of all managers of the launch."""
    if not context.tree.ros.ament:
        return ()
    spawned = _spawned(context.tree)
    tree = with_spawned(context.tree, context.documents)
    return tuple(
        each
        for node in tree.nodes_and_simulated
        if (node.package, node.executable) == MANAGER
        for each in _of_manager(context, node, spawned)
    )


def joints_of_ros1(tree: LaunchTree, controller: str) -> Iterator[NamedJoint]:
    """The joints of a controller of ROS 1, by its full name."""
    for name in _JOINTS:
        param = tree.params.get(f"{controller}/{name}")
        if param is not None:
            yield from (NamedJoint(joint, param) for joint in items_of(param.value))
    extra = tree.params.get(f"{controller}/{_EXTRA}")
    for each in extra.value if extra is not None and isinstance(extra.value, list) else ():
        if extra is not None and isinstance(each, dict) and isinstance(each.get("name"), str):
            yield NamedJoint(each["name"], extra, is_extra=True)


class ForJoint(NamedTuple):
    """A parameter that a controller reads for one of its joints by the name of that: `constraints.elbow.goal`."""

    joint: str
    group: str
    param: Param


def set_for_joints(type_: str, params: Iterable[tuple[str, Param]]) -> Iterator[ForJoint]:
    """The first for each joint that is set below a controller of this type; names have dots between their parts."""
    groups = next((of_type for end, of_type in _BY_JOINT.items() if type_.endswith(end)), ())
    seen: set[tuple[str, str]] = set()
    for name, param in params:
        group, _, rest = name.partition(".")
        joint = rest.rpartition(".")[0]
        if group in groups and joint and (group, joint) not in seen:
            seen.add((group, joint))
            yield ForJoint(joint, group, param)


def simulated_of_ros1(context: Context) -> Robot | None:
    """The only robot that a launch of ROS 1 puts into Gazebo, if the plugin there makes the hardware of its
    transmissions: it has no other joints then."""
    if not any((node.package, node.executable) == SPAWN_ROS1 for node in context.tree.nodes) or unread_of(context.tree):
        return None
    found = [robot for robot in robots(context) if _has_default_hardware(robot.description)]
    return found[0] if len(found) == 1 else None


def _has_default_hardware(description: Description) -> bool:
    plugins = [each for each in description.plugins if GAZEBO_PLUGIN_ROS1 in each.filename]
    return len(plugins) == 1 and plugins[0].params.get("robotSimType", _DEFAULT).endswith(_DEFAULT)


def robot_of(context: Context, controller: Controller) -> Description | None:
    """The description that the manager of a controller gets."""
    return robot_of_manager(context, controller.manager, controller.given_to)


def robot_of_manager(context: Context, manager: str, given_to: str) -> Description | None:
    """The description that a manager gets, whose node has the name `given_to` in the launch file, or which has the
    manager in a simulator; else the one that is published in its namespace. None where that is not one, or one of the
    launch is not known."""
    there = [robot for robot in robots_of(context.tree) if robot.description.is_whole]
    found = [robot for robot in there if any(node.name == given_to for node in robot.nodes)]
    if not found:
        found = [robot for robot in there if manager in map(manager_name, plugins_in(robot.text))]
    if not found and not unread_of(context.tree):
        space = names.parent(manager)
        found = [robot for robot in there if any(node.namespace == space for node in robot.nodes)]
    return found[0].description if len(found) == 1 else None


def managers_of(tree: LaunchTree) -> Mapping[str, str]:
    """The full names of the controller managers of a launch, each with the name of its node in the launch file."""
    nodes = tree.nodes_and_simulated
    return {_name(node): node.name for node in nodes if (node.package, node.executable) == MANAGER}


def place_of(context: Context, param: Param, value: str) -> Location:
    """Where the value of a parameter is written, or an item of its list; else where the parameter is."""
    return value_place(param.place, value, context.documents.get(param.place.file)) or param.place


def _name(manager: LaunchNode) -> str:
    """The full name of a manager, which calls itself so where the launch file does not name it."""
    named = manager.named or manager.name_from_code
    return manager.name if named else names.join(manager.namespace, PACKAGE)


def _spawned(tree: LaunchTree) -> Mapping[tuple[str, str], tuple[LaunchNode, bool]]:
    """The spawner of each controller, by the names of manager and controller, and whether it activates it."""
    found: dict[tuple[str, str], tuple[LaunchNode, bool]] = {}
    unloads = any(node.package == PACKAGE and node.executable.startswith(_UNLOADS) for node in tree.nodes)
    for node in tree.nodes:
        asked = asked_of(node) if is_spawner(node) else None
        for controller in asked.controllers if asked is not None else ():
            active = _NOT_STARTED.isdisjoint(words_of(node.args)) and not unloads
            found.setdefault((asked.manager, controller) if asked is not None else ("", ""), (node, active))
    return found


def _of_manager(
    context: Context, manager: LaunchNode, spawned: Mapping[tuple[str, str], tuple[LaunchNode, bool]]
) -> Iterator[Controller]:
    name = _name(manager)
    for param in manager.params:
        if not param.name.endswith(_TYPE) or not isinstance(param.value, str):
            continue
        controller = param.name.removesuffix(_TYPE)
        known = context.known.plugin(param.value, "controllers")
        spawner, is_active = spawned.get((name, controller), (None, False))
        node = of_name(manager, names.join(manager.namespace, controller), context.documents, inferred=False)
        claims = tuple(_claims(context, known, node)) if known is not None else ()
        yield Controller(controller, param.value, name, manager.name, known, claims, spawner, is_active, node.params)


def _claims(context: Context, known: Known, node: LaunchNode) -> Iterator[Claim]:
    params = own_params(node, node.params)
    settings = Settings(known, params)
    by_name = dict(params)
    for each in meant_by(known, params, context.known):
        param = each.param or by_name.get(str(each.meaning.default).removeprefix("$"))
        is_claim = each.meaning.kind == "joint" and each.meaning.role in ("commanded", "read")
        if is_claim and isinstance(each.value, str) and each.value and param is not None:
            yield Claim(each.value, tuple(_interfaces(each, settings)), each.meaning.role == "commanded", param)


def _interfaces(meant: Meant, settings: Settings) -> list[str]:
    type_ = meant.meaning.type
    if type_ is None:
        return []
    return items_of(settings.value(type_[1:])) if type_.startswith("$") else [type_]
