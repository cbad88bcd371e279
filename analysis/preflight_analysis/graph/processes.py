"""Processes of ROS 2 that make several nodes: each of them is a node of the graph."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from preflight_analysis.documents.document import Document
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.ros2.params import of_name
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree
from preflight_analysis.tracing.interface import Interface


def each_node(
    tree: LaunchTree, processes: Sequence[Interface], documents: Mapping[str, Document]
) -> tuple[LaunchTree, tuple[Interface, ...]]:
    """The tree with all nodes that its processes make, and the interface of each. Name, remaps and parameters that the
    launch file gives to the process count for each of them as they do for rcl.

    `processes` has an entry for each node of `tree`. The same tree where no process is known to have several.
    """
    if not any(process.names for process in processes):
        return tree, tuple(processes)
    nodes: list[LaunchNode] = []
    interfaces: list[Interface] = []
    for node, process in zip(tree.nodes, processes, strict=True):
        for name, interface in (process.apart(node.name) or {node.name: process}).items():
            nodes.append(node if name == node.name else _beside(node, name, documents))
            interfaces.append(interface)
    return replace(tree, nodes=tuple(nodes)), tuple(interfaces)


def _beside(node: LaunchNode, name: str, documents: Mapping[str, Document]) -> LaunchNode:
    """A node that the run showed in the process of a node of the launch file."""
    made = of_name(node, name, documents, inferred=False)
    if node.kind == "composable":
        # What a container gives to a component is the component's own, and no argument of the process.
        made = made._replace(params=(), param_sources=(), remaps=())
    return made._replace(namespace=names.parent(name), within=node.name)
