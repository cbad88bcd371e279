"""Evaluated again, a file gives objects that are mostly equal to those it gave before."""

from __future__ import annotations

from collections.abc import Container, Iterable
from dataclasses import replace
from itertools import compress
from operator import not_
from typing import TypeVar

from preflight_analysis.evaluation.tree import LaunchTree

T = TypeVar("T")


def taken_over(tree: LaunchTree, before: LaunchTree) -> LaunchTree:
    """The tree with the nodes and parameters of an earlier one where they are equal: what was kept of those is found
    again by the objects themselves."""
    # Most are the same objects anyway: to look at them is quicker than to compare them.
    same = {*map(id, before.nodes), *map(id, before.params.values())}
    nodes = {node.name: node for node in before.nodes}
    changed = {id(node) for node in _others(tree.nodes, same) if nodes.get(node.name) == node}
    params = {
        param.name: old
        for param in _others(tree.params.values(), same)
        if (old := before.params.get(param.name)) == param
    }
    if not changed and not params:
        return tree
    return replace(
        tree,
        nodes=tuple(nodes[node.name] if id(node) in changed else node for node in tree.nodes),
        params={**tree.params, **params},
    )


def _others(items: Iterable[T], same: Container[int]) -> Iterable[T]:
    """Those whose ids are not among these. Of thousands there are few: no line of Python is run for the others."""
    all_items = [*items]
    return compress(all_items, map(not_, map(same.__contains__, map(id, all_items))))
