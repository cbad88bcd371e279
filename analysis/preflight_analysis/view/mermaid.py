"""The view as a Mermaid flow chart, which GitHub and GitLab draw in Markdown: https://mermaid.js.org/syntax/flowchart.html.

They draw no chart of more than 500 edges.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from preflight_analysis.findings.printable import printable
from preflight_analysis.view.model import TOWARDS_CHANNEL, GraphView, Kind

_SHAPES: dict[Kind, tuple[str, str]] = {"topic": ("([", "])"), "service": ("{{", "}}"), "action": ("[/", "/]")}
_PLAIN = frozenset("/_-. :~,()'")
_STYLES = {
    "error": "stroke:#d1242f,stroke-width:2px",
    "warning": "stroke:#b86e00,stroke-width:2px",
    "info": "stroke:#1a73d9",
}


def mermaid(view: GraphView) -> str:
    """A flow chart; edges of findings are coloured. Ends with a newline."""
    return "\n".join(_lines(view)) + "\n"


def _lines(view: GraphView) -> Iterator[str]:
    yield "flowchart LR"
    for i, node in enumerate(view.nodes):
        yield f"  n{i}[{_quoted(node.name)}]"
    for i, channel in enumerate(view.channels):
        begin, end = _SHAPES[channel.kind]
        yield f"  c{i}{begin}{_quoted(channel.name)}{end}"
    styled: dict[str, list[int]] = {}
    for i, edge in enumerate(view.edges):
        ends = f"n{edge.node}", f"c{edge.channel}"
        source, target = ends if edge.role in TOWARDS_CHANNEL else reversed(ends)
        yield f"  {source} {'-.->' if edge.uncertain else '-->'} {target}"
        severity = view.severity(edge.findings)
        if severity is not None and severity in _STYLES:
            styled.setdefault(severity, []).append(i)
    for name, edges in styled.items():
        yield f"  linkStyle {_listed(edges)} {_STYLES[name]}"


def _listed(numbers: Iterable[int]) -> str:
    return ",".join(map(str, numbers))


def _quoted(text: str) -> str:
    """A quoted text. Whatever could be syntax, HTML or Markdown is written as an entity."""
    return '"' + "".join(c if c.isalnum() or c in _PLAIN else f"#{ord(c)};" for c in printable(text)) + '"'
