"""The layout of boxes and lines by graphlay, in a process of its own.

graphlay (https://github.com/aarkue/graphlay) draws in layers, with lines that go around boxes. It keeps Python's lock
while it works, a second for a large graph, in which the server would answer nothing; a process can also be given up
after a while. It gets numbers only, no names.
"""

from __future__ import annotations

import json
import logging
import os
import subprocess
import sys
from collections.abc import Sequence
from importlib.util import find_spec
from typing import Any

from preflight_analysis.dataclass import dataclass

_log = logging.getLogger(__name__)

PATIENCE = 30.0
"""Seconds after which a graph is too large for a careful layout."""
_CAREFUL = 160
"""Up to this many boxes the better, slower ways are taken."""
_PROGRAM = """
import json, sys
sys.path.append(sys.argv[1])
import graphlay
given = json.load(sys.stdin)
sys.stdout.write(graphlay.layout(given["graph"], options=given["options"]).to_json())
"""
_SPACING = {
    "layer_gap": 44.0,
    "node_gap": 18.0,
    "dummy_gap": 10.0,
    "port_gap": 7.0,
    "stub": 9.0,
    "isolated_gap": 18.0,
    "isolated_max_columns": 6,
}
Point = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Places:
    """The upper left corner of each box, and the points of each line, none of them negative."""

    width: float
    height: float
    corners: tuple[Point, ...]
    routes: tuple[tuple[Point, ...], ...]


def place(sizes: Sequence[tuple[float, float]], lines: Sequence[tuple[int, int]]) -> Places:
    """Boxes of these sizes, and lines between them by position, in the order in which they are given. Where the engine
    does not do it, the boxes stand in columns and the lines are straight."""
    if not sizes:
        return Places(0, 0, (), ())
    try:
        return _read(_ask(sizes, lines), sizes, len(lines))
    except (OSError, subprocess.SubprocessError, ValueError, KeyError, TypeError) as error:
        why = f"it takes more than {PATIENCE:g} s" if isinstance(error, subprocess.TimeoutExpired) else error
        _log.warning("the graph is laid out in columns only: %s", why)
        return _columns(sizes, lines)


def _ask(sizes: Sequence[tuple[float, float]], lines: Sequence[tuple[int, int]]) -> Any:
    careful = len(sizes) <= _CAREFUL
    request = {
        "graph": {
            "nodes": [{"size": {"width": width, "height": height}, "shape": "box"} for width, height in sizes],
            "edges": [{"source": source, "target": target, "weight": 1.0} for source, target in lines],
        },
        "options": {
            "effort": "balanced" if careful else "fast",
            "cycles": {"strategy": "follow_flow"},
            "routing": {"style": "orthogonal"},
            "spacing": _SPACING,
        },
    }
    # Isolated, so that nothing of the folder that we were started in is imported, and told where graphlay is: it may be
    # among the user's own packages.
    found = find_spec("graphlay")
    if found is None or found.origin is None:
        raise OSError("graphlay is not installed")
    done = subprocess.run(
        [sys.executable, "-I", "-c", _PROGRAM, os.path.dirname(os.path.dirname(found.origin))],
        input=json.dumps(request),
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=True,
    )
    return json.loads(done.stdout)


def _read(answer: Any, sizes: Sequence[tuple[float, float]], lines: int) -> Places:
    corners = [
        (node["center"]["x"] - width / 2, node["center"]["y"] - height / 2)
        for node, (width, height) in zip(answer["nodes"], sizes, strict=True)
    ]
    routes = [[(point["x"], point["y"]) for point in edge["points"]] for edge in answer["edges"]]
    if len(routes) != lines or not all(len(points) > 1 for points in routes):
        raise ValueError("not every line has a route")
    return _moved(corners, routes, sizes)


def _moved(corners: Sequence[Point], routes: Sequence[Sequence[Point]], sizes: Sequence[tuple[float, float]]) -> Places:
    """All of it moved to where nothing is negative."""
    ends = [(x + w, y + h) for (x, y), (w, h) in zip(corners, sizes, strict=True)]
    points = [*corners, *ends, *(point for route in routes for point in route)]
    left, top = min(x for x, _ in points), min(y for _, y in points)
    right, bottom = max(x for x, _ in points), max(y for _, y in points)

    def at(point: Point) -> Point:
        return round(point[0] - left, 1), round(point[1] - top, 1)

    return Places(
        round(right - left, 1),
        round(bottom - top, 1),
        tuple(map(at, corners)),
        tuple(tuple(map(at, route)) for route in routes),
    )


def _columns(sizes: Sequence[tuple[float, float]], lines: Sequence[tuple[int, int]]) -> Places:
    """Without an engine: columns of boxes as they come, straight lines."""
    rows = max(1, round(len(sizes) ** 0.5))
    gap, corners = _SPACING["layer_gap"], list[Point]()
    x = 0.0
    for first in range(0, len(sizes), rows):
        y = 0.0
        for _, height in sizes[first : first + rows]:
            corners.append((x, y))
            y += height + gap
        x += max(width for width, _ in sizes[first : first + rows]) + gap
    centres = [(x + w / 2, y + h / 2) for (x, y), (w, h) in zip(corners, sizes, strict=True)]
    return _moved(corners, [(centres[source], centres[target]) for source, target in lines], sizes)
