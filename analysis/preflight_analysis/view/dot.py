"""The view in Graphviz' language, https://graphviz.org/doc/info/lang.html."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.findings.finding import Severity
from preflight_analysis.findings.printable import printable
from preflight_analysis.view.model import TOWARDS_CHANNEL, GraphView, Kind

_SHAPES: dict[Kind, str] = {"topic": "ellipse", "service": "diamond", "action": "cds"}
_COLOURS: dict[Severity | None, str] = {"error": "#d1242f", "warning": "#b86e00", "info": "#1a73d9"}
_PLAIN = "#667085"


def dot(view: GraphView) -> str:
    """A digraph; findings are tooltips and colours. Ends with a newline."""
    return "\n".join(_lines(view)) + "\n"


def _lines(view: GraphView) -> Iterator[str]:
    yield "digraph ros {"
    yield "  rankdir=LR;"
    yield '  node [fontname="sans-serif", fontsize=11];'
    for i, node in enumerate(view.nodes):
        style = "rounded,dashed" if node.source == "none" else "rounded"
        yield f'  n{i} [shape=box, style="{style}", label={_quoted(node.name)}{_marks(view, node.findings)}];'
    for i, channel in enumerate(view.channels):
        shape = _SHAPES[channel.kind]
        yield f"  c{i} [shape={shape}, label={_quoted(channel.name)}{_marks(view, channel.findings)}];"
    for edge in view.edges:
        ends = f"n{edge.node}", f"c{edge.channel}"
        source, target = ends if edge.role in TOWARDS_CHANNEL else reversed(ends)
        dashed = "style=dashed, " if edge.uncertain else ""
        yield f"  {source} -> {target} [{dashed}edgetooltip={_quoted(edge.type or '')}{_marks(view, edge.findings)}];"
    yield "}"


def _marks(view: GraphView, findings: tuple[int, ...]) -> str:
    colour = _COLOURS.get(view.severity(findings), _PLAIN)
    said = "; ".join(f"{view.findings[i].rule} {view.findings[i].message}" for i in findings)
    return f', color="{colour}", tooltip={_quoted(said)}' if said else f', color="{colour}"'


def _quoted(text: str) -> str:
    r"""A quoted string. A backslash would begin an escape such as `\N`."""
    escaped = printable(text).replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'
