"""The frames of a launch as JSON, for `ros-preflight frames --format json`."""

from __future__ import annotations

from typing import Any

from preflight_analysis.frames.model import Edge, Frames, Use
from preflight_analysis.model.frames import frames_of, place_of_edge, place_of_use
from preflight_analysis.workspace.tree_json import place_json
from preflight_analysis.workspace.workspace import Analysis

SCHEMA = "ros-preflight/frames/1"


def frames_json(analysis: Analysis) -> dict[str, Any]:
    """`frames` has each frame with the transforms to its parents, by name; `uses` each place that names one."""
    frames = frames_of(analysis.context)
    return {
        "schema": SCHEMA,
        "file": analysis.root,
        "frames": [
            _frame(frames, space, name, analysis) for space in frames.spaces for name in sorted(frames.names(space))
        ],
        "uses": [_use(frames, use, analysis) for use in frames.uses],
        "gaps": list(frames.gaps),
    }


def _frame(frames: Frames, space: str, name: str, analysis: Analysis) -> dict[str, Any]:
    edges = frames.parents(space).get(name, ())
    return {
        "frame": name,
        "topic": f"{space}/tf",
        "root": frames.root(space, name),
        "parents": [_edge(edge, analysis) for edge in edges],
    }


def _edge(edge: Edge, analysis: Analysis) -> dict[str, Any]:
    return {
        "parent": edge.parent,
        "static": edge.static,
        "node": edge.node.name if edge.node is not None else None,
        "how": edge.how,
        "detail": edge.detail,
        "sure": edge.sure,
        "catalogue": edge.catalogued or None,
        **place_json(place_of_edge(analysis.context, edge), analysis.all_documents),
    }


def _use(frames: Frames, use: Use, analysis: Analysis) -> dict[str, Any]:
    return {
        "frame": use.written,
        "topic": f"{use.space}/tf",
        "node": use.node.name,
        "what": use.what,
        "looked_up": use.looked_up,
        "published": use.frame in frames.names(use.space),
        **place_json(place_of_use(analysis.context, use), analysis.all_documents),
    }
