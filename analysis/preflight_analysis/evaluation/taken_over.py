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
    """The tree with the nodes, parameters and includes of an earlier one where they are equal: what was kept of those
    is found again by the objects themselves."""
    # Most are the same objects anyway: to look at them is quicker than to compare them.
    same = {*map(id, before.nodes), *map(id, before.params.values()), *map(id, before.includes)}
    nodes = {node.name: node for node in before.nodes}
    kept_nodes = {
        id(node): known
        for node in _others(tree.nodes, same)
        if (known := nodes.get(node.name)) is not None and known == node
    }
    params = {
        param.name: before.params[param.name]
        for param in _others(tree.params.values(), same)
        if before.params.get(param.name) == param
    }
    by_place = {include.origin: include for include in before.includes}
    includes = {
        id(include): by_place[include.origin]
        for include in _others(tree.includes, same)
        if by_place.get(include.origin) == include
    }
    return replace(
        tree,
        nodes=tuple(kept_nodes.get(id(node), node) for node in tree.nodes) if kept_nodes else tree.nodes,
        params={**tree.params, **params} if params else tree.params,
        includes=tuple(includes.get(id(include), include) for include in tree.includes) if includes else tree.includes,
    )


def _others(items: Iterable[T], same: Container[int]) -> Iterable[T]:
    """Those whose ids are not among these. Of thousands there are few: no line of Python is run for the others."""
    all_items = [*items]
    return compress(all_items, map(not_, map(same.__contains__, map(id, all_items))))
