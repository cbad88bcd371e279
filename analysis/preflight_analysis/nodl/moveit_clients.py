"""The actions that MoveIt is a client of: those of the controllers that it is told of."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.moveit import controller_params, moveit_controllers
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree, Param
from preflight_analysis.incremental.kept import Kept
from preflight_analysis.tracing.interface import Endpoint, Interface, NamedBy

_EVIDENCE = "what is known of moveit_simple_controller_manager"


def with_moveit_clients(tree: LaunchTree, interfaces: Sequence[Interface], kept: Kept) -> Sequence[Interface]:
    """The interfaces of the nodes of `tree`, in order, with the clients that the controllers of MoveIt make."""
    given = {at: params for at, node in enumerate(tree.nodes) if (params := controller_params(tree, node))}
    if not given:
        return interfaces
    found = list(interfaces)
    for at, params in given.items():
        arguments = tree.nodes[at], interfaces[at], params, tree.ros.kinds_in_types
        found[at] = kept.get(_with_clients, at, *arguments)
    return found


def _with_clients(node: LaunchNode, interface: Interface, params: tuple[Param, ...], kinds_in_types: bool) -> Interface:
    if interface.pending or interface.tells_all("actions") or interface.declared:
        return interface
    there = {(end.role, end.name) for end in interface.endpoints}
    clients = {end.name: end for end in _clients(node, params, kinds_in_types)}
    more = tuple(end for end in clients.values() if (end.role, end.name) not in there)
    if not more:
        return interface
    source = interface.source if interface.known else "catalogue"
    return replace(interface, source=source, endpoints=(*interface.endpoints, *more))


def _clients(node: LaunchNode, params: tuple[Param, ...], kinds_in_types: bool) -> Iterator[Endpoint]:
    for controller in moveit_controllers(params, node):
        type_, name = controller.action_type, controller.action
        if type_ is None or not names.is_legal(name):
            continue
        if kinds_in_types:
            type_ = type_.replace("/", "/action/")
        named_by = NamedBy(controller.param.name, controller.param.place)
        yield Endpoint("action_client", name, type_, None, {}, inferred=True, catalogued=_EVIDENCE, named_by=named_by)
