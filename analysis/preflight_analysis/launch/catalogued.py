"""The launch files of the catalogue (`catalogue/launches.py`): from their data to LaunchFile.

The data are a JSON list with a row a line: first `[repository, commit, date, generation]`, then for each action, in
document order, `[depth, kind, attributes, body]`; the body may be left out. In ROS 1 a value is its text. In ROS 2 it
is a text that stands for itself, `{"v": value}` for what is no text, or a list of texts and of substitutions, each of
them a list of its command and its words, which are lists of the same kind.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

from preflight_analysis.catalogue.launches import SUFFIX
from preflight_analysis.documents.document import Document, SpannedText
from preflight_analysis.documents.reading import Text
from preflight_analysis.documents.span import Span
from preflight_analysis.generation import ros
from preflight_analysis.launch.model import Action, ActionAttribute, LaunchFile, Literal, Substitution, Typed, Value
from preflight_analysis.launch.substitutions import parse_value

_HEADS_ARE_NAMES = tuple(each + SUFFIX for each in (".py", ".yaml", ".yml"))
"""Files whose actions have a head of nothing but a name; an XML element has more."""


def read_catalogued(source: Text) -> LaunchFile:
    """The launch file. Its places are whole rows."""
    (_, _, _, generation), *rows = json.loads(source.text)
    reader = _Reader(generation, xml=not source.path.endswith(_HEADS_ARE_NAMES))
    spans = (source.lines.line_span(number) for number in range(2, len(rows) + 2))
    actions = [
        (row[0], reader.action(row, Span(span.start, span.end - 1))) for row, span in zip(rows, spans, strict=True)
    ]
    whole = Span(0, len(source.text))
    children = tuple(_nested(actions, 0, len(actions), 0))
    root = Action("launch", Span(0, 0), (), children, (), Value("", whole, ()), Span(0, 0), whole)
    document = Document(source.path, source.text, source.digest, (), (), source.lines)
    return LaunchFile(source.path, generation, root, document)


def _nested(rows: list[tuple[int, Action]], start: int, end: int, depth: int) -> Iterator[Action]:
    """The actions of a depth among rows, each with those that are in it."""
    at = start
    while at < end:
        behind = next((i for i in range(at + 1, end) if rows[i][0] <= depth), end)
        action = rows[at][1]
        last = rows[behind - 1][1].span.end
        children = tuple(_nested(rows, at + 1, behind, depth + 1))
        yield Action(
            action.kind,
            action.kind_span,
            action.attributes,
            children,
            (),
            action.body,
            action.head_span,
            Span(action.span.start, last),
        )
        at = behind


class _Reader:
    def __init__(self, generation: int, *, xml: bool) -> None:
        self._generation, self._xml = generation, xml

    def action(self, row: list[Any], span: Span) -> Action:
        _, kind, attributes, *body = row
        given = tuple(ActionAttribute(name, span, self._value(each, span), span) for name, each in attributes.items())
        kind_span = Span(span.start, span.start + 1) if self._xml else span
        return Action(kind, kind_span, given, (), (), self._value(body[0] if body else "", span), span, span)

    def _value(self, written: Any, span: Span) -> Value:
        if isinstance(written, dict):
            plain = written["v"]
            text = json.dumps(plain) if isinstance(plain, (bool, list)) else str(plain)
            return Value(text, span, (Literal(text, span),), typed=Typed(plain))
        if not ros(self._generation).nested_substitutions:
            at = (*(span.start,) * len(written), span.end)
            return parse_value(SpannedText(written, span, at))
        parts = tuple(_parts(written if isinstance(written, list) else [written], span))
        return Value("".join(part.text for part in parts), span, parts)


def _parts(written: list[Any], span: Span) -> Iterator[Literal | Substitution]:
    for piece in written:
        if isinstance(piece, str):
            yield Literal(piece, span)
            continue
        command, *words = piece
        inner = tuple(tuple(_parts(word, span)) for word in words)
        arguments = " ".join("".join(part.text for part in word) for word in inner)
        text = f"$({command} {arguments})" if words else f"$({command})"
        yield Substitution(command, span, arguments, span, text, span, inner)
