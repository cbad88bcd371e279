"""A tolerant XML scanner, in the manner of LemMinX's: a tree with spans of any text, and what is wrong in it.

Start tags that are in order are taken by one regular expression each. What it does not take is guessed piece by
piece: start tags by `xml_start_tags`, what end tags close by `xml_elements`, other markup here. Every guess has its
problem, so in a well-formed text nothing was guessed. No pattern can backtrack more than linearly, nothing recurses.
"""

from __future__ import annotations

import re

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Comment, Element, Node, SpannedText, SyntaxProblem, Text
from preflight_analysis.documents.lazy_pattern import lazy_pattern
from preflight_analysis.documents.span import LineIndex, Span
from preflight_analysis.documents.xml_elements import XmlElements
from preflight_analysis.documents.xml_patterns import BLANK, END_TAG, NAME, ONE_NAME, TEXT_SPECIAL, S
from preflight_analysis.documents.xml_source import XmlSource
from preflight_analysis.documents.xml_start_tags import START_TAG, attributes_of, read_broken_tag

_MISSPELT_COMMENT = re.compile(r"<!?--?(?=[ \t\r\n])")
_SPACED_TAG = lazy_pattern(f"<[ \t]+({NAME})(?={S}+{NAME}{S}*=|{S}*/?>)")
_CONFLICT = re.compile(r"<{7}(?=[ \r\n])")
_COMMENT_MARK = re.compile("<!--|-->")
_NOT_A_CHARACTER = re.compile("[\0-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]+")
_ENTITY_DECLARATION = lazy_pattern(f"<!ENTITY{S}+({NAME}){S}")
_EXTERNAL = lazy_pattern(f"<!DOCTYPE{S}+{NAME}{S}+(?:SYSTEM|PUBLIC)\\b|%{NAME};")
_SUBSET_MARK = re.compile("<!--|<\\?|[\"'\\[\\]<>]")


@dataclass(frozen=True, slots=True)
class Scan:
    """What the scanner makes of a text. `declared` are the entities that its DOCTYPE, at `doctype`, declares."""

    children: tuple[Node, ...]
    problems: tuple[SyntaxProblem, ...]
    entities: tuple[tuple[str, Span], ...]
    declared: frozenset[str]
    doctype: Span

    @property
    def has_element(self) -> bool:
        """Whether anything like a tag was found."""
        return any(isinstance(child, Element) for child in self.children)


def scan(text: str, lines: LineIndex) -> Scan:
    """Scan a whole text; `lines` is its index."""
    return _Scanner(text, lines).scan()


def scan_children(text: str, lines: LineIndex, root: Element, part: Span) -> tuple[Node, ...] | None:
    """The children that `root` has in that part of a text, which begins and ends where a tag does; None where the part
    is not in order by itself: what it means then depends on the rest."""
    scanner = _Scanner(text, lines)
    scanner.elements.open(root.tag, root.tag_span, [*root.attributes], root.open_span.end, empty=False)
    if scanner.go_on(*part) != part.end or len(scanner.elements.stack) > 1 or scanner.elements.top:
        return None
    scanner.refuse_characters(part)
    return None if scanner.source.problems or scanner.source.entities else tuple(scanner.elements.children)


class _Scanner:
    def __init__(self, text: str, lines: LineIndex) -> None:
        self.source = XmlSource(text, lines)
        self.elements = XmlElements(self.source)
        self.doctype = Span(0, 0)
        self.comment_ends: dict[int, int] | None = None

    def scan(self) -> Scan:
        source, text = self.source, self.source.text
        self.go_on(1 if text.startswith("\ufeff") else 0, len(text))
        self.elements.give_up(0, len(text))
        self.refuse_characters(Span(0, len(text)))
        problems, entities = tuple(source.problems), tuple(source.entities)
        return Scan(tuple(self.elements.top), problems, entities, source.declared, self.doctype)

    def go_on(self, at: int, end: int) -> int:
        """Scan what begins between the two. Returns where that ends."""
        source, elements = self.source, self.elements
        text = source.text
        while at < end:
            less = text.find("<", at)
            if not 0 <= less < end:
                less = end
            if less > at:
                elements.text(at, less)
            if less == end:
                return end
            if tag := START_TAG.match(text, less):
                at = tag.end()
                elements.open(tag[1], Span(*tag.span(1)), attributes_of(source, tag), at, empty=bool(tag[3]))
            elif tag := END_TAG.match(text, less):
                elements.end_tag(tag[1], Span(*tag.span(1)), less, tag.end())
                at = tag.end()
            else:
                at = self._markup(less)
        return at

    def refuse_characters(self, part: Span) -> None:
        """Note those that XML does not have."""
        for bad in _NOT_A_CHARACTER.finditer(self.source.text, *part):
            self.source.problem(f"the character U+{ord(bad[0][0]):04X} is not allowed in XML", *bad.span())

    def _markup(self, less: int) -> int:
        """What starts with `<` and is neither a start tag nor an end tag in order. Returns where it ends."""
        text = self.source.text
        if name := ONE_NAME.match(text, less + 1):
            if name[0] == "xml" and not self.elements.stack and not self.elements.root_seen:
                self.source.problem("the XML declaration starts with '<?xml'", less, name.end())
                greater = text.find(">", less, self.source.line_end(less))
                return greater + 1 if greater >= 0 else self.source.line_end(less)
            return self._broken_start_tag(name)
        if text.startswith("</", less):
            return self._broken_end_tag(less)
        if text.startswith("<!--", less):
            return self._comment(less)
        if text.startswith("<![CDATA[", less):
            return self._cdata(less)
        if text.startswith("<?", less):
            return self._instruction(less)
        if text.startswith("<!DOCTYPE", less) and not self.elements.stack:
            return self._doctype(less)
        if spaced := _SPACED_TAG.match(text, less):
            self.source.problem("there cannot be a blank after the '<' of a tag", less, spaced.end())
            name = ONE_NAME.match(text, spaced.start(1))
            if name is not None:
                return self._broken_start_tag(name)
        if misspelt := _MISSPELT_COMMENT.match(text, less):
            self.source.problem("a comment starts with '<!--'", *misspelt.span())
            close = self.source.find("-->", misspelt.end())
            if 0 <= close < self.source.line_end(less):
                content = SpannedText(text[misspelt.end() : close], Span(misspelt.end(), close))
                self.elements.children.append(Comment(content, Span(less, close + 3)))
                return close + 3
            return misspelt.end()
        if conflict := _CONFLICT.match(text, less):
            self.source.problem("this is the mark of a merge conflict", *conflict.span())
            return conflict.end()
        if text.startswith("<<", less):
            self.source.problem("there is one '<' too many", less, less + 1)
            return less + 1
        self.source.problem("'<' must be written as &lt; where it starts no tag", less, less + 1)
        end = text.find("<", less + 1)
        end = len(text) if end < 0 else end
        if self.elements.stack:
            self.elements.children.append(Text(self.source.decoded(less, end, TEXT_SPECIAL)))
        return end

    def _broken_start_tag(self, name: re.Match[str]) -> int:
        """A start tag with something wrong in it, from its name on. Returns where it ends."""
        tag = read_broken_tag(self.source, name)
        name_span = Span(*name.span())
        self.elements.open(name[0], name_span, tag.attributes, tag.end, empty=tag.empty, broken=tag.broken)
        return tag.after

    def _broken_end_tag(self, less: int) -> int:
        """An end tag that lacks its name or its `>`, or has something after its name. Returns where it ends."""
        text = self.source.text
        name = ONE_NAME.match(text, less + 2)
        at = name.end() if name else less + 2
        line_end = self.source.line_end(at)
        next_tag = text.find("<", at, line_end)
        greater = text.find(">", at, line_end if next_tag < 0 else next_tag)
        end = greater + 1 if greater >= 0 else at
        if name is None:
            # Half typed: it is meant for the innermost element, unless that one's own end tag is the next thing.
            inner = self.elements.stack[-1] if self.elements.stack else None
            if inner is None or self.elements.closed_later(inner.tag, end):
                self.source.problem("the name of an end tag is missing", less, at)
            else:
                self.source.problem(f"expected </{inner.tag}>", less, at)
                self.elements.close(len(self.elements.stack) - 1, less, end)
            return end
        if greater < 0:
            self.source.problem(f"the end tag </{name[0]}> has no '>'", *name.span())
        else:
            self.source.problem(f"only the name may stand in the end tag </{name[0]}>", at, greater)
        self.elements.end_tag(name[0], Span(*name.span()), less, end)
        return end

    def _comment(self, less: int) -> int:
        text = self.source.text
        start = less + 4
        close = self.source.find("-->", start)
        end = close + 3
        inner = text.find("<!--", start, close) if close >= 0 else -1
        if inner >= 0:
            end = self._nested_comment_end(less)
            close = end - 3
            if end >= 0:
                self.source.problem("a comment cannot hold another one", inner, inner + 4)
        if close < 0:
            self.source.problem("the comment is not closed with '-->'", less, start)
            close = end = start + len(text[start : self.source.line_end(start)].rstrip(BLANK))
        elif inner < 0:
            dashes = text.find("--", start, close + 1)
            if dashes >= 0:
                self.source.problem("'--' is not allowed in a comment", dashes, dashes + 2)
        body = text[start:close]
        if "\r" in body:
            content = self.source.unified(start, close)
        else:
            content = SpannedText(body, Span(start, close))
        self.elements.children.append(Comment(content, Span(less, end)))
        return end

    def _nested_comment_end(self, less: int) -> int:
        """End of the comment at `less` when its inner ones are paired off; -1 when that leaves it open."""
        if self.comment_ends is None:
            self.comment_ends = {}
            opened: list[int] = []
            for mark in _COMMENT_MARK.finditer(self.source.text):
                if mark[0] == "<!--":
                    opened.append(mark.start())
                elif opened:
                    self.comment_ends[opened.pop()] = mark.end()
        return self.comment_ends.get(less, -1)

    def _cdata(self, less: int) -> int:
        start = less + 9
        close = self.source.find("]]>", start)
        end = close + 3
        if close < 0:
            self.source.problem("the CDATA section is not closed with ']]>'", less, start)
            close = self.source.find("</", start)
            close = end = len(self.source.text) if close < 0 else close
        if not self.elements.stack:
            self.elements.outside_root(less, start, "text")
        raw = self.source.text[start:close]
        content = self.source.unified(start, close) if "\r" in raw else SpannedText(raw, Span(start, close))
        self.elements.children.append(Text(content))
        return end

    def _instruction(self, less: int) -> int:
        text = self.source.text
        close = self.source.find("?>", less + 2)
        declaration = ONE_NAME.match(text, less + 2)
        is_declaration = declaration is not None and declaration[0] == "xml"
        if is_declaration and less > (1 if text.startswith("\ufeff") else 0):
            self.source.problem("the XML declaration must be the very first thing in the file", less, less + 5)
        if close >= 0 and not (is_declaration and text.find("<", less + 1, close) >= 0):
            return close + 2
        self.source.problem("'?>' is missing", less, declaration.end() if declaration else less + 2)
        line_end = self.source.line_end(less)
        greater = text.find(">", less, line_end)
        return greater + 1 if greater >= 0 else line_end

    def _doctype(self, less: int) -> int:
        """A document type declaration: only the names of its entities matter. Returns where it ends."""
        text = self.source.text
        depth = 0
        in_subset = False
        at = less + 2
        while mark := _SUBSET_MARK.search(text, at):
            at = mark.end()
            kind = mark[0]
            if kind in ("<!--", "<?", '"', "'"):
                closing = {"<!--": "-->", "<?": "?>"}.get(kind, kind)
                close = self.source.find(closing, at)
                at = close + len(closing) if close >= 0 else at
            elif kind == "[":
                in_subset = True
            elif kind == "]":
                in_subset = False
            elif kind == "<":
                depth += 1
            elif depth:
                depth -= 1
            elif not in_subset:
                declaration = text[less:at]
                self.doctype = Span(less, at)
                self.source.declared |= frozenset(_ENTITY_DECLARATION.findall(declaration))
                self.source.external = self.source.external or _EXTERNAL.search(declaration) is not None
                return at
        self.source.problem("the DOCTYPE is not closed with '>'", less, less + 9)
        return self.source.line_end(less)
