"""Code points to the editor's units and back: the only place where the negotiated position encoding matters.

pygls' own codec counts lines as `str.splitlines` does and mis-converts columns past the end of a line; LSP 3.17 says
that lines end at `\\n`, `\\r\\n` or `\\r` only, and that a column past the end means the end of the line.
"""

from __future__ import annotations

from lsprotocol.types import Position, PositionEncodingKind, Range
from preflight_analysis.documents.span import LineIndex, Span


class Positions:
    """Converts between offsets of one text and LSP positions in one encoding."""

    __slots__ = ("_encoding", "_lines", "_text")

    def __init__(self, text: str, lines: LineIndex, encoding: PositionEncodingKind | str) -> None:
        self._text = text
        self._lines = lines
        self._encoding = encoding

    def offset(self, position: Position) -> int:
        """The offset of `position`; past the end of a line its end, past the last line the end of the text."""
        if position.line >= len(self._lines):
            return len(self._text)
        span = self._lines.line_span(position.line)
        line = self._text[span.start : span.end]
        if line.endswith("\r\n"):
            line = line[:-2]
        elif line.endswith(("\n", "\r")):
            line = line[:-1]
        return span.start + self._column(line, position.character)

    def position(self, offset: int) -> Position:
        """The position of `offset`, which is kept within the text."""
        line, column = self._lines.position(offset)
        start = self._lines.line_start(line)
        return Position(line, self._units(self._text[start : start + column]))

    def range(self, span: Span) -> Range:
        """The range of `span`."""
        return Range(self.position(span.start), self.position(span.end))

    def _units(self, text: str) -> int:
        """The length of `text` in the editor's units."""
        if self._encoding == PositionEncodingKind.Utf32 or text.isascii():
            return len(text)
        if self._encoding == PositionEncodingKind.Utf8:
            return len(text.encode("utf-8", "surrogatepass"))
        return len(text.encode("utf-16-le", "surrogatepass")) // 2

    def _column(self, line: str, character: int) -> int:
        """Code points before `character`; a position inside a character counts as its start."""
        if self._encoding == PositionEncodingKind.Utf32 or line.isascii():
            return min(character, len(line))
        units = 0
        for column, char in enumerate(line):
            units += self._units(char)
            if units > character:
                return column
        return len(line)
