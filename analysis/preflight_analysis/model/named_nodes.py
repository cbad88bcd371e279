"""Other nodes that the parameters and arguments of nodes name, by what is known of packages."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from preflight_analysis.documents.span import Location, Origin
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.meanings import Meant
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context
from preflight_analysis.model.meant import meant_values
from preflight_analysis.model.nearest import nearest
from preflight_analysis.model.places import argument_location

MANAGED = "managed"
"""The role of a node whose lifecycle the other one manages."""
_MAX_TYPOS = 20
"""So many names are not all misspelt; to compare each with each node would take long."""


class NamedNode(NamedTuple):
    """A name of another node as `node` has it among its parameters or arguments, and what that is in full."""

    node: LaunchNode
    meant: Meant
    name: str

    @property
    def is_managed(self) -> bool:
        """Whether the node manages the lifecycle of the other one."""
        return self.meant.meaning.role == MANAGED

    @property
    def origin(self) -> Origin:
        """What sets it."""
        return self.meant.param.origin if self.meant.param is not None else self.node.origin

    def location(self, context: Context) -> Location:
        """Where it is set."""
        param = self.meant.param
        return param.place if param is not None else argument_location(context, self.node, self.meant.value)


@derived
def named_nodes(context: Context) -> tuple[NamedNode, ...]:
    """All of a launch."""
    return tuple(
        NamedNode(node, meant, names.resolve(meant.value, node.name))
        for node, values in meant_values(context)
        for meant in values
        if meant.meaning.kind == "node" and isinstance(meant.value, str) and names.is_legal(meant.value) and meant.value
    )


class MissingNodes(NamedTuple):
    """Named nodes that the launch does not have, the first of each name and role, with the near name of one that
    nobody names."""

    each: Sequence[tuple[NamedNode, str | None]]

    @property
    def meant(self) -> frozenset[str]:
        """The near names."""
        return frozenset(near for _, near in self.each if near is not None)


@derived
def missing_nodes(context: Context) -> MissingNodes:
    """Those of a launch. A node may have something below its name that is no node, such as a server of
    dynamic_reconfigure: that is not missing."""
    if not named_nodes(context):
        return MissingNodes(())
    tree = context.graph.tree if context.graph is not None else context.tree
    there = {node.name for node in (*context.tree.nodes, *tree.nodes_and_simulated) if node.kind != "process"}
    first: dict[tuple[str, bool], NamedNode] = {}
    for named in named_nodes(context):
        if named.name not in there and (named.is_managed or not _is_below(named.name, there)):
            first.setdefault((named.name, named.is_managed), named)
    unnamed = {node.name for node in context.tree.nodes if node.kind != "process"}
    unnamed.difference_update(named.name for named in named_nodes(context))
    few = len(first) <= _MAX_TYPOS
    return MissingNodes([(each, nearest(each.name, unnamed) if few else None) for each in first.values()])


def _is_below(name: str, there: set[str]) -> bool:
    above = names.parent(name).rstrip("/")
    return bool(above) and (above in there or _is_below(above, there))


def managed_by(context: Context) -> Mapping[str, LaunchNode]:
    """The nodes whose lifecycle another node manages, by their full names."""
    return {named.name: named.node for named in named_nodes(context) if named.is_managed}
