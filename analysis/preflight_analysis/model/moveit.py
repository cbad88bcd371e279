"""The controllers that MoveIt is told of, beside those that the launch loads."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.meanings import items_of
from preflight_analysis.evaluation.moveit import MoveItController, controller_params, full_action, moveit_controllers
from preflight_analysis.evaluation.ros1.spawners import loaded_by
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context
from preflight_analysis.model.controllers import controllers_of
from preflight_analysis.model.nearest import nearest

_TRAJECTORY = "JointTrajectoryController"
_ACTIONS = {
    _TRAJECTORY: "follow_joint_trajectory",
    "GripperActionController": "gripper_cmd",
}
"""The action that a controller serves below its name, by the end of its type."""


class Loaded(NamedTuple):
    """A controller that the launch loads. `name` is its full name, `joints` are those that it moves, as far as they are
    known, `joints_param` has them."""

    name: str
    type: str
    joints: tuple[str, ...]
    joints_param: Param | None
    spawner: LaunchNode
    partial: bool = False
    """Whether it takes goals for some of its joints."""

    @property
    def action(self) -> str | None:
        """The full name of the action that it serves; None where that is not known."""
        found = next((action for end, action in _ACTIONS.items() if self.type.endswith(end)), None)
        return f"{self.name}/{found}" if found is not None else None

    @property
    def follows_trajectories(self) -> bool:
        """Whether it is one for trajectories."""
        return self.type.endswith(_TRAJECTORY)


class Known(NamedTuple):
    """A controller that a node of MoveIt knows. `loaded` is the one that the launch loads under that name."""

    node: LaunchNode
    controller: MoveItController
    action: str
    loaded: Loaded | None


class Unserved(NamedTuple):
    """A controller that a node of MoveIt knows and whose action no node serves. `meant` is the one that was, and
    `reason` says what of it shows that; None where the one of that name serves another action."""

    known: Known
    meant: Loaded | None
    reason: str = ""


@derived
def known_to_moveit(context: Context) -> tuple[Known, ...]:
    """The controllers of all nodes of MoveIt."""
    tree = context.tree
    given = ((node, controller_params(tree, node)) for node in tree.nodes)
    found = [(node, each) for node, params in given for each in moveit_controllers(params, node)]
    loaded = {each.name: each for each in loaded_controllers(context)} if found else {}
    return tuple(
        Known(node, each, full_action(node, each), loaded.get(names.resolve(each.name, node.name)))
        for node, each in found
    )


@derived
def unserved(context: Context) -> tuple[Unserved, ...]:
    """The controllers that MoveIt knows under a wrong name, or with a wrong action."""
    known = known_to_moveit(context)
    served = context.graph.actions if context.graph is not None else {}
    actions = {each.action for each in known}
    loaded = loaded_controllers(context) if known else ()
    free = [each for each in loaded if each.action is not None and each.action not in actions]
    found: list[Unserved] = []
    for each in known:
        channel = served.get(each.action)
        if channel is not None and (channel.providers or channel.external):
            continue
        if each.loaded is not None:
            other_action = each.loaded.action is not None and each.loaded.action != each.action
            found += [Unserved(each, None)] if other_action else []
            continue
        meant, reason = _meant(each, free)
        found += [Unserved(each, meant, reason)] if meant is not None else []
    return tuple(found)


def _meant(known: Known, free: list[Loaded]) -> tuple[Loaded | None, str]:
    """The controller that was meant, and what says so."""
    mine = set(known.controller.joints)
    ends = [each for each in free if (each.action or "").endswith(f"/{known.controller.action_ns}")]
    same_name = [each for each in ends if names.leaf(each.name) == names.leaf(known.controller.name)]
    if len(same_name) == 1:
        return same_name[0], "the launch loads"
    moving = [each for each in ends if mine and mine <= set(each.joints)]
    if len(moving) == 1:
        return moving[0], "moves the same joints"
    unknown = {names.leaf(each.name): each for each in ends if not each.joints}
    near = nearest(names.leaf(known.controller.name), unknown)
    return (unknown[near], "the launch loads") if near is not None else (None, "")


@derived
def loaded_controllers(context: Context) -> tuple[Loaded, ...]:
    """The controllers that spawners of the launch load."""
    return tuple(_of_ros2(context) if context.tree.ros.ament else _of_ros1(context))


def _of_ros2(context: Context) -> Iterator[Loaded]:
    for each in controllers_of(context):
        if each.spawner is None:
            continue
        commanded = [claim for claim in each.claims if claim.commands]
        name = names.join(names.parent(each.manager), each.name)
        joints = tuple(dict.fromkeys(claim.joint for claim in commanded))
        param = commanded[0].param if commanded else None
        partial = any(p.name == "allow_partial_joints_goal" and p.value for p in each.params)
        yield Loaded(name, each.type, joints, param, each.spawner, partial)


def _of_ros1(context: Context) -> Iterator[Loaded]:
    params = context.tree.params
    for node in context.tree.nodes:
        for name in loaded_by(node):
            type_, joints = params.get(f"{name}/type"), params.get(f"{name}/joints") or params.get(f"{name}/joint")
            if type_ is None or not isinstance(type_.value, str):
                continue
            partial = params.get(f"{name}/allow_partial_joints_goal")
            yield Loaded(
                name,
                type_.value,
                tuple(items_of(joints.value)) if joints is not None else (),
                joints,
                node,
                partial is not None and partial.value is True,
            )
