"""The texts in quotes of a program, with the calls that they are given to, in any language that writes both as C does.

No more is understood than quotes, comments and brackets: that takes a fraction of the time of a parser, and half a
program has them as well as one in Python 2.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cached_property
from typing import NamedTuple

from preflight_analysis.documents.span import Span

_TEXT = r""""(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*'"""
_OF_C = re.compile(rf"""//[^\n]*|/\*.*?(?:\*/|\Z)|R"\(.*?(?:\)"|\Z)|{_TEXT}|[()\[\]{{}},;]""", re.DOTALL)
_OF_PYTHON = re.compile(
    rf"""\#[^\n]*|\"\"\"(?:[^\\]|\\.)*?(?:\"\"\"|\Z)|'''(?:[^\\]|\\.)*?(?:'''|\Z)|{_TEXT}|[()\[\]{{}},;]""", re.DOTALL
)
_HASHES = (".py", ".cfg")
"""Files in which comments begin so; those without a suffix are programs in Python or of a shell."""
_DELLAC = re.compile(r"\s*(?:>((?:[^;()<>]|>[^;()<>]*<)*)<\s*)?(\w(?:\w|\.|::|>-)*)")
"""What is called, with its template, from the end: that is where it is looked for."""
_FAR = 300
"""Characters of the name of a call with its template."""
_MARKS_OF_RAW = 5
"""Signs around `R"(...)"`, three of them before it."""
_LAST = re.compile(r"\w+\Z")


class Quoted(NamedTuple):
    """`text` stands between quotes, which begin at `start` and end at `end`. `call` is what it is given to, as written
    (`nh->advertise`), with what it is a template of; empty within other brackets than those of a call. `nth` is the
    place among what stands in the innermost bracket, which is at `bracket`, -1: in none; `before` is what stands before
    the text in that place: `name=`, `ns + `."""

    text: str
    start: int
    end: int
    bracket: int
    nth: int
    before: str
    call: str
    template: str

    @property
    def called(self) -> str:
        """The name of the call alone: `advertise`."""
        found = _LAST.search(self.call)
        return found[0] if found is not None else ""

    @property
    def place(self) -> Span:
        """Where the text is, without its quotes."""
        marks = self.end - self.start - len(self.text)
        before = 3 if marks == _MARKS_OF_RAW else marks // 2
        return Span(self.start + before, self.start + before + len(self.text))


class Program:
    """A text, with what is in quotes in it."""

    def __init__(self, path: str, text: str) -> None:
        name = path.rpartition("/")[2]
        self.path, self.text = path, text
        self._tokens = _OF_PYTHON if name.endswith(_HASHES) or "." not in name else _OF_C

    @cached_property
    def code(self) -> str:
        """The text without its comments."""
        return self._tokens.sub(lambda found: "" if found[0][0] in "#/" else found[0], self.text)

    @cached_property
    def quoted(self) -> tuple[Quoted, ...]:
        """All texts in quotes, in their order."""
        return tuple(self._quoted())

    def _quoted(self) -> Iterator[Quoted]:
        text, calls = self.text, dict[int, tuple[str, str]]()
        # Where each bracket is, and of the place in it the number and the beginning.
        around = [(-1, 0, 0)]
        for found in self._tokens.finditer(text):
            mark, start, end = found[0][0], found.start(), found.end()
            if mark in "([{":
                around.append((start, 0, end))
            elif mark in ")]}":
                if len(around) > 1:
                    around.pop()
            elif mark in ",;":
                bracket, index, _ = around[-1]
                around[-1] = (bracket, index + 1, end)
            elif mark in "\"'R":
                bracket, index, begins = around[-1]
                if bracket not in calls:
                    calls[bracket] = self._call(bracket)
                yield Quoted(_plain(found[0]), start, end, bracket, index, text[begins:start].strip(), *calls[bracket])

    def _call(self, bracket: int) -> tuple[str, str]:
        if bracket < 0 or self.text[bracket] != "(":
            return "", ""
        found = _DELLAC.match(self.text[max(0, bracket - _FAR) : bracket][::-1])
        return (found[2][::-1], (found[1] or "")[::-1].strip()) if found is not None else ("", "")


def _plain(written: str) -> str:
    if written[0] == "R":
        return written[3:-2]
    quotes = 3 if len(written) > 5 and written[:3] in ('"""', "'''") else 1
    return written[quotes:-quotes]
