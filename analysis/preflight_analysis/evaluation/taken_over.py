"""Evaluated again, a file gives objects that are mostly equal to those it gave before."""

from __future__ import annotations

from dataclasses import replace

from preflight_analysis.evaluation.tree import LaunchTree


def taken_over(tree: LaunchTree, before: LaunchTree) -> LaunchTree:
    """The tree with the nodes and parameters of an earlier one where they are equal: what was kept of those is found
    again by the objects themselves."""
    # Most are the same objects anyway: to look at them is quicker than to compare them.
    same = set(map(id, before.nodes)) | set(map(id, before.params.values()))
    nodes = {node.name: node for node in before.nodes}
    changed = {at: node for at, node in enumerate(tree.nodes) if id(node) not in same and nodes.get(node.name) == node}
    params = {
        name: before.params[name]
        for name, param in tree.params.items()
        if id(param) not in same and before.params.get(name) == param
    }
    if not changed and not params:
        return tree
    return replace(
        tree,
        nodes=tuple(nodes[node.name] if at in changed else node for at, node in enumerate(tree.nodes)),
        params={**tree.params, **params},
    )
