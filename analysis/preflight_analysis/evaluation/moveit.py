"""The controllers that MoveIt is told of, which it sends trajectories to as a client of their actions.

`moveit_simple_controller_manager` has them in parameters of move_group: ROS 1 in the list `controller_list`, ROS 2 in
`moveit_simple_controller_manager.controller_names` and a section for each
(moveit_simple_controller_manager.cpp of moveit/moveit 7c0343f0 and of moveit/moveit2 8fcb5d23). The name of the action
is NAME/ACTION_NS (`ActionBasedControllerHandle::getActionName`).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree, Param

MOVE_GROUP = ("moveit_ros_move_group", "move_group")
_MANAGER = "moveit_controller_manager"
_SIMPLE = "MoveItSimpleControllerManager"
_SECTION = "moveit_simple_controller_manager"
_LIST = "controller_list"
_TYPES = {
    "FollowJointTrajectory": "control_msgs/FollowJointTrajectory",
    "GripperCommand": "control_msgs/GripperCommand",
    "ParallelGripperCommand": "control_msgs/ParallelGripperCommand",
}


class MoveItController(NamedTuple):
    """One that MoveIt knows. `param` is the list that names it, `joints_param` has its joints."""

    name: str
    action_ns: str
    type: str
    joints: tuple[str, ...]
    param: Param
    joints_param: Param

    @property
    def action(self) -> str:
        """The name of its action, as MoveIt asks for it."""
        return f"{self.name}/{self.action_ns}" if self.action_ns else self.name

    @property
    def action_type(self) -> str | None:
        """The type of the action, `package/Name`; None where MoveIt does not know the type of the controller."""
        return _TYPES.get(self.type)


def is_move_group(node: LaunchNode) -> bool:
    """Whether a node is that of MoveIt which executes trajectories."""
    return (node.package, node.executable) == MOVE_GROUP


def moveit_params(tree: LaunchTree, node: LaunchNode) -> Mapping[str, Param]:
    """The parameters that are for a node of MoveIt, by their names below its own."""
    if tree.ros.own_parameters:
        return {param.name: param for param in node.params}
    below = f"{node.name}/"
    return {name.removeprefix(below): param for name, param in tree.params.items() if name.startswith(below)}


def params_around(tree: LaunchTree, node: LaunchNode) -> Mapping[str, Param]:
    """Those of `moveit_params`, in ROS 1 with those of the robot description, which are beside the node in its
    namespace."""
    if tree.ros.own_parameters:
        return moveit_params(tree, node)
    space = names.parent(node.name)
    around = {name.removeprefix(space): param for name, param in tree.params.items() if name.startswith(space)}
    return {**around, **moveit_params(tree, node)}


def controller_params(tree: LaunchTree, node: LaunchNode) -> tuple[Param, ...]:
    """The parameters that say which controllers a node of MoveIt knows; none of other nodes."""
    if not is_move_group(node):
        return ()
    if tree.ros.own_parameters:
        return tuple(p for p in node.params if p.name == _MANAGER or p.name.startswith(f"{_SECTION}."))
    found = (tree.params.get(f"{node.name}/{name}") for name in (_MANAGER, _LIST))
    return tuple(param for param in found if param is not None)


def moveit_controllers(params: Iterable[Param], node: LaunchNode) -> tuple[MoveItController, ...]:
    """The controllers that a node of MoveIt knows by these parameters, as far as each has all that MoveIt asks for."""
    by_name = {param.name.removeprefix(f"{node.name}/"): param for param in params}
    manager = by_name.get(_MANAGER)
    if manager is None or not isinstance(manager.value, str) or not manager.value.endswith(_SIMPLE):
        return ()
    return tuple(_of_list(by_name) if _LIST in by_name else _of_sections(by_name))


def full_action(node: LaunchNode, controller: MoveItController) -> str:
    """The full name of the action of a controller that a node knows."""
    return names.resolve(controller.action, node.name)


def _of_sections(params: Mapping[str, Param]) -> Iterator[MoveItController]:
    listed = params.get(f"{_SECTION}.controller_names")
    for name in listed.value if listed is not None and isinstance(listed.value, list) else ():
        action_ns, type_, joints = (params.get(f"{_SECTION}.{name}.{key}") for key in ("action_ns", "type", "joints"))
        if listed is None or action_ns is None or type_ is None or joints is None:
            continue
        found = _controller(name, action_ns.value, type_.value, joints.value, listed, joints)
        yield from (found,) if found is not None else ()


def _of_list(params: Mapping[str, Param]) -> Iterator[MoveItController]:
    listed = params.get(_LIST)
    for item in listed.value if listed is not None and isinstance(listed.value, list) else ():
        if listed is None or not isinstance(item, dict):
            continue
        name, action_ns, type_, joints = (item.get(key) for key in ("name", "action_ns", "type", "joints"))
        found = _controller(name, action_ns, type_, joints, listed, listed)
        yield from (found,) if found is not None else ()


def _controller(
    name: Any, action_ns: Any, type_: Any, joints: Any, listed: Param, joints_param: Param
) -> MoveItController | None:
    if not all(isinstance(each, str) for each in (name, action_ns, type_)) or not isinstance(joints, list):
        return None
    return MoveItController(
        name, action_ns, type_, tuple(each for each in joints if isinstance(each, str)), listed, joints_param
    )
