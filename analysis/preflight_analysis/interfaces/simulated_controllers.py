"""Controllers of ros_control that run inside of Gazebo (ROS 1): they are ends of the simulator's node.

A robot description asks for them by the plugin `gazebo_ros_control`, which has a controller manager in the robot's
namespace, and `controller_manager`'s scripts load controllers there, by their parameter `NAME/type`.
https://classic.gazebosim.org/tutorials?tut=ros_control, http://wiki.ros.org/controller_manager
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import lru_cache

from preflight_analysis.catalogue.packages import distribution_of
from preflight_analysis.documents.xml import without_comments
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.ros1.spawners import asked_of
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree
from preflight_analysis.interfaces.catalogued import catalogued
from preflight_analysis.interfaces.part import Launch, Part, Rows
from preflight_analysis.tracing.interface import Endpoint, Evidence, Interface

_EVIDENCE = Evidence("catalogue", "what is known of gazebo_ros_control", ("condition",))
_SIMULATOR = frozenset({("gazebo_ros", name) for name in ("gazebo", "gzserver", "debug")})
_PLUGIN = re.compile(r"<plugin\b[^>]*gazebo_ros_control.{0,2000}?(?:</plugin>|/>)", re.DOTALL)
_SPACE = re.compile(r"<robotNamespace>\s*([\w/~]*)\s*</robotNamespace>")
_DESCRIPTION = "robot_description"
_KEPT = 64
_PACKAGES = (
    *("joint_state_controller", "joint_trajectory_controller", "effort_controllers", "position_controllers"),
    *("velocity_controllers", "gripper_action_controller", "diff_drive_controller", "ackermann_steering_controller"),
)
"""Of controllers that the catalogue has; that of some has another name than their package."""
_SERVICES = (
    *((name, name) for name in ("list_controllers", "list_controller_types", "load_controller", "unload_controller")),
    ("switch_controller", "switch_controller"),
    ("reload_controller_libraries", "reload_controller_libraries"),
)


def controllers_asked(launch: Launch, known: Sequence[Interface]) -> Rows | None:
    """The ends of the controllers that scripts load in the simulator. Which robots it has nobody knows before: they
    may be there."""
    tree = launch.tree
    at = next((at for at, node in enumerate(tree.nodes) if (node.package, node.executable) in _SIMULATOR), None)
    if tree.ros.own_parameters or at is None or known[at].complete:
        return None
    asked = [each for node in tree.nodes if (each := asked_of(node)) is not None]
    spaces = _spaces(tree, tree.nodes[at]) if asked else None
    found: list[Endpoint] = []
    for each in asked:
        if spaces is None or (each.namespace or "/") in spaces:
            found += _of_manager(each.namespace or "/")
            for name in map(each.full, each.controllers):
                type_ = tree.params.get(f"{name}/type")
                if type_ is not None and isinstance(type_.value, str):
                    found += _of_controller(name, type_.value, launch.environment)
    ends = {(end.role, end.name): end for end in found}
    return Rows((launch.shown({at: tuple(ends.values())}),)) if ends else None


def of_controllers(node: LaunchNode, known: Interface, ends: tuple[Endpoint, ...] | None) -> Part | None:
    """The ends of a simulator beside its own."""
    return Part("catalogue", ends) if ends else None


def _spaces(tree: LaunchTree, simulator: LaunchNode) -> set[str] | None:
    """The namespaces of the managers of all robots whose description is known; None where one is not."""
    found: set[str] = set()
    for param in tree.all_params:
        if _DESCRIPTION not in param.name.rpartition("/")[2]:
            continue
        if not isinstance(param.value, str):
            return None
        for space in _spaces_in(param.value):
            if space is None:
                return None
            found.add(names.join(simulator.namespace, space).rstrip("/") or "/")
    return found


@lru_cache(maxsize=_KEPT)
def _spaces_in(description: str) -> tuple[str | None, ...]:
    """The namespaces of the managers of a robot; None for the name that it is spawned by."""
    found = map(_SPACE.search, _PLUGIN.findall(without_comments(description)))
    return tuple(space[1] if space is not None else None for space in found)


def _of_manager(space: str) -> Iterator[Endpoint]:
    for name, kind in _SERVICES:
        type_ = f"controller_manager_msgs/{''.join(map(str.title, kind.split('_')))}"
        yield Endpoint("service", names.join(space, f"controller_manager/{name}"), type_, evidence=_EVIDENCE)


def _of_controller(name: str, type_: str, environment: Environment) -> Iterator[Endpoint]:
    distro = distribution_of(1, environment.distro)
    for package in (type_.partition("/")[0], *_PACKAGES):
        found = catalogued(package, "controllers", type_, distro, is_used=environment.distro == distro)
        if found is not None:
            for end in found.endpoints:
                yield replace(end, name=names.resolve(end.name, name), evidence=end.evidence.but("condition"))
            return
