"""What kind of place a cursor is in, in a text that is being typed: from the tolerant tree of that text alone."""

from __future__ import annotations

import re
from typing import Literal

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Attribute, Comment, Document, Element, Node, Text
from preflight_analysis.documents.span import Span
from preflight_analysis.documents.xml_patterns import NAME

PlaceKind = Literal["element", "end-tag", "attribute", "value", "content"]

_HALF_TAG = re.compile(f"<(/?)(?:{NAME})?")
_NAME_OR_NOTHING = re.compile(f"(?:{NAME})?")
_UNCLOSED_WORD = re.compile(r"""[^\s"'<>/]*""")
_WORD = frozenset("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-")
_BLANKS = " \t\r\n"


@dataclass(frozen=True, slots=True)
class Place:
    """Where a cursor is. `word` is what a completion may replace: the name around the cursor, or the whole value.

    `parents` are the elements that are open around the place, outermost first; `element` is the one whose start tag
    the cursor is in (for `element`: the one whose name it is on, if there is any of it), `attribute` the one that it
    is on.
    """

    kind: PlaceKind
    word: Span
    parents: tuple[Element, ...]
    element: Element | None = None
    attribute: Attribute | None = None

    @property
    def parent(self) -> Element | None:
        """The innermost element that is open around the place."""
        return self.parents[-1] if self.parents else None


def place_at(document: Document, offset: int) -> Place | None:
    """The place of a cursor at `offset`; None where nothing of the language can stand, as in a comment."""
    text = document.text
    parents: list[Element] = []
    level = document.children
    while (node := _around(text, level, offset)) is not None:
        if isinstance(node, Comment):
            return None
        if offset <= node.tag_span.end:
            return Place("element", node.tag_span, tuple(parents), node)
        if offset < node.open_span.end or (_is_open(text, node.open_span) and _is_blank(text, node, offset)):
            return _in_start_tag(text, tuple(parents), node, offset)
        parents.append(node)
        level = node.children
    if text.rfind("<![CDATA[", 0, offset) > text.rfind("]]>", 0, offset):
        return None
    less = text.rfind("<", 0, offset)
    half = _HALF_TAG.fullmatch(text, less, offset) if less >= 0 else None
    if half is not None:
        start = half.end(1)
        name = _NAME_OR_NOTHING.match(text, start)
        return Place("end-tag" if half[1] else "element", Span(start, name.end() if name else start), tuple(parents))
    if text.startswith(("<?", "<!DOCTYPE"), less) and text.find(">", less, offset) < 0:
        return None
    start = end = offset
    while start > 0 and text[start - 1] in _WORD:
        start -= 1
    while end < len(text) and text[end] in _WORD:
        end += 1
    return Place("content", Span(start, end), tuple(parents))


def _around(text: str, level: tuple[Node, ...], offset: int) -> Element | Comment | None:
    """The element or comment that the offset is inside of; at its end it is only while that end is not written."""
    for node in level:
        if isinstance(node, Text):
            continue
        if node.span.start >= offset:
            return None
        if offset < node.span.end or (offset == node.span.end and not is_closed(text, node)):
            return node
    return None


def is_closed(text: str, node: Element | Comment) -> bool:
    """Whether its end is written, and not only where the scanner gave it up."""
    if isinstance(node, Comment):
        return text.endswith("-->", node.span.start + 4, node.span.end)
    if node.span.end == node.open_span.end:
        return text.endswith("/>", node.span.start, node.span.end)
    less = text.rfind("<", node.open_span.end, node.span.end)
    return not _is_open(text, node.span) and text.startswith("</", less)


def _is_open(text: str, span: Span) -> bool:
    """Whether the markup at `span` was given up before its `>`."""
    return text[span.end - 1] != ">"


def _is_blank(text: str, element: Element, offset: int) -> bool:
    return not text[element.open_span.end : offset].strip(_BLANKS)


def _in_start_tag(text: str, parents: tuple[Element, ...], element: Element, offset: int) -> Place | None:
    for attribute in element.attributes:
        if attribute.name_span.contains(offset):
            return Place("attribute", attribute.name_span, parents, element, attribute)
    for attribute in element.attributes:
        value = attribute.value.span
        quote = text[value.start - 1]
        if quote not in "\"'" or offset < value.start:
            continue
        if text.startswith(quote, value.end):
            if offset <= value.end:
                return Place("value", _on_line(text, value, offset), parents, element, attribute)
        elif not text[value.end : offset].strip(" \t"):
            # The closing quote is missing: the scanner leaves out blanks that are just being typed, and what follows
            # the word at the cursor may well belong to something else.
            word = _UNCLOSED_WORD.match(text, offset)
            there = Span(value.start, word.end() if word else offset)
            return Place("value", _on_line(text, there, offset), parents, element, attribute)
    if text[offset - 1] in _BLANKS:
        return Place("attribute", Span(offset, offset), parents, element)
    return None


def _on_line(text: str, span: Span, offset: int) -> Span:
    """What of the span is on the line of the cursor, which is all that an editor lets a completion replace. A value
    goes on over lines where a quote is missing."""
    end = text.find("\n", offset, span.end)
    return Span(max(span.start, text.rfind("\n", 0, offset) + 1), span.end if end < 0 else end)
