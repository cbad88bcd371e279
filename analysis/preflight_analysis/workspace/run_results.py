"""What is known of the runs of the nodes of a launch: for server and command line."""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Mapping
from dataclasses import field

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.incremental.query import Input
from preflight_analysis.model.context import ExecutableNames
from preflight_analysis.tracing.interface import PENDING, Interface
from preflight_analysis.workspace.components import Containers
from preflight_analysis.workspace.index import Root
from preflight_analysis.workspace.not_run import not_run

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

    @property
    def awaited(self) -> bool:
        """Whether the first runs are under way, and nothing is known yet."""
        return self.pending and self.why_not_run is None and not self.interfaces

    def of(self, tree: LaunchTree, executables: ExecutableNames) -> tuple[list[Interface], str | None]:
        """The interfaces of the nodes of a tree, in order, and why none of them was run, None where one was."""
        known, why = self.interfaces, self.why_not_run
        reason = why or (PENDING if self.pending else NOT_ASKED_FOR)
        containers = Containers(tree, executables)
        if not known:
            return [not_run(node, executables, reason, containers) for node in tree.nodes], why
        keys = node_keys(tree)
        pairs = zip(keys, tree.nodes, strict=True)
        interfaces = [known.get(key) or not_run(node, executables, reason, containers) for key, node in pairs]
        # Where earlier runs tell of some, those that were not run say so themselves.
        return interfaces, None if any(key in known for key in keys) else why


def _none_yet(workspace: Hashable, root: Root) -> RunResults:
    return RunResults()


RESULTS = Input(_none_yet, durable=False)
"""What runs have told so far of the nodes of a root."""


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
