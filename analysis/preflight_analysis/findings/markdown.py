"""Markdown around text that is not ours: names and values of launch files, words of nodes.

CommonMark 0.31: code spans and fenced blocks (sections 6.1 and 4.5), backslash escapes (2.4). A picture or a link that
a launch file names would be loaded by whoever only looks at it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from preflight_analysis.findings.printable import printable

_SHOWN = re.compile(
    r"^(?P<ticks>`{3,})\w*\n(?P<block>.*?)\n(?P=ticks)$"
    r"|(?P<fence>`+)(?!`)(?P<code>.+?)(?<!`)(?P=fence)(?!`)"
    r"|\[(?P<label>(?:[^\]\\]|\\.)*)\]\([^)]*\)|\*\*|\\(?P<char>[!-/:-@\[-`{-~])",
    re.DOTALL | re.MULTILINE,
)
_RUNS = re.compile("`+")
_MARKS = re.compile(r"[\\`*_\[\]<>&~|]|^[-+=#]")
_NUMBERED = re.compile(r"^(\d{1,9})(?=[.)])")
"""What begins a mark within a line, or a block at its start."""


def code(text: object) -> str:
    """A code span that shows the text as it is, in one line."""
    shown = printable(" ".join(str(text).splitlines()), lines=True) or " "
    fence = "`" * _beyond(shown, 1)
    # One space on either side goes where both are there: needed where the text itself begins or ends with a fence.
    space = " " if shown.startswith("`") or shown.endswith("`") or (shown[0] == shown[-1] == " " != shown) else ""
    return f"{fence}{space}{shown}{space}{fence}"


def block(lines: Iterable[str], language: str = "text") -> str:
    """A fenced block of lines."""
    shown = printable("\n".join(lines), lines=True)
    fence = "`" * _beyond(shown, 3)
    return f"{fence}{language}\n{shown}\n{fence}"


def escaped(text: str) -> str:
    """Text that is shown as it is: no marks, links, pictures or HTML."""
    return _NUMBERED.sub(r"\1\\", _MARKS.sub(r"\\\g<0>", printable(" ".join(text.split()))))


def plain(markdown: str) -> str:
    """What is read where Markdown is not shown: the same words without marks, links as their labels."""
    return _SHOWN.sub(_said, markdown)


def _said(found: re.Match[str]) -> str:
    inside = found["code"]
    if inside is not None:
        return inside[1:-1] if inside[0] == inside[-1] == " " != inside else inside
    if found["label"] is not None:
        return plain(found["label"])
    return found["block"] or found["char"] or ""


def _beyond(text: str, least: int) -> int:
    """How many back quotes are one more than any run of them in the text has."""
    return max([least, *(len(run) + 1 for run in _RUNS.findall(text))])
