"""Code points to the editor's units and back: the only place where the negotiated position encoding matters.

pygls' own codec counts lines as `str.splitlines` does and mis-converts columns past the end of a line; LSP 3.17 says
that lines end at `\\n`, `\\r\\n` or `\\r` only, and that a column past the end means the end of the line.
"""

from __future__ import annotations

from bisect import bisect_right
from itertools import accumulate

from lsprotocol.types import Position, PositionEncodingKind, Range
from preflight_analysis.documents.span import LineIndex, Span

_STEP = 512
"""Code points between the places of a line whose columns are remembered: a line may have some million."""


class Positions:
    """Converts between offsets of one text and LSP positions in one encoding."""

    __slots__ = ("_encoding", "_lines", "_marks", "_same", "_text")

    def __init__(self, text: str, lines: LineIndex, encoding: PositionEncodingKind | str) -> None:
        self._text = text
        self._lines = lines
        self._encoding = encoding
        self._same = encoding == PositionEncodingKind.Utf32 or text.isascii()
        self._marks: dict[int, list[int]] = {}

    def are_those_of(self, other: Positions) -> bool:
        """Whether both convert the same text."""
        return self._text == other._text and self._encoding == other._encoding

    def offset(self, position: Position) -> int:
        """The offset of `position`; past the end of a line its end, past the last line the end of the text."""
        if position.line >= len(self._lines):
            return len(self._text)
        start, end = self._lines.line_span(position.line)
        if end > start and self._text[end - 1] == "\n":
            end -= 1
        if end > start and self._text[end - 1] == "\r":
            end -= 1
        if self._same:
            return min(start + position.character, end)
        marks = self._marks_of(position.line)
        before = max(0, bisect_right(marks, position.character) - 1)
        units, at = marks[before], start + before * _STEP
        while at < end:
            units += self._units(self._text[at])
            if units > position.character:
                break
            at += 1
        return min(at, end)

    def position(self, offset: int) -> Position:
        """The position of `offset`, which is kept within the text."""
        line, column = self._lines.position(offset)
        if self._same:
            return Position(line, column)
        start = self._lines.line_start(line)
        if column <= _STEP:
            return Position(line, self._units(self._text[start : start + column]))
        before = column // _STEP
        return Position(
            line, self._marks_of(line)[before] + self._units(self._text[start + before * _STEP : start + column])
        )

    def range(self, span: Span) -> Range:
        """The range of `span`."""
        return Range(self.position(span.start), self.position(span.end))

    def is_at(self, span: Span, known: Range) -> bool:
        """Whether that is the range of `span`."""
        return self._is_at(span.start, known.start) and self._is_at(span.end, known.end)

    def _is_at(self, offset: int, known: Position) -> bool:
        # Asked for each finding of a file on each keystroke: where it can be told, nothing is made for it.
        line, column = self._lines.position(offset)
        if line != known.line or self._same:
            return line == known.line and column == known.character
        return self.position(offset) == known

    def _marks_of(self, line: int) -> list[int]:
        """The columns, in the editor's units, of each `_STEP`th code point of a line."""
        marks = self._marks.get(line)
        if marks is None:
            start, end = self._lines.line_span(line)
            pieces = (self._units(self._text[at : min(at + _STEP, end)]) for at in range(start, end, _STEP))
            marks = self._marks[line] = list(accumulate(pieces, initial=0))
        return marks

    def _units(self, text: str) -> int:
        """The length of `text` in the editor's units."""
        if text.isascii():
            return len(text)
        if self._encoding == PositionEncodingKind.Utf8:
            return len(text.encode("utf-8", "surrogatepass"))
        return len(text.encode("utf-16-le", "surrogatepass")) // 2
