"""The picture as one page that needs nothing else, and may fetch nothing else."""

from __future__ import annotations

import base64
import hashlib
import json
from collections.abc import Mapping
from html import escape
from importlib.resources import files
from typing import Any

from preflight_analysis.findings.report import printable, relative
from preflight_analysis.view.layout import lay_out
from preflight_analysis.view.model import GraphView
from preflight_analysis.view.svg import drawing_style
from preflight_analysis.view.view_json import view_json


def graph_page(view: GraphView, base: str | None) -> str:
    """The page of a graph, with and without what every node has by its client library."""
    plain = view.without_builtin()
    has_builtin = len(plain.edges) < len(view.edges)
    data = {
        "plain": view_json(plain, lay_out(plain), base),
        "builtin": view_json(view, lay_out(view), base) if has_builtin else None,
    }
    return _page(f"{relative(view.root, base)} – ROS graph", data)


def _page(title: str, data: Mapping[str, Any]) -> str:
    """Only the scripts and styles of the page itself count, known by their digests: no name can add another one."""
    drawing, style, script = drawing_style(), _part("view.css"), _part("view.js")
    policy = (
        f"default-src 'none'; style-src {_digest(drawing)} {_digest(style)}; script-src {_digest(script)}; "
        "base-uri 'none'; form-action 'none'"
    )
    parts = {
        "POLICY": policy,
        "TITLE": escape(printable(title)),
        "NONCE": "",
        "DRAWING": drawing,
        "STYLE": style,
        "SCRIPT": script,
        "DATA": _script_json(data),
    }
    first, *rest = _part("page.html").split("%")
    # `%NAME%` at every other place: what is put in is not looked at again.
    return first + "".join(parts[text] if i % 2 == 0 else text for i, text in enumerate(rest))


def _part(name: str) -> str:
    return files(__package__).joinpath("page").joinpath(name).read_text(encoding="utf-8")


def _digest(text: str) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


def _script_json(data: Mapping[str, Any]) -> str:
    """JSON in which nothing ends the script element or begins a comment."""
    text = json.dumps(data, sort_keys=True)
    return text.replace("&", "\\u0026").replace("<", "\\u003c").replace(">", "\\u003e")
