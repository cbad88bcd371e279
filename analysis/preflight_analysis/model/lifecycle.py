"""Whether lifecycle nodes become active: who configures and activates them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from itertools import compress
from typing import NamedTuple

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.doubt import Doubt, doubts
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context
from preflight_analysis.model.named_nodes import managed_by, missing_nodes
from preflight_analysis.model.problems import quoted
from preflight_analysis.tracing.interface import CHANGE_STATE, Interface

_KNOWN = frozenset(
    {
        ("nav2_amcl", "amcl"),
        ("nav2_behaviors", "behavior_server"),
        ("nav2_bt_navigator", "bt_navigator"),
        ("nav2_collision_monitor", "collision_monitor"),
        ("nav2_controller", "controller_server"),
        ("nav2_map_server", "costmap_filter_info_server"),
        ("nav2_map_server", "map_saver_server"),
        ("nav2_map_server", "map_server"),
        ("nav2_planner", "planner_server"),
        ("nav2_route", "route_server"),
        ("nav2_smoother", "smoother_server"),
        ("nav2_velocity_smoother", "velocity_smoother"),
        ("nav2_waypoint_follower", "waypoint_follower"),
    }
)
"""Executables that are lifecycle nodes, in every distribution, and wait to be activated."""
_LOAD = "composition_interfaces/srv/LoadNode"
_SET = re.compile(r"\blifecycle\s+set\s+(\S+)\s+(\w+)")
"""`ros2 lifecycle set /node configure`, in a shell as well."""
_SHOWN = 3
_TO_ACTIVE = ("configure", "activate")


class Inactive(NamedTuple):
    """A lifecycle node that nothing brings to the state `active`. `lacking` is the first transition of those that it
    needs that nothing asks it for, `managed` are the nodes that lifecycle managers manage, `doubts` what speaks against
    it."""

    node: LaunchNode
    lacking: str
    managed: tuple[str, ...]
    doubts: tuple[Doubt, ...]

    @property
    def reason(self) -> str:
        """What keeps it from being active, in words that go on from its name."""
        what = "never activated" if self.lacking == "configure" else "configured, but never activated"
        managers = f"the lifecycle managers manage {quoted(self.managed[:_SHOWN])}"
        who = managers if self.managed else "no lifecycle manager"
        return f"is {what} by this launch ({who}); it does nothing until it is active"


def inactive(context: Context, node: LaunchNode) -> Inactive | None:
    """What keeps a node of the launch from being active; None where nothing does, or that is not known."""
    return next((each for each in inactive_nodes(context) if each.node.name == node.name), None)


@derived
def inactive_nodes(context: Context) -> tuple[Inactive, ...]:
    """Those of a launch; none where something that is not known may activate nodes."""
    waiting = [*_waiting(context)]
    if not waiting or _others_may_act(context):
        return ()
    managed = managed_by(context)
    unknown = filter(None, context.each(_as_manager, context.tree.nodes))
    managers = {manager.name for manager in managed.values()}
    if any(node.name not in managers for node in unknown):
        return ()
    settled = managed.keys() | missing_nodes(context).meant
    changes, by_command = context.tree.state_changes, _by_commands(context)
    found = []
    for node, own in waiting:
        asked = {*own, *by_command.get(node.name, ()), *(c.transition for c in changes if c.may_be_for(node))}
        lacking = next((each for each in _TO_ACTIVE if each not in asked), None)
        if node.name not in settled and None not in asked and lacking is not None:
            found.append((node, lacking))
    # A launch of such a node alone is for somebody who activates it by hand.
    alone = len({id(node) for node, _ in found}) >= len(context.tree.nodes)
    graph = context.graph
    known = graph is not None and context.tree.complete and all(map(_is_known, graph.interfaces))
    against = doubts(OUTSIDE=not known, INTENDED=alone)
    return tuple(Inactive(node, lacking, tuple(managed), against) for node, lacking in found)


def _is_known(interface: Interface) -> bool:
    """Whether a client of the service by which states are changed would be known."""
    return interface.likely_complete or interface.source == "catalogue"


def may_be_active_by_itself(node: LaunchNode) -> bool:
    """Whether what it is given has it activated: by launch_ros, or by itself."""
    autostart = node.action.value("autostart")
    if (autostart is not None and autostart.text.lower() not in ("false", "0")) or "autostart" in node.args:
        return True
    return any(param.name in ("autostart_node", "autostart") and param.value for param in node.params)


def _waiting(context: Context) -> Iterator[tuple[LaunchNode, tuple[str, ...]]]:
    """The lifecycle nodes, each with the transitions that it makes by itself."""
    graph = context.graph
    if graph is None:
        plain = compress(context.tree.nodes, context.each(_is_said_to_wait, context.tree.nodes))
        yield from ((node, ()) for node in plain)
        return
    started = {*map(id, context.tree.nodes)}
    waits = context.each_row(_waits, (graph.tree.nodes, graph.interfaces))
    for node, interface in compress(zip(graph.tree.nodes, graph.interfaces, strict=True), waits):
        if id(node) in started or node.within is None:
            yield node, interface.transitions


def _is_said_to_wait(node: LaunchNode) -> bool:
    """Whether the launch file or its executable says that it is a lifecycle node, and nothing that it is activated."""
    said = node.kind == "lifecycle" or (node.package, node.executable) in _KNOWN
    return said and not node.unknowns and not may_be_active_by_itself(node)


def _waits(node: LaunchNode, interface: Interface) -> bool:
    if node.kind == "process" or node.unknowns or may_be_active_by_itself(node):
        return False
    types = {end.type for end in interface.endpoints}
    if _LOAD in types:
        return False  # what has a lifecycle is another node of the process
    own = names.canonicalize(f"{node.name}/change_state")
    if any(e.type == CHANGE_STATE and e.role == "service" and _full(e.name, node) == own for e in interface.endpoints):
        return True
    # `LifecycleNode` starts whatever is given to it.
    seen = interface.likely_complete and interface.source == "trace" and bool(types)
    return _is_said_to_wait(node) and not (seen or _makes_plain_nodes(interface))


def _makes_plain_nodes(interface: Interface) -> bool:
    """Whether its source, or a run, shows all nodes that the process makes, and none has a lifecycle: one that has
    offers the services of it as soon as it is made. The catalogue has no such services of any node."""
    made = [each for each in interface.nodes if not each.hidden]
    has_lifecycle = any(end.type == CHANGE_STATE and end.role == "service" for end in interface.endpoints)
    return interface.source in ("source", "trace") and bool(made) and not has_lifecycle


def _full(name: str, node: LaunchNode) -> str:
    return names.resolve(name, node.name)


def _as_manager(node: LaunchNode) -> LaunchNode | None:
    """The node, if it is a manager by its name, whatever is known of what it manages."""
    return node if node.executable == "lifecycle_manager" or "lifecycle_manager" in node.name else None


def _by_commands(context: Context) -> Mapping[str, set[str]]:
    """The transitions that command lines of the launch ask nodes for, by their full names."""
    found: dict[str, set[str]] = {}
    for node in context.tree.nodes:
        for name, transition in _SET.findall(node.args) if node.kind == "process" else ():
            found.setdefault(names.canonicalize(f"/{name}"), set()).add(transition)
    return found


def _others_may_act(context: Context) -> bool:
    """Whether something may activate nodes of which it is not known which: another command line, a client of the
    service."""
    if any(node.kind == "process" and not _SET.search(node.args) for node in context.tree.nodes):
        return True
    if context.graph is None:
        return False
    if any(interface.may_call(CHANGE_STATE) for interface in context.graph.interfaces):
        return True
    channels = context.graph.services.values()
    return any(end.endpoint.type == CHANGE_STATE for channel in channels for end in channel.consumers)
