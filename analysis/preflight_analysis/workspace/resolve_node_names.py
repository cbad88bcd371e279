"""Nodes of ROS 2 that the launch file does not name, under the names that their own code gives them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from preflight_analysis.documents.document import Document
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.meanings import KnownMeanings
from preflight_analysis.evaluation.ros2.params import of_name
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree
from preflight_analysis.tracing.interface import Interface


def resolve_node_names(
    tree: LaunchTree, interfaces: Sequence[Interface], documents: Mapping[str, Document], known: KnownMeanings
) -> LaunchTree:
    """The tree with the real names where a run or the source told them, or the knowledge of a package; the same one
    where there is nothing to change."""
    if not tree.ros.nodes_name_themselves or all(node.named for node in tree.nodes):
        return tree
    changed = False
    nodes = list(tree.nodes)
    for at, (node, interface) in enumerate(zip(tree.nodes, interfaces, strict=True)):
        name = _own_name(node, interface, known)
        if name is not None:
            inferred = not interface.nodes or any(each.evidence.inferred for each in interface.nodes)
            nodes[at] = of_name(node, name, documents, inferred=inferred)
            changed = True
    return replace(tree, nodes=tuple(nodes)) if changed else tree


def _own_name(node: LaunchNode, interface: Interface, known: KnownMeanings) -> str | None:
    if node.named or node.name_from_code or node.unknowns or node.kind not in ("node", "lifecycle", "composable"):
        return None
    if interface.nodes or not interface.known:
        return interface.own_name(node.namespace, node.name)
    said = known.of_node(node)
    return names.join(node.namespace, said.entry.node) if said is not None and said.entry.node else None
