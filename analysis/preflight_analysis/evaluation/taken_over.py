"""Evaluated again, a file gives objects that are mostly equal to those it gave before."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import compress
from operator import is_not, not_
from typing import TypeVar

from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree

T = TypeVar("T")


def taken_over(tree: LaunchTree, before: LaunchTree) -> LaunchTree:
    """The tree with the nodes, parameters and includes of an earlier one where they are equal: what was kept of those
    is found again by the objects themselves.

    Parts of a launch (`Database.part_answered`) are such objects already, but what is wrong in itself is no part: a
    node whose package is not found is evaluated anew at each edit.
    """
    # Most are the same objects anyway: to look at them is quicker than to compare them.
    kept_nodes: dict[int, LaunchNode] = {}
    if new_nodes := _others(tree.nodes, before.nodes):
        nodes = {node.name: node for node in before.nodes}
        kept_nodes = {
            id(node): known for node in new_nodes if (known := nodes.get(node.name)) is not None and known == node
        }
    params = {
        param.name: before.params[param.name]
        for param in _others(tree.all_params, before.all_params)
        if before.params.get(param.name) == param
    }
    by_place = {include.origin: include for include in before.includes}
    includes = {
        id(include): by_place[include.origin]
        for include in _others(tree.includes, before.includes)
        if by_place.get(include.origin) == include
    }
    return replace(
        tree,
        nodes=tuple(kept_nodes.get(id(node), node) for node in tree.nodes) if kept_nodes else tree.nodes,
        params={**tree.params, **params} if params else tree.params,
        includes=tuple(includes.get(id(include), include) for include in tree.includes) if includes else tree.includes,
    )


def _others(items: Sequence[T], before: Sequence[T]) -> list[T]:
    """Those that are not among the objects of before. Of thousands there are few: no line of Python is run for the
    others."""
    if len(items) == len(before):
        items = [*compress(items, map(is_not, items, before))]
    if not items:
        return []
    same = {*map(id, before)}
    return [*compress(items, map(not_, map(same.__contains__, map(id, items))))]
