"""The layout of boxes and lines by graphlay, in a process of its own.

graphlay (https://github.com/aarkue/graphlay) draws in layers, with lines that go around boxes. It keeps Python's lock
while it works, a second for a large graph, in which the server would answer nothing; a process can also be given up
after a while. It gets numbers only, no names.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Sequence
from importlib.util import find_spec
from threading import Timer
from typing import Any

from preflight_analysis.dataclass import dataclass

PATIENCE = 30.0
"""Seconds after which a graph is too large for a careful layout."""
PADDING = 24.0
"""Pixels between the border of a box and the boxes in it: above them there is room for a name."""
_CAREFUL = 160
"""Up to this many boxes the better, slower ways are taken."""
_PROGRAM = """
import json, sys
sys.path.append(sys.argv[1])
import graphlay
for line in sys.stdin:
    given = json.loads(line)
    sys.stdout.write(graphlay.layout(given["graph"], options=given["options"]).to_json() + "\\n")
    sys.stdout.flush()
"""
_SPACING = {
    "layer_gap": 44.0,
    "node_gap": 18.0,
    "dummy_gap": 10.0,
    "port_gap": 7.0,
    "stub": 9.0,
    "isolated_gap": 18.0,
    "isolated_max_columns": 6,
    "compound_padding": PADDING,
    # Where the first in a box is a box, the engine makes no room for a header.
    "compound_header": 0.0,
}
Point = tuple[float, float]
Size = tuple[float, float]


class EngineError(Exception):
    """The engine does not do it. The text says why."""


@dataclass(frozen=True, slots=True)
class Places:
    """The upper left corner and the size of each box, and the points of each line, none of them negative."""

    size: Size
    corners: tuple[Point, ...]
    sizes: tuple[Size, ...]
    routes: tuple[tuple[Point, ...], ...]


class Engine:
    """A process that lays out one graph after the other, started with the first of them."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[str] | None = None
        self._timer: Timer | None = None
        self._gave_up = False

    def __enter__(self) -> Engine:
        return self

    def __exit__(self, *_: object) -> None:
        if self._timer is not None:
            self._timer.cancel()
        if self._process is not None:
            self._process.kill()
            self._process.communicate()

    def place(self, sizes: Sequence[Size], lines: Sequence[tuple[int, int]], parents: Sequence[int | None]) -> Places:
        """Boxes of these sizes, with lines between them by position. A box that is the parent of others is as large as
        they need it, and no end of a line. Raises `EngineError`."""
        try:
            return _read(self._ask(_request(sizes, lines, parents)), len(sizes), len(lines))
        except (OSError, ValueError, KeyError, TypeError) as error:
            raise EngineError(f"it took more than {PATIENCE:g} s" if self._gave_up else str(error)) from error

    def _ask(self, request: str) -> Any:
        if self._process is None:
            self._process = _start()
            self._timer = Timer(PATIENCE, self._give_up)
            self._timer.daemon = True
            self._timer.start()
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(request + "\n")
        self._process.stdin.flush()
        return json.loads(self._process.stdout.readline())

    def _give_up(self) -> None:
        self._gave_up = True
        if self._process is not None:
            self._process.kill()


def _start() -> subprocess.Popen[str]:
    # Isolated, so that nothing of the folder that we were started in is imported, and told where graphlay is: it may be
    # among the user's own packages.
    found = find_spec("graphlay")
    if found is None or found.origin is None:
        raise OSError("graphlay is not installed")
    return subprocess.Popen(
        [sys.executable, "-I", "-c", _PROGRAM, os.path.dirname(os.path.dirname(found.origin))],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )


def _request(sizes: Sequence[Size], lines: Sequence[tuple[int, int]], parents: Sequence[int | None]) -> str:
    nodes: list[dict[str, Any]] = [
        {"size": {"width": width, "height": height}, "shape": "box"} for width, height in sizes
    ]
    for node, parent in zip(nodes, parents, strict=True):
        if parent is not None:
            node["parent"] = parent
    return json.dumps(
        {
            "graph": {
                "nodes": nodes,
                "edges": [{"source": source, "target": target, "weight": 1.0} for source, target in lines],
            },
            "options": {
                "effort": "balanced" if len(sizes) <= _CAREFUL else "fast",
                "cycles": {"strategy": "follow_flow"},
                "routing": {"style": "orthogonal"},
                "spacing": _SPACING,
            },
        }
    )


def _read(answer: Any, boxes: int, lines: int) -> Places:
    sizes = [(node["size"]["width"], node["size"]["height"]) for node in answer["nodes"]]
    corners = [
        (node["center"]["x"] - width / 2, node["center"]["y"] - height / 2)
        for node, (width, height) in zip(answer["nodes"], sizes, strict=True)
    ]
    routes = [[(point["x"], point["y"]) for point in edge["points"]] for edge in answer["edges"]]
    if len(corners) != boxes or len(routes) != lines or not all(len(points) > 1 for points in routes):
        raise ValueError("not every box has a place, or not every line a route")
    ends = [(x + w, y + h) for (x, y), (w, h) in zip(corners, sizes, strict=True)]
    points = [*corners, *ends, *(point for route in routes for point in route)]
    left, top = min(x for x, _ in points), min(y for _, y in points)
    right, bottom = max(x for x, _ in points), max(y for _, y in points)

    def at(point: Point) -> Point:
        return round(point[0] - left, 1), round(point[1] - top, 1)

    return Places(
        (round(right - left, 1), round(bottom - top, 1)),
        tuple(map(at, corners)),
        tuple(sizes),
        tuple(tuple(map(at, route)) for route in routes),
    )
