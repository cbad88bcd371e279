"""The tree of elements while it is made: which end tag closes what, and where an element ends that has none.

An unclosed element ends where an ancestor ends, or where its sibling starts by the indentation.
"""

from __future__ import annotations

from bisect import bisect_left
from collections import Counter, deque

from preflight_analysis.documents.document import Attribute, Element, Node, Text
from preflight_analysis.documents.lazy_pattern import lazy_pattern
from preflight_analysis.documents.span import Span
from preflight_analysis.documents.xml_patterns import BLANK, END_TAG, NAME, SPACE, TEXT_SPECIAL, S, skip
from preflight_analysis.documents.xml_source import XmlSource
from preflight_analysis.slips import edits

_TAG_MARK = lazy_pattern(f"<(/?)({NAME})(?:[^<>\"']|\"[^\"<]*\"|'[^'<]*')*?(/?)>")
_TEXT_OF_TAG = lazy_pattern(f"(?<![\\w<])({NAME}){S}+{NAME}{S}*=")
_LOOK_BACK = 50
"""How many nodes before an end tag without a start tag are looked at for one that it might belong to."""


class _Open:
    """An element whose end is not reached yet. `broken`: its start tag has no `>`."""

    __slots__ = ("attributes", "broken", "children", "open_span", "tag", "tag_span")

    def __init__(
        self, tag: str, tag_span: Span, attributes: tuple[Attribute, ...], open_span: Span, broken: bool
    ) -> None:
        self.tag = tag
        self.tag_span = tag_span
        self.attributes = attributes
        self.open_span = open_span
        self.broken = broken
        self.children: list[Node] = []

    def closed(self, end: int) -> Element:
        return Element(
            self.tag,
            self.tag_span,
            self.attributes,
            tuple(self.children),
            self.open_span,
            Span(self.open_span.start, end),
        )


class XmlElements:
    """The elements of a text. `children` are those of the innermost open one (the last of `stack`), or of the
    document."""

    def __init__(self, source: XmlSource) -> None:
        self.source = source
        self.top: list[Node] = []
        self.children = self.top
        self.stack: list[_Open] = []
        self.root_seen = False
        self._open_tags: Counter[str] = Counter()
        self._junk_seen = False
        self._marks: dict[str, tuple[list[int], list[int]]] | None = None

    def text(self, start: int, end: int) -> None:
        """Character data, with references in it."""
        if not self.stack:
            raw = self.source.text[start:end]
            stripped = raw.strip(BLANK)
            if not stripped:
                return
            first = start + raw.index(stripped)
            self.outside_root(first, first + len(stripped), "text")
        self.children.append(Text(self.source.decoded(start, end, TEXT_SPECIAL)))
        close = self.source.text.find("]]>", start, end)
        if close >= 0:
            self.source.problem("']]>' must be written as ]]&gt; in text", close, close + 3)

    def outside_root(self, start: int, end: int, what: str) -> None:
        """Something stands where only the document element may."""
        if not self._junk_seen:
            self._junk_seen = True
            where = "after" if self.root_seen else "before"
            self.source.problem(f"{what} {where} the document element", start, end)

    def open(
        self, tag: str, tag_span: Span, attributes: list[Attribute], end: int, *, empty: bool, broken: bool = False
    ) -> None:
        """A start tag up to `end`. `empty`: its element has no end tag; `broken`: it has no `>`."""
        if len({attribute.name for attribute in attributes}) < len(attributes):
            seen: set[str] = set()
            for attribute in attributes:
                if attribute.name in seen:
                    span = attribute.name_span
                    self.source.problem(f"the attribute '{attribute.name}' is given twice", span.start, span.end)
                seen.add(attribute.name)
        if not self.stack:
            if self.root_seen:
                self.outside_root(tag_span.start, tag_span.end, "another element")
            self.root_seen = True
        start = tag_span.start - 1
        if empty:
            span = Span(start, end)
            self.children.append(Element(tag, tag_span, tuple(attributes), (), span, span))
            return
        opened = _Open(tag, tag_span, tuple(attributes), Span(start, end), broken)
        self.stack.append(opened)
        self._open_tags[tag] += 1
        self.children = opened.children

    def end_tag(self, tag: str, tag_span: Span, start: int, end: int) -> None:
        """An end tag from `start` to `end`: it closes what it names, or what it was most likely meant for."""
        if self.stack and self.stack[-1].tag == tag:
            self.close(len(self.stack) - 1, start, end)
        elif self.stack and self._stands_for_another(tag, start, end):
            self.source.problem(f"expected </{self.stack[-1].tag}>", tag_span.start, tag_span.end)
            self.close(len(self.stack) - 1, start, end)
        elif self._open_tags[tag]:
            index = next(i for i in range(len(self.stack) - 1, -1, -1) if self.stack[i].tag == tag)
            self.close(index, start, end)
        elif self.stack and _resembles(tag, self.stack[-1].tag):
            self.source.problem(f"expected </{self.stack[-1].tag}>", tag_span.start, tag_span.end)
            self.close(len(self.stack) - 1, start, end)
        elif (lost := self._lost_start(tag)) is not None:
            self.source.problem(f"'<' is missing before '{tag}'", lost, lost + len(tag))
        else:
            how = ", it is closed by its '/>' already" if self._closed_itself(tag, start) else ""
            self.source.problem(f"</{tag}> closes nothing{how}", tag_span.start, tag_span.end)

    def closed_later(self, tag: str, at: int) -> bool:
        """Whether the innermost element, of this tag, has an end tag of its own behind `at`."""
        if self._marks is None:
            self._marks = {}
            for mark in _TAG_MARK.finditer(self.source.text):
                if not mark[3]:
                    self._marks.setdefault(mark[2], ([], []))[bool(mark[1])].append(mark.start())
        starts, ends = self._marks.get(tag, ([], []))
        still_open = self._open_tags[tag] + len(starts) - bisect_left(starts, at)
        return len(ends) - bisect_left(ends, at) >= still_open

    def _stands_for_another(self, tag: str, start: int, end: int) -> bool:
        """Whether an end tag of the wrong name stands where that of the innermost element should, by its indentation.

        It does not if the right one follows, unless the two are swapped.
        """
        inner = self.stack[-1]
        column = self.source.indentation(start)
        if column is None or column != self.source.indentation(inner.open_span.start):
            return False
        following = END_TAG.match(self.source.text, skip(SPACE, self.source.text, end))
        right_one_follows = following is not None and following[1] == inner.tag
        if not self._open_tags[tag]:
            return not right_one_follows
        outer = self.stack[-2] if len(self.stack) > 1 else None
        return right_one_follows and outer is not None and outer.tag == tag and inner.tag != tag

    def _lost_start(self, tag: str) -> int | None:
        """Where `tag name=` stands in the text before an end tag that has no start."""
        for node in self.children[: -_LOOK_BACK - 1 : -1]:
            if (
                isinstance(node, Text)
                and self.source.text.find(tag, node.content.span.start, node.content.span.start + 200) >= 0
            ):
                for found in _TEXT_OF_TAG.finditer(node.content.text, 0, 200):
                    if found[1] == tag:
                        return node.content.to_document(found.start(1))
        return None

    def _closed_itself(self, tag: str, start: int) -> bool:
        """Whether an element of the tag before it, as deep as the end tag, ends with `/>`."""
        _, column = self.source.lines.position(start)
        return any(
            isinstance(node, Element)
            and node.tag == tag
            and node.span == node.open_span
            and self.source.lines.position(node.span.start)[1] == column
            for node in self.children[: -_LOOK_BACK - 1 : -1]
        )

    def close(self, index: int, start: int, end: int) -> None:
        """The end tag at `start` belongs to `stack[index]`; what is open in it has none."""
        if index + 1 < len(self.stack):
            self.give_up(index + 1, start)
        opened = self.stack.pop()
        self._open_tags[opened.tag] -= 1
        self.children = self.stack[-1].children if self.stack else self.top
        self.children.append(opened.closed(end))

    def give_up(self, keep: int, at: int) -> None:
        """Close the elements above `stack[:keep]`, which have no end tag, at `at` or where a sibling starts.

        Its children from the first that is not indented deeper are its siblings, as whoever wrote them sees it.
        """
        siblings: deque[Node] = deque()
        reported = False
        while len(self.stack) > keep:
            opened = self.stack.pop()
            self._open_tags[opened.tag] -= 1
            self.children = self.stack[-1].children if self.stack else self.top
            cut = self._first_sibling(opened)
            if not opened.broken and not reported:
                if len(self.stack) > keep and self._is_end_tag(opened, self.stack[-1]):
                    self.source.problem(f"'/' is missing: </{opened.tag}> is expected", *_ends(opened.tag_span))
                    reported = True
                elif lost := self._lost_end(opened, cut):
                    cut = lost[0]
                    self.source.problem(f"'<' is missing before '/{opened.tag}>'", *lost[1])
                else:
                    self.source.problem(f"<{opened.tag}> is not closed", *_ends(opened.tag_span))
            else:
                reported = False
            if cut < len(opened.children):
                siblings.extendleft(reversed(opened.children[cut:]))
                del opened.children[cut:]
            else:
                while siblings and not self._is_sibling(opened, siblings[0]):
                    opened.children.append(siblings.popleft())
            self.children.append(opened.closed(_start(siblings[0]) if siblings else at))
        self.children.extend(siblings)

    def _is_end_tag(self, opened: _Open, outer: _Open) -> bool:
        """Whether an unclosed element in an unclosed one of the same name is the end tag of that without its `/`."""
        if opened.attributes or opened.tag != outer.tag or not outer.children:
            return False
        column = self.source.indentation(opened.open_span.start)
        return column is not None and column == self.source.indentation(outer.open_span.start)

    def _lost_end(self, opened: _Open, cut: int) -> tuple[int, tuple[int, int]] | None:
        """Where `/tag>` stands in the text of an element: how many of its children come before, and the place."""
        mark = f"/{opened.tag}>"
        for index, node in enumerate(opened.children[:cut]):
            if isinstance(node, Text) and (at := node.content.text.find(mark)) >= 0:
                return index + 1, _ends(node.content.slice_span(at, at + len(mark)))
        return None

    def _first_sibling(self, opened: _Open) -> int:
        return next(
            (i for i, node in enumerate(opened.children) if self._is_sibling(opened, node)), len(opened.children)
        )

    def _is_sibling(self, opened: _Open, node: Node) -> bool:
        if not self.stack or not isinstance(node, Element):  # the document element has none
            return False
        line, column = self.source.lines.position(opened.open_span.start)
        node_line, node_column = self.source.lines.position(node.span.start)
        if node_line == line:
            return opened.broken
        return node_column <= column


def _ends(span: Span) -> tuple[int, int]:
    return span.start, span.end


def _start(node: Node) -> int:
    return node.content.span.start if isinstance(node, Text) else node.span.start


def _resembles(typed: str, meant: str) -> bool:
    """Whether an end tag's name is the element's name mistyped, or the beginning of it."""
    typed, meant = typed.lower(), meant.lower()
    return meant.startswith(typed) or edits(typed, meant) <= max(1, len(meant) // 3)
