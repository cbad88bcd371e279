"""The picture as one page that needs nothing else."""

from __future__ import annotations

import json
from collections.abc import Mapping
from html import escape
from typing import Any

from preflight_analysis.findings.printable import printable
from preflight_analysis.findings.report import relative
from preflight_analysis.view.layout import lay_out
from preflight_analysis.view.model import GraphView
from preflight_analysis.view.page_parts import part, policy, script, template
from preflight_analysis.view.view_json import view_json


def graph_page(view: GraphView, base: str | None) -> str:
    """The page of a graph, with and without what every node has by its client library."""
    plain = view.without_builtin()
    has_builtin = len(plain.edges) < len(view.edges)
    data = {
        "plain": view_json(plain, lay_out(plain), base),
        "builtin": view_json(view, lay_out(view), base) if has_builtin else None,
    }
    drawing, style, code = part("drawing.css"), part("view.css"), script("view.js")
    return template(
        "page.html",
        {
            "POLICY": policy((drawing, style), (code,)),
            "TITLE": escape(printable(f"{relative(view.root, base)} – ROS graph")),
            "NONCE": "",
            "DRAWING": drawing,
            "STYLE": style,
            "SCRIPT": code,
            "DATA": _script_json(data),
        },
    )


def _script_json(data: Mapping[str, Any]) -> str:
    """JSON in which nothing ends the script element or begins a comment."""
    text = json.dumps(data, sort_keys=True)
    return text.replace("&", "\\u0026").replace("<", "\\u003c").replace(">", "\\u003e")
