"""How the lines of a text are laid out: what is inserted looks like what is there."""

from __future__ import annotations

import re

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Span
from preflight_analysis.edits.edit import Edit

_BLANKS = re.compile(r"[ \t]*")
_REST_IS_BLANK = re.compile(r"[ \t]*(?:[\r\n]|\Z)")


def newline(text: str) -> str:
    """What lines of the text end with."""
    return "\r\n" if "\r\n" in text else "\n"


def indent_of(document: Document, offset: int) -> str:
    """The blanks that the line of an offset begins with."""
    line, _ = document.lines.position(offset)
    found = _BLANKS.match(document.text, document.lines.line_start(line))
    return found.group() if found is not None else ""


def blanks_before(document: Document, offset: int) -> str | None:
    """The blanks before an offset, if nothing else stands before it on its line."""
    line, _ = document.lines.position(offset)
    before = document.text[document.lines.line_start(line) : offset]
    return before if not before.strip(" \t") else None


def ends_line(text: str, offset: int) -> bool:
    """Whether nothing but blanks stands behind an offset on its line."""
    return _REST_IS_BLANK.match(text, offset) is not None


def deeper(indent: str) -> str:
    """One step more of indentation in XML."""
    return indent + ("\t" if "\t" in indent else "  ")


def insertion(document: Document, offset: int, text: str) -> Edit:
    """The edit that inserts a text."""
    return Edit(document.location(Span(offset, offset)), text)


def removal(document: Document, span: Span) -> Edit:
    """The edit that removes what is at `span`, with its whole lines if nothing else stands on them."""
    line, _ = document.lines.position(span.start)
    if blanks_before(document, span.start) is not None and ends_line(document.text, span.end):
        end_line, _ = document.lines.position(span.end)
        start = document.lines.line_start(line)
        return Edit(document.location(Span(start, document.lines.line_start(end_line + 1))), "")
    return Edit(document.location(span), "")


def lines_above(document: Document, offset: int, body: str) -> Edit:
    """The edit that writes lines above that of an offset, indented as that is."""
    line, _ = document.lines.position(offset)
    indent, end = indent_of(document, offset), newline(document.text)
    return insertion(
        document, document.lines.line_start(line), "".join(f"{indent}{part}{end}" for part in body.split("\n"))
    )


def at_end_of_line(document: Document, offset: int, text: str) -> Edit:
    """The edit that writes a text behind what stands on the line of an offset."""
    line, _ = document.lines.position(offset)
    start, end = document.lines.line_span(line)
    return insertion(document, start + len(document.text[start:end].rstrip()), text)
