"""LCH035: a lifecycle node that nothing activates (ROS 2)."""

from collections.abc import Iterator
from itertools import compress

from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.further_reading import LIFECYCLE, LIFECYCLE_MANAGER
from preflight_analysis.rules.named_nodes import managed_by, missing_nodes
from preflight_analysis.rules.places import attribute_location
from preflight_analysis.rules.problems import include_chain, quoted
from preflight_analysis.rules.rule import Context, Rule
from preflight_analysis.tracing.interface import Interface

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
_CHANGE = "lifecycle_msgs/srv/ChangeState"
_LOAD = "composition_interfaces/srv/LoadNode"
_ACTING = frozenset({"event_handler", "emit_event", "opaque", "opaque_coroutine", "function", "timer"})


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    nodes = context.tree.nodes
    inactive = [*filter(None, context.kept.each(_as_waiting, nodes))]
    if not inactive:
        return
    managed = managed_by(context)
    managers = {manager.name for manager in managed.values()}
    unknown = [*filter(None, context.kept.each(_as_manager, nodes))]
    listed = all(node.name in managers for node in unknown)
    settled = managed.keys() | context.once(missing_nodes).meant | _without_lifecycle(context)
    waiting = [node for node in inactive if node.name not in settled]
    if not waiting or not listed or _others_may_act(context):
        return
    # A launch of such a node alone is for somebody who activates it by hand.
    alone = len(waiting) < len(nodes) and context.graph is not None and context.graph.likely_complete
    for node in waiting:
        who = f"the lifecycle managers manage {quoted(list(managed)[:3])}" if managed else "no lifecycle manager"
        yield rule.finding(
            f"lifecycle node {node.name} is never activated by this launch ({who}); it does nothing until it is active",
            attribute_location(context, node, "exec"),
            severity="warning" if alone else None,
            confidence="likely" if context.tree.complete else "possible",
            related=include_chain(node.origin),
        )


def _as_manager(node: LaunchNode) -> LaunchNode | None:
    """The node, if it is a manager by its name, whatever is known of what it manages."""
    return node if node.executable == "lifecycle_manager" or "lifecycle_manager" in node.name else None


def _as_waiting(node: LaunchNode) -> LaunchNode | None:
    return node if _waits(node) else None


def _waits(node: LaunchNode) -> bool:
    if node.unknowns or not (node.kind == "lifecycle" or (node.package, node.executable) in _KNOWN):
        return False
    autostart = node.action.value("autostart")
    if (autostart is not None and autostart.text.lower() not in ("false", "0")) or "autostart" in node.args:
        return False
    return not any(param.name in ("autostart_node", "autostart") and param.value for param in node.params)


def _without_lifecycle(context: Context) -> set[str]:
    """Nodes that are known not to have one, though a `LifecycleNode` of the launch file starts them: nobody can ask for
    another state, or they are managers of components, and what has a lifecycle is another node of theirs."""
    graph = context.graph
    if graph is None:
        return set()
    without = context.kept.each(_has_no_lifecycle, graph.interfaces)
    return {node.name for node in compress(graph.tree.nodes, without)}


def _has_no_lifecycle(interface: Interface) -> bool:
    types = {end.type for end in interface.endpoints}
    # The source does not show what the base class of a lifecycle node offers.
    seen = interface.likely_complete and interface.source == "trace"
    return bool(seen and types and _CHANGE not in types) or _LOAD in types


def _others_may_act(context: Context) -> bool:
    """Whether something else may activate nodes: handlers of events, code, a command line, a client of the service."""
    if any(node.kind == "process" for node in context.tree.nodes):
        return True
    services = context.graph.services.values() if context.graph is not None else ()
    if any(end.endpoint.type == _CHANGE for channel in services for end in channel.consumers):
        return True
    roots = (file.root for file in context.launch_files.values() if file.root is not None)
    return any(action.kind in _ACTING for root in roots for action in root.walk())


RULE = Rule(
    id="LCH035",
    name="lifecycle-not-activated",
    severity="info",
    what="Checks for a lifecycle node, such as a server of Nav2, that no `lifecycle_manager` of the launch has in "
    "its `node_names`. The finding is a warning if all nodes are known and none can activate another. Handlers of "
    "events, timers and commands may activate the node: then there is no finding.",
    why="A lifecycle node starts unconfigured. It publishes nothing and serves only its state changes until another "
    "node configures and activates it.",
    example='<node pkg="nav2_map_server" exec="map_server" name="map_server"/>',
    instead='<node pkg="nav2_map_server" exec="map_server" name="map_server"/>\n'
    '<node pkg="nav2_lifecycle_manager" exec="lifecycle_manager" name="lifecycle_manager_map">\n'
    '  <param name="autostart" value="true"/>\n  <param name="node_names" value="[map_server]"/>\n</node>',
    references=(
        LIFECYCLE,
        LIFECYCLE_MANAGER,
    ),
    settings=("nodes",),
    generations=(2,),
    check=_check,
    every_root=True,
)
