"""A view and its layout for the page and for editors (schema `ros-preflight/view/1`). What is referred to by number is
so by its position in the list of that name."""

from __future__ import annotations

from typing import Any

from preflight_analysis.documents.span import Place
from preflight_analysis.findings.report import relative
from preflight_analysis.view.layout import Layout
from preflight_analysis.view.model import GraphView
from preflight_analysis.view.svg import svg

SCHEMA = "ros-preflight/view/1"


def view_json(view: GraphView, layout: Layout, base: str | None) -> dict[str, Any]:
    """Everything that the page needs. Files are shown relative to the folder `base`; `state` is for what watches a
    running robot, which knows nodes and channels by their names."""
    files = view.files
    return {
        "schema": SCHEMA,
        "root": view.root,
        "title": relative(view.root, base),
        "generation": view.generation,
        "files": [{"path": path, "shown": relative(path, base)} for path in files],
        "nodes": [
            {
                "name": node.name,
                "package": node.package,
                "executable": node.executable,
                "kind": node.kind,
                "file": files.index(node.file),
                "places": [_place(place, base) for place in node.places],
                "source": node.source,
                "outcome": node.outcome,
                "reason": node.reason,
                "findings": list(node.findings),
                "state": node.state,
            }
            for node in view.nodes
        ],
        "channels": [
            {
                "kind": channel.kind,
                "name": channel.name,
                "types": list(channel.types),
                "builtin": channel.builtin,
                "external": channel.external,
                "findings": list(channel.findings),
                "notes": list(channel.notes),
                "state": channel.state,
            }
            for channel in view.channels
        ],
        "edges": [
            {
                "node": edge.node,
                "channel": edge.channel,
                "role": edge.role,
                "type": edge.type,
                "qos": dict(edge.qos),
                "from": edge.remapped_from,
                "places": [_place(place, base) for place in edge.places],
                "builtin": edge.builtin,
                "uncertain": edge.uncertain,
                "findings": list(edge.findings),
            }
            for edge in view.edges
        ],
        "findings": [
            {
                "rule": finding.rule,
                "severity": finding.severity,
                "message": finding.message,
                "place": _place(finding.place, base),
            }
            for finding in view.findings
        ],
        "width": layout.width,
        "height": layout.height,
        "boxes": [
            {"x": box.x, "y": box.y, "width": box.width, "height": box.height, "island": box.island}
            | ({} if box.namespace is None else {"frame": box.namespace})
            | ({"node": box.node} if box.node is not None else {"channels": list(box.channels)})
            for box in layout.boxes
        ],
        "routes": [
            {
                "source": route.source,
                "target": route.target,
                "island": route.island,
                "edges": list(route.edges),
                "points": [list(point) for point in route.points],
            }
            for route in layout.routes
        ],
        "frames": [
            {
                "name": frame.name,
                "x": frame.x,
                "y": frame.y,
                "width": frame.width,
                "height": frame.height,
                "island": frame.island,
                "parent": frame.parent,
                "nodes": list(frame.nodes),
            }
            for frame in layout.frames
        ],
        "islands": layout.islands,
        "svg": svg(view, layout),
    }


def _place(place: Place, base: str | None) -> dict[str, Any]:
    return {"file": place.file, "shown": relative(place.file, base), "line": place.line, "column": place.column}
