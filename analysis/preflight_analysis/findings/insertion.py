"""Text edits of launch files that need to know how tags, attributes and comments are written."""

from __future__ import annotations

import re

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Span
from preflight_analysis.edits.edit import Edit
from preflight_analysis.launch.model import Action, ActionAttribute

_BLANKS = re.compile(r"[ \t]*")
_REST_IS_BLANK = re.compile(r"[ \t]*(?:[\r\n]|\Z)")


def insert_child(action: Action, document: Document, child: str) -> Edit:
    """The edit that makes `child` the first thing in the element of `action`, on lines of its own.

    `child` may have several lines, each but the first with the indentation that it has relative to the first. A
    self-closing tag is opened. Line breaks and indentation follow those of the document.
    """
    text = document.text
    newline = "\r\n" if "\r\n" in text else "\n"
    line, _ = document.lines.position(action.head_span.start)
    blanks = _BLANKS.match(text, document.lines.line_start(line))
    base = blanks.group() if blanks is not None else ""
    deeper = base + ("\t" if "\t" in base else "  ")
    body = newline + newline.join(deeper + part for part in child.split("\n"))
    end = action.head_span.end
    if text[action.head_span.start : end].endswith("/>"):
        blank = end - 2
        while text[blank - 1] in " \t":
            blank -= 1
        return Edit(document.location(Span(blank, end)), f">{body}{newline}{base}</{action.kind}>")
    tail = "" if _REST_IS_BLANK.match(text, end) else newline + base
    return Edit(document.location(Span(end, end)), body + tail)


def insert_comment_above(action: Action, document: Document, comment: str) -> Edit:
    """The edit that writes the lines of `comment` above the line on which `action` begins, indented as that is."""
    text = document.text
    newline = "\r\n" if "\r\n" in text else "\n"
    line, _ = document.lines.position(action.span.start)
    start = document.lines.line_start(line)
    blanks = _BLANKS.match(text, start)
    indent = blanks.group() if blanks is not None else ""
    body = "".join(f"{indent}{part}{newline}" for part in comment.split("\n"))
    return Edit(document.location(Span(start, start)), body)


def insert_attribute(action: Action, document: Document, name: str, value: str = "") -> Edit:
    """The edit that gives the tag another attribute, behind those that it has."""
    end = action.attributes[-1].span.end if action.attributes else action.kind_span.end
    return Edit(document.location(Span(end, end)), f' {name}="{value}"')


def remove_attribute(attribute: ActionAttribute, document: Document) -> Edit:
    """The edit that removes the attribute and the blanks before it."""
    start = attribute.span.start
    while start > 0 and document.text[start - 1].isspace():
        start -= 1
    return Edit(document.location(Span(start, attribute.span.end)), "")


def remove_tag(document: Document, span: Span) -> Edit:
    """The edit that removes the element at `span`, with its whole line if nothing else stands on it."""
    text = document.text
    line, _ = document.lines.position(span.start)
    start = document.lines.line_start(line)
    rest = _REST_IS_BLANK.match(text, span.end)
    if not text[start : span.start].strip(" \t") and rest is not None:
        end_line, _ = document.lines.position(span.end)
        return Edit(document.location(Span(start, document.lines.line_start(end_line + 1))), "")
    return Edit(document.location(span), "")
