"""Places in a text. Offsets are code points, counted from 0; only the server converts them to an editor's units.

They are named tuples, not data classes, as is all of which a keystroke makes thousands: those are made three times as
fast.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from dataclasses import dataclass
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


@dataclass(frozen=True, slots=True)
class Place:
    """A place in a file for people and other programs: line and column counted from 1, the column in code points."""

    file: str
    line: int
    column: int = 1
