"""The actions that MoveIt is a client of: those of the controllers that it is told of."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.moveit import is_move_group, moveit_controllers
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree
from preflight_analysis.tracing.interface import Endpoint, Interface, NamedBy

_EVIDENCE = "what is known of moveit_simple_controller_manager"


def with_moveit_clients(tree: LaunchTree, interfaces: Sequence[Interface]) -> Sequence[Interface]:
    """The interfaces of the nodes of `tree`, in order, with the clients that the controllers of MoveIt make."""
    at = [at for at, node in enumerate(tree.nodes) if is_move_group(node)]
    if not at:
        return interfaces
    found = list(interfaces)
    for each in at:
        found[each] = _with_clients(tree, tree.nodes[each], interfaces[each])
    return found


def _with_clients(tree: LaunchTree, node: LaunchNode, interface: Interface) -> Interface:
    if interface.pending or interface.known_in_full or interface.declared:
        return interface
    there = {(end.role, end.name) for end in interface.endpoints}
    more = tuple(end for end in _clients(tree, node) if (end.role, end.name) not in there)
    if not more:
        return interface
    source = interface.source if interface.known else "catalogue"
    return replace(interface, source=source, endpoints=(*interface.endpoints, *more))


def _clients(tree: LaunchTree, node: LaunchNode) -> Iterator[Endpoint]:
    seen = set[str]()
    for controller in moveit_controllers(tree, node):
        type_, name = controller.action_type, controller.action
        if type_ is None or name in seen or not names.is_legal(name):
            continue
        seen.add(name)
        if tree.ros.kinds_in_types:
            type_ = type_.replace("/", "/action/")
        named_by = NamedBy(controller.param.name, controller.param.place)
        yield Endpoint("action_client", name, type_, None, {}, inferred=True, catalogued=_EVIDENCE, named_by=named_by)
