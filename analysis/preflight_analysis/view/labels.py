"""What is written on the parts of a picture, and how wide that is: all of it is in a font of one width."""

from __future__ import annotations

import unicodedata

from preflight_analysis.findings.printable import printable

MAX_COLUMNS = 38
"""A longer name is cut in the middle; its end is what tells names apart."""
_ELLIPSIS = "…"


def label(name: str, limit: int = MAX_COLUMNS) -> str:
    """A name as it is written in a box: one line, without characters that cannot be seen, cut where it is long."""
    text = printable(name)
    if columns(text) <= limit:
        return text
    head, tail = "", ""
    for character in text:
        if columns(head + character) > limit // 3:
            break
        head += character
    for character in reversed(text[len(head) :]):
        if columns(character + tail) > limit - limit // 3 - 1:
            break
        tail = character + tail
    return head + _ELLIPSIS + tail


def columns(text: str) -> int:
    """How many columns of a terminal, or of a font of one width, a text takes."""
    return sum(_width(character) for character in text)


def _width(character: str) -> int:
    if unicodedata.combining(character):
        return 0
    return 2 if unicodedata.east_asian_width(character) in "WF" else 1
