"""Places in a text. Offsets are code points, counted from 0; only the server converts them to an editor's units.

A span is of one text; a location follows its text through edits. They are named tuples, not data classes, as is all of
which a keystroke makes thousands: those are made three times as fast.
"""

from __future__ import annotations

import itertools
import re
import threading
from bisect import bisect_left, bisect_right
from itertools import accumulate
from typing import NamedTuple

from preflight_analysis.dataclass import dataclass

_LINE_END = re.compile(r"\r\n?|\n")


class Span(NamedTuple):
    """The half-open range `[start, end)` of code points in one text."""

    start: int
    end: int

    def contains(self, offset: int) -> bool:
        """Whether a cursor at `offset` touches the span; its end counts, as in an editor."""
        return self.start <= offset <= self.end

    def moved(self, by: int) -> Span:
        """The same range where the text in front of it has become longer by so many characters."""
        return Span(self.start + by, self.end + by)


class Line:
    """A line of a file, whatever stands above it: as others come and go, it stays the same object. `start` is its
    offset in the text as it is now."""

    __slots__ = ("start",)

    def __init__(self, start: int) -> None:
        self.start = start

    def __lt__(self, other: Line) -> bool:
        return self.start < other.start

    def __repr__(self) -> str:
        return f"Line({self.start})"


_FIRST = Line(0)


class Location(NamedTuple):
    """A part of the text of a file. Made by `LineIndex.location`; it follows its lines where others come or go.

    Two are equal if they are in the same columns of the same lines, wherever those are. They sort by file and span.
    `file` is an absolute path, columns are offsets from the start of their line. The last line is that of the last
    character, so that what is inserted behind a whole line is no part of it.
    """

    file: str
    line: Line
    column: int
    last_line: Line
    end_column: int

    @classmethod
    def of_file(cls, path: str) -> Location:
        """The start of a file of which no text is at hand: it may not be read, or not be one."""
        return cls(path, _FIRST, 0, _FIRST, 0)

    @property
    def span(self) -> Span:
        """Where it is in the text as it is now. Of a line that is gone: where that was last."""
        return Span(self.line.start + self.column, self.last_line.start + self.end_column)

    def __repr__(self) -> str:
        return f"Location({self.file!r}, {self.span})"


Origin = tuple[Location, ...]
"""Where a value comes from: the chain of include tags, outermost first, and last the place of the value itself."""


class LineIndex:
    r"""Offsets of one text to lines and columns and back. Lines end at `\n`, `\r\n` or `\r` and nowhere else, as LSP
    says. Two are equal if their lines are the same ones: locations made by one are right for the other."""

    __slots__ = ("_lines", "_offsets", "number", "text")

    def __init__(self, text: str) -> None:
        self._offsets: list[int] | None = None
        """Of the starts of the lines, made when they are first asked for: of most files that never happens."""
        self._lines: list[Line] | None = None
        """Made when the first location is."""
        self.text = text
        self.number = next(_NUMBERS)
        """Differs from that of all other indexes of this process."""

    @property
    def _starts(self) -> list[int]:
        if self._offsets is None:
            self._offsets = _line_starts(self.text)
        return self._offsets

    def __len__(self) -> int:
        return len(self._starts)

    def edited(self, text: str) -> LineIndex:
        """The index of what this text has become, this one if it is the same. From here on, locations that this one
        made show where their lines are in the new text.

        Lines in front of the first change and behind the last one are the same; those between are in order as far as
        there are as many, so that an edit within a line leaves it.
        """
        if text == self.text:
            return self
        new = LineIndex(text)
        with _LINES:
            if (lines := self._lines) is None:
                return new
            old_starts, starts = self._starts, new._starts
            same = bisect_right(old_starts, common_prefix(self.text, text)) - 1
            # A line may start where the common part ends: `\r` ends one, and with `\n` behind it another one.
            while same and (same >= len(starts) or starts[same] != old_starts[same]):
                same -= 1
            first = starts[same]
            behind = common_suffix(self.text[first:], text[first:])
            moved = len(text) - len(self.text)
            after = len(lines) - bisect_left(old_starts, len(self.text) - behind)
            while after and (after > len(starts) - same or starts[-after] != old_starts[-after] + moved):
                after -= 1
            room = len(starts) - same - after
            between = lines[same : min(same + room, len(lines) - after)]
            between += (Line(0) for _ in range(room - len(between)))
            new._lines = lines[:same] + between + lines[len(lines) - after :]
            for line, start in zip(new._lines[same:], starts[same:], strict=True):
                line.start = start
        return new

    def position(self, offset: int) -> tuple[int, int]:
        """Line and column of `offset`, both counted from 0, the column in code points."""
        offset = max(0, min(offset, len(self.text)))
        starts = self._offsets or self._starts
        line = bisect_right(starts, offset) - 1
        return line, offset - starts[line]

    def line_start(self, line: int) -> int:
        """Offset of the first character of `line`, counted from 0; the end of the text for lines past it."""
        return self._starts[line] if 0 <= line < len(self._starts) else len(self.text)

    def line_span(self, line: int) -> Span:
        """The whole line, its line break included."""
        return Span(self.line_start(line), self.line_start(line + 1))

    def location(self, path: str, span: Span) -> Location:
        """The location of a span of this text, which is that of the file at `path`."""
        start, end = span
        starts, lines = self._starts, self._lines or self._with_lines()
        number = last = bisect_right(starts, start) - 1
        if number + 1 < len(starts) and end > starts[number + 1]:
            last = bisect_right(starts, end - 1) - 1
        return Location(path, lines[number], start - starts[number], lines[last], end - starts[last])

    def lines_of(self, span: Span) -> tuple[Line, ...]:
        """The lines that a span of this text is on. While they are the same ones and start with the same column and
        text, all locations in it are."""
        lines = self._lines or self._with_lines()
        return tuple(lines[bisect_right(self._starts, span.start) - 1 : bisect_right(self._starts, span.end)])

    def _with_lines(self) -> list[Line]:
        with _LINES:
            if self._lines is None:
                self._lines = [Line(start) for start in self._starts]
            return self._lines

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, LineIndex):
            return NotImplemented
        return self is other or (self._lines is not None and self._lines == other._lines and self.text == other.text)

    def __hash__(self) -> int:
        return hash(self.text)


def _line_starts(text: str) -> list[int]:
    if "\r" in text:
        return [0, *(found.end() for found in _LINE_END.finditer(text))]
    starts = [0, *accumulate([len(line) + 1 for line in text.split("\n")])]
    starts.pop()  # the last line has no end
    return starts


_NUMBERS = itertools.count()
_LINES = threading.Lock()
"""Whoever makes or moves lines has it."""


def version(digest: str, lines: LineIndex) -> str:
    """Names a text, by its digest, and its lines."""
    return f"{digest}.{lines.number}"


def common_prefix(one: str, other: str) -> int:
    """How many characters two texts begin with that are the same."""
    low, high = 0, min(len(one), len(other))
    while low < high:
        middle = (low + high + 1) // 2
        if one[low:middle] == other[low:middle]:
            low = middle
        else:
            high = middle - 1
    return low


def common_suffix(one: str, other: str) -> int:
    """How many characters two texts end with that are the same."""
    low, high = 0, min(len(one), len(other))
    while low < high:
        middle = (low + high + 1) // 2
        if one[len(one) - middle : len(one) - low] == other[len(other) - middle : len(other) - low]:
            low = middle
        else:
            high = middle - 1
    return low


class ByteOffsets:
    """Code points to bytes of UTF-8 and back, for what speaks of bytes: near to constant time in any text."""

    __slots__ = ("_marks", "_text", "same")
    _STEP = 1024

    def __init__(self, text: str) -> None:
        self._text = text
        self.same = text.isascii()
        self._marks: list[int] | None = None

    def bytes_before(self, offset: int) -> int:
        """How many bytes the text has before a code point."""
        if self.same:
            return offset
        mark = min(offset // self._STEP, len(self._starts) - 1)
        return self._starts[mark] + len(self._encoded(mark * self._STEP, offset))

    def offset(self, byte: int) -> int:
        """The code point at a byte; one within a code point stands for the next one."""
        if self.same:
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
