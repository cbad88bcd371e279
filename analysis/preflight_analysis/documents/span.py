"""Places in a text. Offsets are code points, counted from 0; only the server converts them to an editor's units.

They are named tuples, not data classes, as is all of which a keystroke makes thousands: those are made three times as
fast.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from dataclasses import dataclass
from itertools import accumulate
from typing import NamedTuple

_LINE_END = re.compile(r"\r\n?|\n")


class Span(NamedTuple):
    """The half-open range `[start, end)` of code points in one text."""

    start: int
    end: int

    def contains(self, offset: int) -> bool:
        """Whether a cursor at `offset` touches the span; its end counts, as in an editor."""
        return self.start <= offset <= self.end


class Location(NamedTuple):
    """A span of a file; `file` is an absolute path."""

    file: str
    span: Span


Origin = tuple[Location, ...]
"""Where a value comes from: the chain of include tags, outermost first, and last the place of the value itself."""


class LineIndex:
    r"""Offsets to lines and columns and back. Lines end at `\n`, `\r\n` or `\r` and nowhere else, as LSP says."""

    __slots__ = ("_length", "_starts")

    def __init__(self, text: str) -> None:
        starts = [0]
        starts.extend(found.end() for found in _LINE_END.finditer(text))
        self._starts = starts
        self._length = len(text)

    def __len__(self) -> int:
        return len(self._starts)

    def position(self, offset: int) -> tuple[int, int]:
        """Line and column of `offset`, both counted from 0, the column in code points."""
        offset = max(0, min(offset, self._length))
        line = bisect_right(self._starts, offset) - 1
        return line, offset - self._starts[line]

    def line_start(self, line: int) -> int:
        """Offset of the first character of `line`, counted from 0; the end of the text for lines past it."""
        return self._starts[line] if 0 <= line < len(self._starts) else self._length

    def line_span(self, line: int) -> Span:
        """The whole line, its line break included."""
        return Span(self.line_start(line), self.line_start(line + 1))


class ByteOffsets:
    """Code points to bytes of UTF-8 and back, for what speaks of bytes: near to constant time in any text."""

    __slots__ = ("_marks", "_same", "_text")
    _STEP = 1024

    def __init__(self, text: str) -> None:
        self._text = text
        self._same = text.isascii()
        self._marks: list[int] | None = None

    def bytes_before(self, offset: int) -> int:
        """How many bytes the text has before a code point."""
        if self._same:
            return offset
        mark = min(offset // self._STEP, len(self._starts) - 1)
        return self._starts[mark] + len(self._encoded(mark * self._STEP, offset))

    def offset(self, byte: int) -> int:
        """The code point at a byte; one within a code point stands for the next one."""
        if self._same:
            return min(byte, len(self._text))
        mark = max(0, bisect_right(self._starts, byte) - 1)
        piece = self._encoded(mark * self._STEP, (mark + 1) * self._STEP)[: byte - self._starts[mark]]
        return min(mark * self._STEP + len(piece.decode(errors="replace")), len(self._text))

    @property
    def _starts(self) -> list[int]:
        if self._marks is None:
            sizes = (len(self._encoded(at, at + self._STEP)) for at in range(0, len(self._text), self._STEP))
            self._marks = list(accumulate(sizes, initial=0))
        return self._marks

    def _encoded(self, start: int, end: int) -> bytes:
        return self._text[start:end].encode(errors="replace")


@dataclass(frozen=True, slots=True)
class Place:
    """A place in a file for people and other programs: line and column counted from 1, the column in code points."""

    file: str
    line: int
    column: int = 1
