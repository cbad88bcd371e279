"""The frames of a launch as trees, to be shown."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from preflight_analysis.dataclass import dataclass
from preflight_analysis.frames.model import Edge, Frames

_DEEPEST = 100
"""Robots have some twenty joints in a row; whoever writes more than this sees the rest no more."""


@dataclass(frozen=True, slots=True)
class Branch:
    """A frame with those below it. `edges` are the transforms to it, none for a root; where they have several parents
    it is below the first one alone."""

    frame: str
    edges: tuple[Edge, ...]
    children: tuple[Branch, ...]


def forest(frames: Frames, space: str) -> tuple[Branch, ...]:
    """The trees of a space, the largest first."""
    parents, below = frames.parents(space), dict[str, dict[str, None]]()
    for child, edges in parents.items():
        below.setdefault(edges[0].parent, {})[child] = None
    roots = dict.fromkeys(edge.parent for edge in frames.edges if edge.space == space and edge.parent not in parents)
    met: set[str] = set()
    trees = [_branch(root, parents, below, met, 0) for root in roots]
    # What is left are circles, each of which is shown from the frame that is named first.
    trees += [_branch(child, parents, below, met, 0) for child in parents if child not in met]
    return tuple(sorted(trees, key=_size, reverse=True))


def _branch(
    frame: str,
    parents: Mapping[str, Sequence[Edge]],
    below: Mapping[str, Mapping[str, None]],
    met: set[str],
    depth: int,
) -> Branch:
    met.add(frame)
    inside = [each for each in below.get(frame, ()) if each not in met] if depth < _DEEPEST else []
    children = tuple(_branch(each, parents, below, met, depth + 1) for each in inside if each not in met)
    return Branch(frame, tuple(parents.get(frame, ())), children)


def branches(trees: Sequence[Branch], depth: int = 0) -> Iterator[tuple[int, Branch]]:
    """All branches from above, each with how deep it is."""
    for tree in trees:
        yield depth, tree
        yield from branches(tree.children, depth + 1)


def _size(tree: Branch) -> int:
    return sum(1 for _ in branches((tree,)))
