"""The picture itself, which the command writes and the page and editors show."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from math import hypot
from xml.sax.saxutils import escape, quoteattr

from preflight_analysis.findings.finding import Severity
from preflight_analysis.findings.printable import printable
from preflight_analysis.findings.report import relative
from preflight_analysis.view.labels import columns, label
from preflight_analysis.view.layout import (
    MARGIN,
    NODE_HEIGHT,
    ROW_HEIGHT,
    STACK_PADDING,
    Box,
    Frame,
    Layout,
    channel_text,
    node_texts,
)
from preflight_analysis.view.model import TOWARDS_CHANNEL, GraphView, Kind, ViewChannel, ViewNode
from preflight_analysis.view.page_parts import part

COLOURS = 6
"""How many launch files have a colour of their own; the next one begins anew. An editor's tree has as many."""
_CORNER = 6.0
_ARROW = 7.0
_ICONS: dict[Kind, str] = {
    "topic": '<circle class="icon" cx="14" cy="10" r="4"/>',
    "service": '<path class="icon" d="M14 5l5 5-5 5-5-5z"/>',
    "action": '<path class="icon" d="M10 5l9 5-9 5z"/>',
}
Point = tuple[float, float]


def svg(view: GraphView, layout: Layout) -> str:
    """The picture without its style, for a page that has it. Nothing in it can run, whatever the names are."""
    return _document(view, layout, layout.height, layout.width, "", "")


def standalone_svg(view: GraphView, layout: Layout, base: str | None) -> str:
    """The picture as a file: with a legend and its style, light or dark as the reader's system is."""
    legend, height, width = _legend(view, layout.width, base)
    foot = f'<g transform="translate(0 {layout.height:g})">{legend}</g>' if legend else ""
    style = f"<style>{part('drawing.css')}</style>"
    return _document(view, layout, layout.height + height, max(layout.width, width), style, foot)


def _document(view: GraphView, layout: Layout, height: float, width: float, head: str, foot: str) -> str:
    extent = f"{max(width, 1):g} {max(height, 1):g}".split()
    return "".join(
        (
            '<svg xmlns="http://www.w3.org/2000/svg" class="graph" role="group" '
            f"aria-label={_attribute('the graph of ' + relative_name(view.root))} "
            f'width="{extent[0]}" height="{extent[1]}" viewBox="0 0 {extent[0]} {extent[1]}">',
            head,
            '<rect class="paper" width="100%" height="100%"/><g class="frames">',
            *(_frame(view, i, frame) for i, frame in enumerate(layout.frames)),
            '</g><g class="routes">',
            *(_route(view, i, route.points, route.edges) for i, route in enumerate(layout.routes)),
            '</g><g class="boxes">',
            *_boxes(view, layout),
            "</g>",
            foot,
            "</svg>",
        )
    )


def relative_name(path: str) -> str:
    """The name of a file without its folders."""
    return path.rpartition("/")[2]


def _frame(view: GraphView, index: int, frame: Frame) -> str:
    """A namespace. The page folds it; what is in it is not among its elements."""
    nodes = f"{len(frame.nodes)} nodes"
    severity = view.severity(finding for node in frame.nodes for finding in view.nodes[node].findings)
    return (
        f'<g class="{_classes("namespace", severity)}" data-frame="{index}" '
        f'transform="translate({frame.x:g} {frame.y:g})" '
        f"aria-label={_attribute(f'namespace {frame.name}, {nodes}')}>"
        f'<rect class="frame" width="{frame.width:g}" height="{frame.height:g}" rx="8"/>'
        f'<path class="fold" d="M8 7h8l-4 5z"/>'
        f'<text class="name" x="21" y="14">{escape(label(frame.name))}</text>'
        f'<text class="count" x="21" y="30">{nodes}</text></g>'
    )


def _boxes(view: GraphView, layout: Layout) -> Iterator[str]:
    colours = {file: i for i, file in enumerate(view.files)}
    lone = _with_one_side(view)
    for i, box in enumerate(layout.boxes):
        place = f'data-box="{i}" transform="translate({box.x:g} {box.y:g})"'
        frame = None if box.namespace is None else layout.frames[box.namespace]
        if box.node is not None:
            node = view.nodes[box.node]
            yield _node(node, colours[node.file], box, frame, place, view.severity(node.findings))
        else:
            yield f'<g class="stack" {place}>{_paper(box, 10)}'
            for row, channel in enumerate(box.channels):
                found = view.channels[channel]
                dangling = channel in lone and not found.external
                severity = view.severity(found.findings)
                yield _channel(found, box, row, frame, severity, dangling=dangling)
            yield "</g>"


def _with_one_side(view: GraphView) -> set[int]:
    """The channels of which only one side is there."""
    towards = {edge.channel for edge in view.edges if edge.role in TOWARDS_CHANNEL}
    return towards ^ {edge.channel for edge in view.edges if edge.role not in TOWARDS_CHANNEL}


def _paper(box: Box, radius: int) -> str:
    return f'<rect class="box" width="{box.width:g}" height="{box.height:g}" rx="{radius}"/>'


def _node(node: ViewNode, file: int, box: Box, frame: Frame | None, place: str, severity: Severity | None) -> str:
    name, what = node_texts(node, frame)
    known = "" if node.source != "none" else "unknown"
    middle = box.width / 2 + 8
    accent = f"M5 0h11v{NODE_HEIGHT:g}h-11a5 5 0 0 1-5-5v-{NODE_HEIGHT - 10:g}a5 5 0 0 1 5-5z"
    return (
        f'<g class="{_classes("node", severity, known, f"state-{node.state}")}" data-node="{box.node}" {place} '
        f"aria-label={_attribute(_said('node ' + node.name, severity))}>{_paper(box, 5)}"
        f'<path class="accent f{file % COLOURS}" d="{accent}"/>'
        f'<text class="file" x="8" y="24" text-anchor="middle">{file + 1}</text>'
        f'<text class="name" x="{middle:g}" y="17" text-anchor="middle">{escape(name)}</text>'
        f'<text class="what" x="{middle:g}" y="32" text-anchor="middle">{escape(what)}</text>'
        f"{_badge(severity, box.width)}</g>"
    )


def _channel(
    channel: ViewChannel, box: Box, row: int, frame: Frame | None, severity: Severity | None, *, dangling: bool
) -> str:
    marks = _classes("external" if channel.external else "", "dangling" if dangling else "")
    return (
        f'<g class="{_classes("channel", channel.kind, severity, marks, f"state-{channel.state}")}" '
        f'data-channel="{box.channels[row]}" transform="translate(0 {STACK_PADDING + row * ROW_HEIGHT:g})" '
        f"aria-label={_attribute(_said(f'{channel.kind} {channel.name}', severity))}>"
        f'<rect class="row" x="3" width="{box.width - 6:g}" height="{ROW_HEIGHT:g}" rx="7"/>{_ICONS[channel.kind]}'
        f'<text x="25" y="14">{escape(channel_text(channel, frame))}</text></g>'
    )


def _badge(severity: Severity | None, width: float) -> str:
    """A mark on the corner, so that what is wrong is not told by colour alone."""
    if severity in (None, "hint"):
        return ""
    x = width - 2
    return f'<g class="badge {severity}"><circle cx="{x:g}" cy="2" r="7"/><path d="M{x:g} -2v5m0 2v1"/></g>'


def _said(what: str, severity: Severity | None) -> str:
    return what if severity is None else f"{what}, {severity}"


def _route(view: GraphView, index: int, points: Sequence[Point], edges: Iterable[int]) -> str:
    of = [view.edges[i] for i in edges]
    severity = view.severity(finding for edge in of for finding in edge.findings)
    unsure = "uncertain" if all(edge.uncertain for edge in of) else ""
    kind = view.channels[of[0].channel].kind
    line, arrow = outline(points)
    return (
        f'<g class="{_classes("route", kind, severity, unsure)}" data-route="{index}">'
        f'<path class="wide" d="{line}"/><path class="line" d="{line}"/><path class="arrow" d="{arrow}"/></g>'
    )


def outline(points: Sequence[Point]) -> tuple[str, str]:
    """The paths of a line with rounded corners, and of the arrow at its end. The page does the same in `outline.js`."""
    (x, y), tip = points[-2], points[-1]
    length = hypot(tip[0] - x, tip[1] - y) or 1.0
    dx, dy = (tip[0] - x) / length, (tip[1] - y) / length
    neck = (tip[0] - dx * min(_ARROW, length), tip[1] - dy * min(_ARROW, length))
    steps = [f"M{_at(points[0])}"]
    for before, corner, after in zip(points, points[1:], (*points[2:-1], neck), strict=False):
        first, last = _towards(corner, before), _towards(corner, after)
        steps.append(f"L{_at(first)}Q{_at(corner)} {_at(last)}")
    steps.append(f"L{_at(neck)}")
    half = _ARROW / 2
    sides = (neck[0] - dy * half, neck[1] + dx * half), (neck[0] + dy * half, neck[1] - dx * half)
    return "".join(steps), f"M{_at(tip)}L{_at(sides[0])}L{_at(sides[1])}z"


def _towards(corner: Point, other: Point) -> Point:
    length = hypot(other[0] - corner[0], other[1] - corner[1]) or 1.0
    part = min(_CORNER, length / 2) / length
    return corner[0] + (other[0] - corner[0]) * part, corner[1] + (other[1] - corner[1]) * part


def _at(point: Point) -> str:
    return f"{round(point[0], 1):g} {round(point[1], 1):g}"


def _legend(view: GraphView, width: float, base: str | None) -> tuple[str, float, float]:
    """What the signs and colours stand for, as wide as the picture where that is possible; how high and wide it is."""
    signs: list[tuple[str, float, str]] = []
    for kind in dict.fromkeys(channel.kind for channel in view.channels):
        signs.append((f'<g class="channel {kind}" transform="translate(-9 0)">{_ICONS[kind]}</g>', 16, kind))
    starting = {node.file for node in view.nodes}
    for i, file in enumerate(view.files):
        if file in starting:
            accent = (
                f'<rect class="accent f{i % COLOURS}" x="0" y="3" width="14" height="14" rx="3"/>'
                f'<text class="file" x="7" y="14" text-anchor="middle">{i + 1}</text>'
            )
            signs.append((accent, 20, label(relative(file, base), 48)))
    for severity in ("error", "warning", "info"):
        if any(view.severity(edge.findings) == severity for edge in view.edges):
            signs.append((f'<g class="route {severity}"><path class="line" d="M0 10h18"/></g>', 24, severity))
    if not signs:
        return "", 0, 0
    parts: list[str] = []
    x, y, right = MARGIN, 0.0, 0.0
    for sign, before, text in signs:
        taken = before + columns(text) * 6.7
        if x > MARGIN and x + taken > width - MARGIN:
            x, y = MARGIN, y + 22
        caption = f'<text x="{before:g}" y="14">{escape(text)}</text>'
        parts.append(f'<g transform="translate({x:g} {y:g})">{sign}{caption}</g>')
        right = max(right, x + taken + MARGIN)
        x += taken + 22
    return f'<g class="legend">{"".join(parts)}</g>', y + 44, right


def _classes(*names: str | None) -> str:
    return " ".join(filter(None, names))


def _attribute(text: str) -> str:
    return quoteattr(printable(text))
