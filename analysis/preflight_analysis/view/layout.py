"""Where the parts of a picture stand: nodes and stacks of channels in layers from left to right, in the boxes of their
namespaces; what nothing connects stands side by side.

Channels that the same nodes use in the same way share one box, a row each: a camera's thirty topics that nobody
subscribes to are one table, not thirty boxes with an edge each.
"""

from __future__ import annotations

import logging
from collections.abc import Iterable, Sequence
from itertools import islice

from preflight_analysis.dataclass import dataclass
from preflight_analysis.view.engine import Engine, EngineError
from preflight_analysis.view.labels import columns, label
from preflight_analysis.view.model import TOWARDS_CHANNEL, GraphView, ViewChannel, ViewNode
from preflight_analysis.view.namespaces import Namespace, namespace_of, namespaces
from preflight_analysis.view.placing import Piece, joined, place

_log = logging.getLogger(__name__)

NODE_HEIGHT = 40.0
ROW_HEIGHT = 20.0
STACK_PADDING = 4.0
MARGIN = 24.0
_NAME_WIDTH = 7.3
"""Of a column of a node's name, in pixels."""
_SMALL_WIDTH = 6.7
"""Of a column of all else."""
_MAX_ROWS = 12
_COLUMN_GAP = 44.0
_INSET = 5.0
"""Pixels by which a frame is smaller than its room: the engine leaves none between that and what is beside it."""


@dataclass(frozen=True, slots=True)
class Box:
    """What stands in one place, by position in the view: a node, or channels, a row each. `x` and `y` are the upper
    left corner. `namespace` is the innermost one of the layout that it stands in."""

    x: float
    y: float
    width: float
    height: float
    island: int
    namespace: int | None
    node: int | None
    channels: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True)
class Route:
    """A line from box to box, in the direction in which messages go, and the edges of the view that it stands for."""

    source: int
    target: int
    island: int
    edges: tuple[int, ...]
    points: tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True)
class Frame:
    """The box around what is in a namespace and what only its nodes use. `parent` is the position of the one around
    it, which comes before it."""

    name: str
    x: float
    y: float
    width: float
    height: float
    island: int
    parent: int | None
    nodes: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Layout:
    """A picture's extent and what is where in it. `islands` is how many parts there are that nothing connects."""

    width: float
    height: float
    boxes: tuple[Box, ...]
    routes: tuple[Route, ...]
    frames: tuple[Frame, ...]
    islands: int


def node_texts(node: ViewNode, namespace: Namespace | Frame | None) -> tuple[str, str]:
    """The two lines of a node's box."""
    return label(_within(node.name, namespace)), label("/".join(filter(None, (node.package, node.executable))))


def channel_text(channel: ViewChannel, namespace: Namespace | Frame | None) -> str:
    """The text of a channel's row."""
    return label(_within(channel.name, namespace))


def _within(name: str, namespace: Namespace | Frame | None) -> str:
    """A name without what the box around it says."""
    return name if namespace is None else name.removeprefix(f"{namespace.name}/")


def lay_out(view: GraphView) -> Layout:
    """Places for all that is in the view. Takes a moment for a large one: not for an event loop."""
    stacks = _stacks(view)
    try:
        return _laid_out(view, stacks, namespaces(view))
    except EngineError as error:
        _log.warning("the graph is laid out in columns only: %s", error)
        return _in_columns(view, stacks)


def _lines(view: GraphView, stacks: Sequence[tuple[int, ...]]) -> dict[tuple[int, int], list[int]]:
    """The edges by the boxes that they lead from and to."""
    at = {channel: len(view.nodes) + i for i, stack in enumerate(stacks) for channel in stack}
    lines: dict[tuple[int, int], list[int]] = {}
    for i, edge in enumerate(view.edges):
        ends = (edge.node, at[edge.channel])
        lines.setdefault(ends if edge.role in TOWARDS_CHANNEL else ends[::-1], []).append(i)
    return lines


def _laid_out(view: GraphView, stacks: Sequence[tuple[int, ...]], spaces: Sequence[Namespace]) -> Layout:
    lines = _lines(view, stacks)
    users: list[set[int]] = [{i} for i in range(len(view.nodes))] + [set() for _ in stacks]
    for source, target in lines:
        node, channels = min(source, target), max(source, target)
        users[channels].add(node)
    group_of = [namespace_of(spaces, nodes) for nodes in users]
    around = [None if group is None else spaces[group] for group in group_of]
    sizes = _sizes(view, stacks, around)
    with Engine() as engine:
        islands = place(engine, sizes, list(lines), group_of, [space.parent for space in spaces])
    placed, extent = joined(islands)
    corners = {box: (corner, i) for i, island in enumerate(placed) for box, corner in island.corners.items()}
    frames = {at: (*found, i) for i, island in enumerate(placed) for at, found in island.around.items()}
    return Layout(
        extent[0] + 2 * MARGIN,
        extent[1] + 2 * MARGIN,
        tuple(
            _box(view, stacks, at, corners[at], size, group)
            for at, (size, group) in enumerate(zip(sizes, group_of, strict=True))
        ),
        tuple(_routes(lines, placed)),
        tuple(
            Frame(
                space.name,
                x + MARGIN + _INSET,
                y + MARGIN + _INSET,
                width - 2 * _INSET,
                height - 2 * _INSET,
                island,
                space.parent,
                space.nodes,
            )
            for space, ((x, y), (width, height), island) in ((space, frames[at]) for at, space in enumerate(spaces))
        ),
        len(placed),
    )


def _sizes(
    view: GraphView, stacks: Sequence[tuple[int, ...]], around: Sequence[Namespace | None]
) -> list[tuple[float, float]]:
    nodes = [_node_size(node, space) for node, space in zip(view.nodes, around, strict=False)]
    rest = around[len(view.nodes) :]
    return [*nodes, *(_stack_size(view, stack, space) for stack, space in zip(stacks, rest, strict=True))]


def _box(
    view: GraphView,
    stacks: Sequence[tuple[int, ...]],
    at: int,
    corner: tuple[tuple[float, float], int],
    size: tuple[float, float],
    namespace: int | None,
) -> Box:
    (x, y), island = corner
    is_node = at < len(view.nodes)
    channels = () if is_node else stacks[at - len(view.nodes)]
    return Box(x + MARGIN, y + MARGIN, *size, island, namespace, at if is_node else None, channels)


def _routes(lines: dict[tuple[int, int], list[int]], islands: Sequence[Piece]) -> Iterable[Route]:
    found = {line: (points, i) for i, island in enumerate(islands) for line, points in island.routes.items()}
    for i, (ends, edges) in enumerate(lines.items()):
        points, island = found[i]
        yield Route(*ends, island, tuple(edges), tuple((x + MARGIN, y + MARGIN) for x, y in points))


def _in_columns(view: GraphView, stacks: Sequence[tuple[int, ...]]) -> Layout:
    """Without an engine: columns of boxes as they come, straight lines."""
    sizes = _sizes(view, stacks, [None] * (len(view.nodes) + len(stacks)))
    rows = max(1, round(len(sizes) ** 0.5))
    boxes = list[Box]()
    x, height = MARGIN, 0.0
    for first in range(0, len(sizes), rows):
        y = MARGIN
        column = range(first, min(first + rows, len(sizes)))
        for at in column:
            boxes.append(_box(view, stacks, at, ((x - MARGIN, y - MARGIN), 0), sizes[at], None))
            y += sizes[at][1] + _COLUMN_GAP
        x += max(sizes[at][0] for at in column) + _COLUMN_GAP
        height = max(height, y)
    middles = [(box.x + box.width / 2, box.y + box.height / 2) for box in boxes]
    routes = [
        Route(source, target, 0, tuple(edges), (middles[source], middles[target]))
        for (source, target), edges in _lines(view, stacks).items()
    ]
    return Layout(x + MARGIN, height + MARGIN, tuple(boxes), tuple(routes), (), 1)


def _stacks(view: GraphView) -> list[tuple[int, ...]]:
    """The channels that share a box: those of one kind with the same ends, of which the same is wrong."""
    ends: dict[int, set[object]] = {}
    for edge in view.edges:
        ends.setdefault(edge.channel, set()).add((edge.node, edge.role, edge.uncertain, view.severity(edge.findings)))
    alike: dict[object, list[int]] = {}
    for i, channel in enumerate(view.channels):
        key = (channel.kind, channel.builtin, channel.external, frozenset(ends.get(i, ())))
        alike.setdefault(key, []).append(i)
    return [chunk for found in alike.values() for chunk in _chunks(found)]


def _chunks(rows: Sequence[int]) -> Iterable[tuple[int, ...]]:
    iterator = iter(rows)
    return iter(lambda: tuple(islice(iterator, _MAX_ROWS)), ())


def _node_size(node: ViewNode, namespace: Namespace | None) -> tuple[float, float]:
    name, what = node_texts(node, namespace)
    width = max(columns(name) * _NAME_WIDTH, columns(what) * _SMALL_WIDTH, 60) + 36
    return round(width), NODE_HEIGHT


def _stack_size(view: GraphView, stack: tuple[int, ...], namespace: Namespace | None) -> tuple[float, float]:
    width = max(columns(channel_text(view.channels[i], namespace)) for i in stack) * _SMALL_WIDTH + 34
    return round(width), len(stack) * ROW_HEIGHT + 2 * STACK_PADDING
