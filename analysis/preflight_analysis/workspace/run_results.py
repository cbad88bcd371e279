"""What is known of the runs of the nodes of a launch, and the analysis that it makes: for server and command line."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field

from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.tracing.interface import PENDING, Interface
from preflight_analysis.workspace.not_run import not_run
from preflight_analysis.workspace.workspace import Analysis, Workspace

NOT_ASKED_FOR = "it was not asked for"

NodeKey = tuple[str, int]
"""A node's full name and, since names may clash, how many of that name come before it."""


@dataclass(frozen=True, slots=True)
class RunResults:
    """`why_not_run`: why no node is run, None where they are. `pending`: those that have no interface yet will get
    one; else nobody asked for them."""

    interfaces: Mapping[NodeKey, Interface] = field(default_factory=dict)
    why_not_run: str | None = None
    pending: bool = False


def node_keys(tree: LaunchTree) -> list[NodeKey]:
    """The keys of the nodes of a tree, in order."""
    names = [node.name for node in tree.nodes]
    if len({*names}) == len(names):
        return [(name, 0) for name in names]
    seen: Counter[str] = Counter()
    keys = []
    for node in tree.nodes:
        keys.append((node.name, seen[node.name]))
        seen[node.name] += 1
    return keys


def with_results(
    workspace: Workspace, static: Analysis, results: RunResults, previous: Analysis | None = None
) -> Analysis:
    """The static analysis with what is known of its nodes. While the first runs are under way it says nothing of the
    graph. `previous` is what was known of the same root before: what has not changed since is taken over."""
    known, why = results.interfaces, results.why_not_run
    if results.pending and why is None and not known and any(r is not None for r in workspace.requests(static)):
        return static
    tree = static.tree
    reason = why or (PENDING if results.pending else NOT_ASKED_FOR)
    keys = node_keys(tree)
    interfaces = [known.get(key) or not_run(node, reason) for key, node in zip(keys, tree.nodes, strict=True)]
    # Where earlier runs tell of some, those that were not run say so themselves.
    return workspace.with_interfaces(static, interfaces, None if any(key in known for key in keys) else why, previous)
