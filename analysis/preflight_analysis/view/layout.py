"""Where the parts of a picture stand: nodes and stacks of channels in layers from left to right.

Channels that the same nodes use in the same way share one box, a row each: a camera's thirty topics that nobody
subscribes to are one table, not thirty boxes with an edge each.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import islice

from preflight_analysis.dataclass import dataclass
from preflight_analysis.view import engine
from preflight_analysis.view.labels import columns, label
from preflight_analysis.view.model import TOWARDS_CHANNEL, GraphView, ViewChannel, ViewNode

NODE_HEIGHT = 40.0
ROW_HEIGHT = 20.0
STACK_PADDING = 4.0
MARGIN = 24.0
_NAME_WIDTH = 7.3
"""Of a column of a node's name, in pixels."""
_SMALL_WIDTH = 6.7
"""Of a column of all else."""
_MAX_ROWS = 12


@dataclass(frozen=True, slots=True)
class Box:
    """What stands in one place, by position in the view: a node, or channels, a row each. `x` and `y` are the upper
    left corner."""

    x: float
    y: float
    width: float
    height: float
    node: int | None
    channels: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True)
class Route:
    """A line from box to box, in the direction in which messages go, and the edges of the view that it stands for."""

    source: int
    target: int
    edges: tuple[int, ...]
    points: tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True)
class Layout:
    """A picture's extent and what is where in it."""

    width: float
    height: float
    boxes: tuple[Box, ...]
    routes: tuple[Route, ...]


def node_texts(node: ViewNode) -> tuple[str, str]:
    """The two lines of a node's box."""
    return label(node.name), label("/".join(filter(None, (node.package, node.executable))))


def channel_text(channel: ViewChannel) -> str:
    """The text of a channel's row."""
    return label(channel.name)


def lay_out(view: GraphView) -> Layout:
    """Places for all that is in the view. Takes a moment for a large one: not for an event loop."""
    boxes = [_node_box(i, node) for i, node in enumerate(view.nodes)]
    stacks = _stacks(view)
    at = {channel: len(boxes) + i for i, stack in enumerate(stacks) for channel in stack}
    boxes += [_stack_box(view, stack) for stack in stacks]
    lines: dict[tuple[int, int], list[int]] = {}
    for i, edge in enumerate(view.edges):
        ends = (edge.node, at[edge.channel])
        lines.setdefault(ends if edge.role in TOWARDS_CHANNEL else ends[::-1], []).append(i)
    places = engine.place([(box.width, box.height) for box in boxes], list(lines))
    routes = zip(lines.items(), places.routes, strict=True)
    return Layout(
        places.width + 2 * MARGIN,
        places.height + 2 * MARGIN,
        tuple(
            Box(x + MARGIN, y + MARGIN, box.width, box.height, box.node, box.channels)
            for box, (x, y) in zip(boxes, places.corners, strict=True)
        ),
        tuple(
            Route(*ends, tuple(edges), tuple((x + MARGIN, y + MARGIN) for x, y in points))
            for (ends, edges), points in routes
        ),
    )


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


def _node_box(index: int, node: ViewNode) -> Box:
    name, what = node_texts(node)
    width = max(columns(name) * _NAME_WIDTH, columns(what) * _SMALL_WIDTH, 60) + 28
    return Box(0, 0, round(width), NODE_HEIGHT, index)


def _stack_box(view: GraphView, stack: tuple[int, ...]) -> Box:
    width = max(columns(channel_text(view.channels[i])) for i in stack) * _SMALL_WIDTH + 34
    return Box(0, 0, round(width), len(stack) * ROW_HEIGHT + 2 * STACK_PADDING, None, stack)
