"""The coordinate frame under the cursor: who publishes it, its path to the root, who uses it."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.evaluation.rviz import rviz_config_of
from preflight_analysis.findings.markdown import code, escaped
from preflight_analysis.frames.edges import plain
from preflight_analysis.frames.model import Edge, Frames
from preflight_analysis.model.context import Context
from preflight_analysis.model.frames import frames_of, place_of_edge, place_of_mention, place_of_use
from preflight_analysis.model.name_index import mentions_in
from preflight_analysis.queries.hover_text import Hover
from preflight_analysis.queries.places import place
from preflight_analysis.queries.query_context import QueryContext
from preflight_analysis.robot.sources import Attribute, place_of
from preflight_analysis.workspace.workspace import Analysis

_SHOWN = 8
_BELOW = 12
_PATH = 12
"""Frames of a path that are listed."""


@dataclass(frozen=True, slots=True)
class FrameSymbol:
    """A frame that is named at `span` of a file, in one root."""

    analysis: Analysis
    frame: str
    space: str
    span: Span


def frame_at(analyses: Sequence[Analysis], file: str, offset: int) -> FrameSymbol | None:
    """The frame that is named at `offset`: in the value of a parameter, or in the arguments of a static transform."""
    for analysis in analyses:
        for frame, space, named in _named_in(analysis, file):
            if named.span.contains(offset):
                return FrameSymbol(analysis, frame, space, named.span)
    return None


def _named_in(analysis: Analysis, file: str) -> Iterator[tuple[str, str, Location]]:
    """The frames that a file names, each with its place."""
    context, frames = analysis.context, frames_of(analysis.context)
    for use in frames.uses:
        if use.param is not None and use.param.place.file == file:
            found = place_of_use(context, use)
            if context.text(found) == use.written:
                yield use.frame, use.space, found
    for mention in frames.mentions:
        if mention.param.place.file == file:
            found = place_of_mention(context, mention)
            if plain(context.text(found)) == mention.frame:
                yield mention.frame, mention.space, found
    for edge in frames.edges:
        if edge.how == "arguments" and edge.location.file == file:
            yield from ((frame, edge.space, found) for frame, found in _in_arguments(analysis, edge))


def _in_arguments(analysis: Analysis, edge: Edge) -> Iterator[tuple[str, Location]]:
    """The frames in the arguments of a static transform publisher."""
    span = edge.node.tag.span_of("args") if edge.node is not None else None
    document = analysis.documents.get(edge.location.file)
    if span is None or document is None:
        return
    for frame in (edge.parent, edge.child):
        written = re.compile(rf"(?<![\w/.-])/?{re.escape(frame)}(?![\w/.-])")
        if (found := written.search(document.text, span.start, span.end)) is not None:
            yield frame, document.location(Span(*found.span()))


def published_at(context: QueryContext, symbol: FrameSymbol) -> tuple[Location, ...]:
    """Where the frame is published: the link of a robot description and its joint, a line of a node's source, a node, a
    parameter."""
    return tuple(dict.fromkeys(place for edge in _edges(symbol) for place in _places(context, symbol, edge)))


def _places(context: QueryContext, symbol: FrameSymbol, edge: Edge) -> Iterator[Location]:
    rules = symbol.analysis.context
    if edge.source_file:
        yield context.line(edge.source_file, edge.source_line)
        return
    if edge.how == "urdf" and edge.robot is not None and not edge.catalogued:
        # What `frame_prefix` puts before it is no part of the link's name.
        link = next((each for each in edge.robot.description.links if symbol.frame.endswith(each)), "")
        found = place_of(edge.robot, rules.disk, rules.environment, Attribute("link", "name", link)) if link else None
        yield from (found,) if found is not None else ()
    yield place_of_edge(rules, edge)


def named_at(symbol: FrameSymbol) -> tuple[Location, ...]:
    """The other places that name it: parameters and nodes that use it."""
    context, frames = symbol.analysis.context, frames_of(symbol.analysis.context)
    mine = (symbol.frame, symbol.space)
    uses = (place_of_use(context, use) for use in frames.uses if (use.frame, use.space) == mine)
    mentions = (place_of_mention(context, each) for each in frames.mentions if (each.frame, each.space) == mine)
    in_rviz = _in_rviz(context, symbol.frame) if not symbol.space else ()
    return tuple(dict.fromkeys((*uses, *mentions, *in_rviz)))


def _in_rviz(context: Context, frame: str) -> Iterator[Location]:
    """Where the configurations of RViz that the launch starts name a frame."""
    for path in dict.fromkeys(filter(None, map(rviz_config_of, context.tree.nodes))):
        document = context.documents.get(path)
        for entry, span, _ in mentions_in(context.disk.db, path) if document is not None else ():
            if document is not None and entry.kind == "frame" and plain(entry.text) == frame:
                yield document.location(span)


def _edges(symbol: FrameSymbol) -> Sequence[Edge]:
    """The transforms to it; of a root those from it."""
    frames = frames_of(symbol.analysis.context)
    to = frames.parents(symbol.space).get(symbol.frame, ())
    return to or [each for each in frames.edges if each.space == symbol.space and each.parent == symbol.frame]


def frame_hover(analyses: Sequence[Analysis], file: str, offset: int) -> Hover | None:
    """The hover of the frame at `offset`; None where none is named."""
    symbol = frame_at(analyses, file, offset)
    if symbol is None:
        return None
    topic = f" on {code(f'{symbol.space}/tf')}" if symbol.space else ""
    lines = [f"frame {code(symbol.frame)}{topic}", "", *frame_lines(symbol)]
    return Hover("\n".join(lines).rstrip(), symbol.span)


def frame_lines(symbol: FrameSymbol) -> Iterator[str]:
    """What is known of a frame, as lines of Markdown: its path to the root, its children, who publishes and uses it."""
    frames = frames_of(symbol.analysis.context)
    yield from _publishers(symbol, frames)
    yield from _users(symbol, frames)


def _publishers(symbol: FrameSymbol, frames: Frames) -> Iterator[str]:
    edges = _edges(symbol)
    if not edges:
        yield "No node of this launch is known to publish it."
        yield from (["", f"The frames may be incomplete: {escaped('; '.join(frames.gaps))}."] if frames.gaps else [])
        return
    path = frames.path(symbol.space, symbol.frame)
    if path:
        steps = [symbol.frame, *(edge.parent for edge in path)]
        more = " → …" if len(steps) > _PATH else ""
        yield f"Path to the root: {' → '.join(map(code, steps[:_PATH]))}{more}"
    else:
        yield "Root of its tree"
    below = [
        child for child, to in frames.parents(symbol.space).items() if any(each.parent == symbol.frame for each in to)
    ]
    if below:
        more = f", … and {len(below) - _BELOW} more" if len(below) > _BELOW else ""
        yield from ("", f"Children: {', '.join(map(code, below[:_BELOW]))}{more}")
    yield ""
    for edge in edges[:_SHOWN]:
        where = place(symbol.analysis, place_of_edge(symbol.analysis.context, edge))
        sure = f", {edge.doubt}" if edge.doubt else ""
        yield f"- {code(edge.parent)} → {code(edge.child)} by {escaped(edge.by)}{sure} — {where}"


def _users(symbol: FrameSymbol, frames: Frames) -> Iterator[str]:
    uses = [use for use in frames.uses if (use.frame, use.space) == (symbol.frame, symbol.space)]
    if uses:
        yield from ("", "Used by")
    for use in uses[:_SHOWN]:
        yield f"- {code(use.node.name)}, {escaped(use.what)}"
    if len(uses) > _SHOWN:
        yield f"- … and {len(uses) - _SHOWN} more"
