"""What the parameters of the nodes of a launch stand for, as rules ask for it."""

from __future__ import annotations

from collections.abc import Sequence

from preflight_analysis.evaluation.meanings import (
    Known,
    KnownMeanings,
    Meant,
    known_of_nodes,
    meant_of_node,
    params_of_nodes,
)
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree, Param
from preflight_analysis.incremental.derived import derived
from preflight_analysis.incremental.kept import Kept
from preflight_analysis.model.context import Context

NodeMeant = tuple[LaunchNode, tuple[Meant, ...]]
"""A node, and the values of its parameters that stand for something, defaults among them."""


@derived
def meant_values(context: Context) -> tuple[NodeMeant, ...]:
    """Those of all nodes of which something is known, in a graph of those within processes, too."""
    return meant_in(context.graph.tree if context.graph is not None else context.tree, context.known, context.kept)


def meant_in(tree: LaunchTree, every: KnownMeanings, kept: Kept) -> tuple[NodeMeant, ...]:
    """Likewise of any launch."""
    known = known_of_nodes(tree, every, kept)
    columns = tree.nodes_and_simulated, known, params_of_nodes(tree, known, kept)
    return tuple(each for each in kept.each_row(_of_node, columns, every) if each is not None)


def _of_node(node: LaunchNode, known: Known | None, given: Sequence[Param], every: KnownMeanings) -> NodeMeant | None:
    return (node, meant_of_node(node, known, given, every)) if known is not None else None
