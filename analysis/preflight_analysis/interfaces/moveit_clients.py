"""The actions that MoveIt is a client of: those of the controllers that it is told of."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.moveit import controller_params, moveit_controllers
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.interfaces.part import Launch, Part, Rows
from preflight_analysis.tracing.interface import Endpoint, Evidence, Interface, NamedBy

_EVIDENCE = Evidence("catalogue", "what is known of moveit_simple_controller_manager")


def clients_asked(launch: Launch, known: Sequence[Interface]) -> Rows | None:
    """The clients that MoveIt makes for the controllers that each node is told of."""
    tree = launch.tree
    given = {at: params for at, node in enumerate(tree.nodes) if (params := controller_params(tree, node))}
    kinds = tree.ros.kinds_in_types
    found = {at: launch.kept.get(_clients, at, tree.nodes[at], params, kinds) for at, params in given.items()}
    return Rows((launch.shown(found),)) if found else None


def moveit_clients(node: LaunchNode, known: Interface, clients: tuple[Endpoint, ...] | None) -> Part | None:
    """The clients of a node of MoveIt, where it is not known which it has."""
    if not clients or known.pending or known.tells_all("actions") or known.declared:
        return None
    return Part("catalogue", clients, leads=False)


def _clients(node: LaunchNode, params: tuple[Param, ...], kinds_in_types: bool) -> tuple[Endpoint, ...]:
    return tuple({end.name: end for end in _each_client(node, params, kinds_in_types)}.values())


def _each_client(node: LaunchNode, params: tuple[Param, ...], kinds_in_types: bool) -> Iterator[Endpoint]:
    for controller in moveit_controllers(params, node):
        type_, name = controller.action_type, controller.action
        if type_ is None or not names.is_legal(name):
            continue
        if kinds_in_types:
            type_ = type_.replace("/", "/action/")
        named_by = NamedBy(controller.param.name, controller.param.place)
        yield Endpoint("action_client", name, type_, None, {}, evidence=_EVIDENCE, named_by=named_by)
