"""Processes of ROS 2 that make several nodes: each of them is a node of the graph."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from preflight_analysis.documents.document import Document
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.ros2.containers import container_of, containers_of
from preflight_analysis.evaluation.ros2.params import of_name
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree
from preflight_analysis.tracing.interface import Interface


def each_node(
    tree: LaunchTree, processes: Sequence[Interface], documents: Mapping[str, Document]
) -> tuple[LaunchTree, tuple[Interface, ...]]:
    """The tree with all nodes that its processes make, and the interface of each. Name, remaps and parameters that the
    launch file gives to the process count for each of them as they do for rcl: not for those that take their own alone.
    For the component of a container they are the container's.

    `processes` has an entry for each node of `tree`. The same tree where no process is known to have several.
    """
    if not any(process.names for process in processes) and not any(map(_takes_arguments, tree.nodes)):
        return tree, tuple(processes)
    containers = containers_of(tree.nodes)
    nodes: list[LaunchNode] = []
    interfaces: list[Interface] = []
    for node, process in zip(tree.nodes, processes, strict=True):
        container = container_of(node, containers) if node.kind == "composable" else None
        for name, interface in (process.apart(node.name) or {node.name: process}).items():
            if name == node.name:
                nodes.append(_with_arguments_of(container, node, documents) if _takes_arguments(node) else node)
            else:
                alone = all(made.own_arguments_only for made in interface.nodes)
                given = container if node.kind == "composable" else node
                nodes.append(_beside(node, name, None if alone else given, documents))
            interfaces.append(interface)
    return replace(tree, nodes=tuple(nodes)), tuple(interfaces)


def _takes_arguments(node: LaunchNode) -> bool:
    """Whether a component is told to take the arguments of its container's process after its own."""
    return any(each.name == "forward_global_arguments" and each.value is True for each in node.extra_arguments)


def _with_arguments_of(container: LaunchNode | None, node: LaunchNode, documents: Mapping[str, Document]) -> LaunchNode:
    if container is None:
        return node
    given = of_name(container, node.name, documents, inferred=False)
    own = {param.name for param in node.params}
    return node._replace(
        params=(*node.params, *(param for param in given.params if param.name not in own)),
        param_sources=(*given.param_sources, *node.param_sources),
        remaps=(*node.remaps, *given.remaps),
    )


def _beside(node: LaunchNode, name: str, given_by: LaunchNode | None, documents: Mapping[str, Document]) -> LaunchNode:
    """A node that the run showed in the process of a node of the launch file. `given_by` is whose arguments those of
    the process are, where they count for it."""
    made = of_name(node, name, documents, inferred=False)
    if given_by is None:
        made = made._replace(params=(), param_sources=(), remaps=())
    elif given_by is not node:
        given = of_name(given_by, name, documents, inferred=False)
        made = made._replace(params=given.params, param_sources=given.param_sources, remaps=given.remaps)
    return made._replace(namespace=names.parent(name), within=node.name)
