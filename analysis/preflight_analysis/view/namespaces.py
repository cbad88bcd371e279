"""Which parts of a graph stand in which namespace."""

from __future__ import annotations

from collections.abc import Sequence

from preflight_analysis.dataclass import dataclass
from preflight_analysis.view.model import GraphView


@dataclass(frozen=True, slots=True)
class Namespace:
    """A namespace with several nodes. `parent` is the position of the one around it."""

    name: str
    parent: int | None
    nodes: tuple[int, ...]


def namespaces(view: GraphView) -> tuple[Namespace, ...]:
    """Those of at least two nodes, outer before inner; of several with the same nodes the innermost. One of all nodes
    would say nothing of any."""
    nodes: dict[str, list[int]] = {}
    for i, node in enumerate(view.nodes):
        name = node.name
        while (name := name.rpartition("/")[0]) != "":
            nodes.setdefault(name, []).append(i)
    innermost: dict[tuple[int, ...], str] = {}
    for name in sorted(nodes):
        if 1 < len(nodes[name]) < len(view.nodes):
            innermost[tuple(nodes[name])] = name
    found: list[Namespace] = []
    at: dict[str, int] = {}
    for of, name in sorted(innermost.items(), key=lambda each: each[1]):
        parent = name.rpartition("/")[0]
        while parent and parent not in at:
            parent = parent.rpartition("/")[0]
        at[name] = len(found)
        found.append(Namespace(name, at.get(parent), of))
    return tuple(found)


def namespace_of(found: Sequence[Namespace], nodes: set[int]) -> int | None:
    """The innermost namespace with all of these nodes, by its position."""
    # Of two that have them all, one is in the other and comes after it.
    return max((i for i, each in enumerate(found) if nodes.issubset(each.nodes)), default=None)
