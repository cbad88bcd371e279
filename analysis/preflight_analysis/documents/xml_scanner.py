"""A tolerant XML scanner, in the manner of LemMinX's: a tree with spans of any text, and what is wrong in it.

Start tags that are in order are taken by one regular expression each. What it does not take goes piece by piece
through the methods that recover, which guess what was meant: an unclosed quote ends with its line, an unclosed
element where an ancestor ends or where its sibling starts by the indentation. Every guess has its problem, so in a
well-formed text nothing was guessed. No pattern can backtrack more than linearly, nothing recurses.
"""

from __future__ import annotations

import re
from bisect import bisect_left
from collections import Counter, deque
from dataclasses import dataclass

from rapidfuzz.distance import OSA

from preflight_analysis.documents.document import Attribute, Comment, Element, Node, SpannedText, SyntaxProblem, Text
from preflight_analysis.documents.lazy_pattern import lazy_pattern
from preflight_analysis.documents.span import LineIndex, Span

# The names of XML 1.0, fifth edition; those of the fourth, which expat knows, are among them.
_NAME_START = (
    ":A-Z_a-z\xc0-\xd6\xd8-\xf6\xf8-\u02ff\u0370-\u037d\u037f-\u1fff\u200c-\u200d\u2070-\u218f\u2c00-\u2fef"
    "\u3001-\ud7ff\uf900-\ufdcf\ufdf0-\ufffd\U00010000-\U000effff"
)
NAME = f"[{_NAME_START}][{_NAME_START}\\-.0-9\xb7\u0300-\u036f\u203f-\u2040]*"
"""Pattern of an XML name."""

_BLANK = " \t\r\n"
_S = "[ \t\r\n]"
_ATTRIBUTE = lazy_pattern(f"{_S}+({NAME}){_S}*={_S}*(?:\"([^<\"]*)\"|'([^<']*)')")
_START_TAG = lazy_pattern(f"<({NAME})((?:{_S}+{NAME}{_S}*={_S}*(?:\"[^<\"]*\"|'[^<']*'))*){_S}*(/?)>")
_END_TAG = lazy_pattern(f"</({NAME}){_S}*>")
_TAG_MARK = lazy_pattern(f"<(/?)({NAME})(?:[^<>\"']|\"[^\"<]*\"|'[^'<]*')*?(/?)>")
_SPACE = re.compile(f"{_S}*")
_NAME = lazy_pattern(NAME)
_NAME_EQUALS = lazy_pattern(f"{NAME}{_S}*=")
_UNQUOTED = re.compile(r"""(?:\$\([^()<>"'\n]*\)|[^ \t\r\n<>"'/$]|/(?!>)|\$)+""")
_TAG_LIKE = lazy_pattern(f"<[/!?]?[{_NAME_START}]|<!--|</")
_JUNK = lazy_pattern(f"[^{_NAME_START} \t\r\n<>/\"'=]+")
_TEXT_SPECIAL = lazy_pattern(f"&(?:#[0-9]+;|#x[0-9A-Fa-f]+;|{NAME};)?|\r\n?")
_VALUE_SPECIAL = lazy_pattern(f"&(?:#[0-9]+;|#x[0-9A-Fa-f]+;|{NAME};)?|\r\n?|[\n\t]")
_TO_DECODE = re.compile("[&\r\n\t]")
_MISSPELT_COMMENT = re.compile(r"<!?--?(?=[ \t\r\n])")
_SPACED_TAG = lazy_pattern(f"<[ \t]+({NAME})(?={_S}+{NAME}{_S}*=|{_S}*/?>)")
_CONFLICT = re.compile(r"<{7}(?=[ \r\n])")
_AFTER_COMMENT = lazy_pattern(f"{_S}*(?:{NAME}{_S}*=|/?>)")
_UNFINISHED_REFERENCE = re.compile("&(?:lt|gt|amp|quot|apos)(?![A-Za-z0-9])")
_TEXT_OF_TAG = lazy_pattern(f"(?<![\\w<])({NAME}){_S}+{NAME}{_S}*=")
_STRAIGHT_END = re.compile("[^<>\"'= \t\r\n]*[\"'](?=[ \t\r\n/>])")
_COMMENT_MARK = re.compile("<!--|-->")
_NOT_A_CHARACTER = re.compile("[\0-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]+")
_ENTITY_DECLARATION = lazy_pattern(f"<!ENTITY{_S}+({NAME}){_S}")
_EXTERNAL = lazy_pattern(f"<!DOCTYPE{_S}+{NAME}{_S}+(?:SYSTEM|PUBLIC)\\b|%{NAME};")
_SUBSET_MARK = re.compile("<!--|<\\?|[\"'\\[\\]<>]")
_PREDEFINED = {"lt": "<", "gt": ">", "amp": "&", "quot": '"', "apos": "'"}
_CURLY_QUOTES = "\u201c\u201d\u201e\u2018\u2019"
_LOOK_BACK = 50
"""How many nodes before an end tag without a start tag are looked at for one that it might belong to, and how deep
an indentation counts: what is broken again and again must not cost more than its length each time."""
_VALUE_BLANKS = {ord("\n"): " ", ord("\t"): " "}


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


class _Scanner:
    def __init__(self, text: str, lines: LineIndex) -> None:
        self.text = text
        self.lines = lines
        self.top: list[Node] = []
        self.children = self.top
        self.stack: list[_Open] = []
        self.open_tags: Counter[str] = Counter()
        self.root_seen = False
        self.junk_seen = False
        self.problems: list[SyntaxProblem] = []
        self.entities: list[tuple[str, Span]] = []
        self.declared: frozenset[str] = frozenset()
        self.external = False
        self.doctype = Span(0, 0)
        self.found_at: dict[str, tuple[int, int]] = {}
        self.comment_ends: dict[int, int] | None = None
        self.marks: dict[str, tuple[list[int], list[int]]] | None = None

    def scan(self) -> Scan:
        text = self.text
        end = len(text)
        at = 1 if text.startswith("\ufeff") else 0
        while at < end:
            less = text.find("<", at)
            if less < 0:
                less = end
            if less > at:
                self._text(at, less)
            if less == end:
                break
            if tag := _START_TAG.match(text, less):
                self._start_tag(tag)
                at = tag.end()
            elif tag := _END_TAG.match(text, less):
                self._end_tag(tag[1], Span(*tag.span(1)), less, tag.end())
                at = tag.end()
            else:
                at = self._markup(less)
        self._give_up(0, end)
        for bad in _NOT_A_CHARACTER.finditer(text):
            self._problem(f"the character U+{ord(bad[0][0]):04X} is not allowed in XML", *bad.span())
        return Scan(tuple(self.top), tuple(self.problems), tuple(self.entities), self.declared, self.doctype)

    def _problem(self, message: str, start: int, end: int) -> None:
        self.problems.append(SyntaxProblem(message, Span(start, end)))

    def _find(self, needle: str, start: int) -> int:
        """`text.find`, for searches from ever later starts: a far hit, or none, is not searched for again."""
        since, hit = self.found_at.get(needle, (len(self.text) + 1, -1))
        if since > start or 0 <= hit < start:
            hit = self.text.find(needle, start)
            self.found_at[needle] = (start, hit)
        return hit

    def _line_end(self, start: int) -> int:
        """End of the content of the line that `start` is in; at least `start`."""
        line, _ = self.lines.position(start)
        end = self.lines.line_start(line + 1)
        while end > start and self.text[end - 1] in "\r\n":
            end -= 1
        return end

    # Character data

    def _text(self, start: int, end: int) -> None:
        if not self.stack:
            raw = self.text[start:end]
            stripped = raw.strip(_BLANK)
            if not stripped:
                return
            first = start + raw.index(stripped)
            self._outside_root(first, first + len(stripped), "text")
        self.children.append(Text(self._decoded(start, end, _TEXT_SPECIAL)))
        close = self.text.find("]]>", start, end)
        if close >= 0:
            self._problem("']]>' must be written as ]]&gt; in text", close, close + 3)

    def _outside_root(self, start: int, end: int, what: str) -> None:
        if not self.junk_seen:
            self.junk_seen = True
            where = "after" if self.root_seen else "before"
            self._problem(f"{what} {where} the document element", start, end)

    def _decoded(self, start: int, end: int, special: re.Pattern[str]) -> SpannedText:
        raw = self.text[start:end]
        value = special is _VALUE_SPECIAL
        if "&" not in raw and "\r" not in raw:
            if value and ("\n" in raw or "\t" in raw):
                raw = raw.translate(_VALUE_BLANKS)
            return SpannedText(raw, Span(start, end))
        pieces: list[str] = []
        offsets: list[int] = []
        at = start
        for found in special.finditer(self.text, start, end):
            pieces.append(self.text[at : found.start()])
            offsets.extend(range(at, found.start()))
            at = found.end()
            if found[0][0] == "&":
                decoded = self._reference(found[0], found.start())
                pieces.append(decoded)
                offsets.extend(range(found.start(), at) if decoded == found[0] else [found.start()])
            else:
                pieces.append(" " if value else "\n")
                offsets.append(found.start())
        pieces.append(self.text[at:end])
        offsets.extend(range(at, end + 1))
        return SpannedText("".join(pieces), Span(start, end), tuple(offsets))

    def _reference(self, reference: str, at: int) -> str:
        """What `&...;` stands for; itself when it is an error or an entity of the file's own."""
        span = Span(at, at + len(reference))
        name = reference[1:-1]
        if reference == "&":
            unfinished = _UNFINISHED_REFERENCE.match(self.text, at)
            if unfinished:
                self._problem(f"';' is missing after '{unfinished[0]}'", at, unfinished.end())
            else:
                self._problem("'&' must be written as &amp;", at, at + 1)
        elif name.startswith("#"):
            code = _code_point(name[1:])
            if code is not None:
                return chr(code)
            self._problem(f"{reference} is not a character of XML", span.start, span.end)
        elif name in _PREDEFINED:
            return _PREDEFINED[name]
        elif name in self.declared or self.external:
            self.entities.append((name, span))
        else:
            self._problem(f"the entity {reference} is not defined", span.start, span.end)
        return reference

    # Start tags

    def _start_tag(self, tag: re.Match[str]) -> None:
        """A start tag that is in order."""
        attributes: list[Attribute] = []
        start, end = tag.span(2)
        if end > start:
            decodes = _TO_DECODE.search(self.text, start, end)
            for found in _ATTRIBUTE.finditer(self.text, start, end):
                quoted = found.lastindex or 0  # 2 or 3, by the kind of quote
                span = Span(*found.span(quoted))
                value = self._decoded(*span, _VALUE_SPECIAL) if decodes else SpannedText(found[quoted], span)
                name = Span(*found.span(1))
                attributes.append(Attribute(found[1], name, value, Span(name.start, found.end())))
        self._opened(tag[1], Span(*tag.span(1)), attributes, tag.end(), empty=bool(tag[3]))

    def _opened(
        self, tag: str, tag_span: Span, attributes: list[Attribute], end: int, *, empty: bool, broken: bool = False
    ) -> None:
        if len({attribute.name for attribute in attributes}) < len(attributes):
            seen: set[str] = set()
            for attribute in attributes:
                if attribute.name in seen:
                    span = attribute.name_span
                    self._problem(f"the attribute '{attribute.name}' is given twice", span.start, span.end)
                seen.add(attribute.name)
        if not self.stack:
            if self.root_seen:
                self._outside_root(tag_span.start, tag_span.end, "another element")
            self.root_seen = True
        start = tag_span.start - 1
        if empty:
            span = Span(start, end)
            self.children.append(Element(tag, tag_span, tuple(attributes), (), span, span))
            return
        opened = _Open(tag, tag_span, tuple(attributes), Span(start, end), broken)
        self.stack.append(opened)
        self.open_tags[tag] += 1
        self.children = opened.children

    def _broken_start_tag(self, name: re.Match[str]) -> int:
        """A start tag with something wrong in it, from its name on. Returns where it ends."""
        text = self.text
        attributes: list[Attribute] = []
        at = name.end()
        last_start, last_end = name.span()
        reported = False  # whether the last piece has a problem of its own
        while True:
            gap = at
            at = _skip(_SPACE, text, at)
            char = text[at : at + 1]
            if char == ">":
                self._opened(name[0], Span(*name.span()), attributes, at + 1, empty=False)
                return at + 1
            if char == "<" and (comment := self._comment_in_tag(at)) > 0:
                at, reported = comment, True
                last_end = at
                continue
            if char in ("", "<"):
                if not reported:
                    self._problem(f"the tag <{name[0]}> has no '>'", last_start, last_end)
                self._opened(name[0], Span(*name.span()), attributes, last_end, empty=False, broken=True)
                return at
            if char == "\\" and text.startswith(">", at + 1):
                self._problem("'\\' must be '/'", at, at + 1)
                self._opened(name[0], Span(*name.span()), attributes, at + 2, empty=True)
                return at + 2
            if char == "/":
                after = _skip(_SPACE, text, at + 1)
                if text[after : after + 1] in (">", "<", ""):
                    complete = text[after : after + 1] == ">"
                    end = after + 1 if complete else at + 1
                    if not complete or after > at + 1:
                        self._problem("'/' must be followed by '>'", at, at + 1)
                    self._opened(name[0], Span(*name.span()), attributes, end, empty=True)
                    return end
            attribute_name = _NAME.match(text, at)
            count = len(self.problems)
            last_start = at
            if attribute_name:
                if gap == at and not reported:
                    self._problem(f"a blank is missing before '{attribute_name[0]}'", *attribute_name.span())
                attribute = self._broken_attribute(attribute_name)
                attributes.append(attribute)
                at = attribute.span.end
                reported = len(self.problems) > count
            else:
                at = self._stray(at, name[0])
                reported = True
            last_end = at

    def _comment_in_tag(self, at: int) -> int:
        """End of the comment at `at` if the tag goes on behind it, else -1."""
        if not self.text.startswith("<!--", at):
            return -1
        close = self._find("-->", at + 4)
        if close < 0 or not _AFTER_COMMENT.match(self.text, close + 3):
            return -1
        self._problem("a comment cannot stand in a tag", at, close + 3)
        return close + 3

    def _stray(self, at: int, tag: str) -> int:
        """Something in a start tag that is no attribute. Returns where it ends."""
        text = self.text
        if text[at] == "=":
            self._problem("the name of an attribute is missing before '='", at, at + 1)
            return self._broken_value(_skip(_SPACE, text, at + 1), at, at + 1)[1]
        end = max(at + 1, _skip(_JUNK, text, at))
        while (word := _NAME.match(text, end)) and not _NAME_EQUALS.match(text, end):
            end = _skip(_JUNK, text, word.end())
        self._problem(f"{text[at:end]!r} does not belong in the tag <{tag}>", at, end)
        return end

    def _broken_attribute(self, name: re.Match[str]) -> Attribute:
        text = self.text
        name_span = Span(*name.span())
        equals = _skip(_SPACE, text, name.end())
        if equals > name.end() and text[equals : equals + 1] in ('"', "'") and self._line_end(name.end()) > equals:
            self._problem(f"'=' is missing after '{name[0]}'", *name.span())
            value, end = self._broken_quote(equals, text[equals])
            return Attribute(name[0], name_span, value, Span(name.start(), end))
        if text[equals : equals + 1] != "=":
            self._problem(f"the attribute '{name[0]}' has no value", *name.span())
            return Attribute(name[0], name_span, SpannedText("", Span(name.end(), name.end())), name_span)
        after = _skip(_SPACE, text, equals + 1)
        value, end = self._broken_value(after, name.start(), equals + 1)
        return Attribute(name[0], name_span, value, Span(name.start(), end))

    def _broken_value(self, at: int, start: int, after_equals: int) -> tuple[SpannedText, int]:
        """The value that should start at `at`, of an attribute from `start`, and where the attribute ends."""
        text = self.text
        quote = text[at : at + 1]
        if quote and quote in "\"'":
            return self._broken_quote(at, quote)
        unquoted = _UNQUOTED.match(text, at)
        on_next_line = "\n" in text[after_equals:at] or "\r" in text[after_equals:at]
        if unquoted is None or on_next_line or _NAME_EQUALS.match(text, at):
            self._problem(f"a value in quotes is missing after '{text[start:after_equals]}'", start, after_equals)
            return SpannedText("", Span(after_equals, after_equals)), after_equals
        end = unquoted.end()
        if text[end : end + 1] in ('"', "'") and _STRAIGHT_END.match(text, end):
            self._problem(f"the opening {text[end]} is missing", at, end + 1)
            return self._decoded(at, end, _VALUE_SPECIAL), end + 1
        if text[at] in _CURLY_QUOTES and text[end - 1] in _CURLY_QUOTES and end > at + 1:
            self._problem("the quotes must be straight ones", at, end)
            return self._decoded(at + 1, end - 1, _VALUE_SPECIAL), end
        self._problem("the value must stand in quotes", at, end)
        return self._decoded(at, end, _VALUE_SPECIAL), end

    def _broken_quote(self, at: int, quote: str) -> tuple[SpannedText, int]:
        """A value that starts with a quote: it may lack its closing one, or hold a `<`."""
        start = at + 1
        close = self._find(quote, start)
        doubled = _STRAIGHT_END.match(self.text, start + 1) if close == start else None
        if doubled and doubled.end() > start + 2:
            self._problem(f"there is one {quote} too many", start, start + 1)
            return self._decoded(start + 1, doubled.end() - 1, _VALUE_SPECIAL), doubled.end()
        end = self._unclosed_value_end(start, close)
        if end >= 0 and (mixed := _STRAIGHT_END.match(self.text, start)):
            self._problem(f"the value starts with {quote} and ends with {mixed[0][-1]}", at, mixed.end())
            return self._decoded(start, mixed.end() - 1, _VALUE_SPECIAL), mixed.end()
        if end < 0:
            less = self.text.find("<", start, close)
            while less >= 0:
                self._problem("'<' must be written as &lt; in a value", less, less + 1)
                less = self.text.find("<", less + 1, close)
            return self._decoded(start, close, _VALUE_SPECIAL), close + 1
        self._problem(f"the closing {quote} is missing", at, end)
        return self._decoded(start, end, _VALUE_SPECIAL), end

    def _unclosed_value_end(self, start: int, close: int) -> int:
        """Where the value from `start` ends if it lacks its closing quote; -1 if the quote at `close` is that.

        It is not when it opens the next attribute's value, or when a tag starts on a line in between.
        """
        text = self.text
        line_end = self._line_end(start)
        tag = _TAG_LIKE.search(text, start, close if close >= 0 else line_end)
        end = line_end
        if close >= 0:
            closes = text[close + 1 : close + 2] in ("", ">", *_BLANK) or text.startswith("/>", close + 1)
            next_attribute = -1 if closes else _before_next_attribute(text[start:close])
            if next_attribute >= 0:
                end = min(end, start + next_attribute)
            elif not (tag and tag.start() > line_end):
                return -1
        if tag and tag.start() < end:
            end = tag.start()
        kept = text[start:end].rstrip(_BLANK)
        if kept.endswith(">"):
            kept = kept[:-1].removesuffix("/").rstrip(_BLANK)
        return start + len(kept)

    # Other markup

    def _markup(self, less: int) -> int:
        """What starts with `<` and is neither a start tag nor an end tag in order. Returns where it ends."""
        text = self.text
        if name := _NAME.match(text, less + 1):
            if name[0] == "xml" and not self.stack and not self.root_seen:
                self._problem("the XML declaration starts with '<?xml'", less, name.end())
                greater = text.find(">", less, self._line_end(less))
                return greater + 1 if greater >= 0 else self._line_end(less)
            return self._broken_start_tag(name)
        if text.startswith("</", less):
            return self._broken_end_tag(less)
        if text.startswith("<!--", less):
            return self._comment(less)
        if text.startswith("<![CDATA[", less):
            return self._cdata(less)
        if text.startswith("<?", less):
            return self._instruction(less)
        if text.startswith("<!DOCTYPE", less) and not self.stack:
            return self._doctype(less)
        if spaced := _SPACED_TAG.match(text, less):
            self._problem("there cannot be a blank after the '<' of a tag", less, spaced.end())
            name = _NAME.match(text, spaced.start(1))
            if name is not None:
                return self._broken_start_tag(name)
        if misspelt := _MISSPELT_COMMENT.match(text, less):
            self._problem("a comment starts with '<!--'", *misspelt.span())
            close = self._find("-->", misspelt.end())
            if 0 <= close < self._line_end(less):
                content = SpannedText(text[misspelt.end() : close], Span(misspelt.end(), close))
                self.children.append(Comment(content, Span(less, close + 3)))
                return close + 3
            return misspelt.end()
        if conflict := _CONFLICT.match(text, less):
            self._problem("this is the mark of a merge conflict", *conflict.span())
            return conflict.end()
        if text.startswith("<<", less):
            self._problem("there is one '<' too many", less, less + 1)
            return less + 1
        self._problem("'<' must be written as &lt; where it starts no tag", less, less + 1)
        end = text.find("<", less + 1)
        end = len(text) if end < 0 else end
        if self.stack:
            self.children.append(Text(self._decoded(less, end, _TEXT_SPECIAL)))
        return end

    def _comment(self, less: int) -> int:
        text = self.text
        start = less + 4
        close = self._find("-->", start)
        end = close + 3
        inner = text.find("<!--", start, close) if close >= 0 else -1
        if inner >= 0:
            end = self._nested_comment_end(less)
            close = end - 3
            if end >= 0:
                self._problem("a comment cannot hold another one", inner, inner + 4)
        if close < 0:
            self._problem("the comment is not closed with '-->'", less, start)
            close = end = start + len(text[start : self._line_end(start)].rstrip(_BLANK))
        elif inner < 0:
            dashes = text.find("--", start, close + 1)
            if dashes >= 0:
                self._problem("'--' is not allowed in a comment", dashes, dashes + 2)
        body = text[start:close]
        if "\r" in body:
            content = self._unified(start, close)
        else:
            content = SpannedText(body, Span(start, close))
        self.children.append(Comment(content, Span(less, end)))
        return end

    def _unified(self, start: int, end: int) -> SpannedText:
        """Text that holds no references, with its line ends as XML has them."""
        offsets = [at for at in range(start, end) if self.text[at] != "\n" or self.text[at - 1] != "\r"]
        unified = self.text[start:end].replace("\r\n", "\n").replace("\r", "\n")
        return SpannedText(unified, Span(start, end), (*offsets, end))

    def _nested_comment_end(self, less: int) -> int:
        """End of the comment at `less` when its inner ones are paired off; -1 when that leaves it open."""
        if self.comment_ends is None:
            self.comment_ends = {}
            opened: list[int] = []
            for mark in _COMMENT_MARK.finditer(self.text):
                if mark[0] == "<!--":
                    opened.append(mark.start())
                elif opened:
                    self.comment_ends[opened.pop()] = mark.end()
        return self.comment_ends.get(less, -1)

    def _cdata(self, less: int) -> int:
        start = less + 9
        close = self._find("]]>", start)
        end = close + 3
        if close < 0:
            self._problem("the CDATA section is not closed with ']]>'", less, start)
            close = self._find("</", start)
            close = end = len(self.text) if close < 0 else close
        if not self.stack:
            self._outside_root(less, start, "text")
        raw = self.text[start:close]
        content = self._unified(start, close) if "\r" in raw else SpannedText(raw, Span(start, close))
        self.children.append(Text(content))
        return end

    def _instruction(self, less: int) -> int:
        text = self.text
        close = self._find("?>", less + 2)
        declaration = _NAME.match(text, less + 2)
        is_declaration = declaration is not None and declaration[0] == "xml"
        if is_declaration and less > (1 if text.startswith("\ufeff") else 0):
            self._problem("the XML declaration must be the very first thing in the file", less, less + 5)
        if close >= 0 and not (is_declaration and text.find("<", less + 1, close) >= 0):
            return close + 2
        self._problem("'?>' is missing", less, declaration.end() if declaration else less + 2)
        line_end = self._line_end(less)
        greater = text.find(">", less, line_end)
        return greater + 1 if greater >= 0 else line_end

    def _doctype(self, less: int) -> int:
        """A document type declaration: only the names of its entities matter. Returns where it ends."""
        text = self.text
        depth = 0
        in_subset = False
        at = less + 2
        while mark := _SUBSET_MARK.search(text, at):
            at = mark.end()
            kind = mark[0]
            if kind in ("<!--", "<?", '"', "'"):
                closing = {"<!--": "-->", "<?": "?>"}.get(kind, kind)
                close = self._find(closing, at)
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
                self.declared |= frozenset(_ENTITY_DECLARATION.findall(declaration))
                self.external = self.external or _EXTERNAL.search(declaration) is not None
                return at
        self._problem("the DOCTYPE is not closed with '>'", less, less + 9)
        return self._line_end(less)

    # The ends of elements

    def _broken_end_tag(self, less: int) -> int:
        """An end tag that lacks its name or its `>`, or has something after its name. Returns where it ends."""
        text = self.text
        name = _NAME.match(text, less + 2)
        at = name.end() if name else less + 2
        line_end = self._line_end(at)
        next_tag = text.find("<", at, line_end)
        greater = text.find(">", at, line_end if next_tag < 0 else next_tag)
        end = greater + 1 if greater >= 0 else at
        if name is None:
            # Half typed: it is meant for the innermost element, unless that one's own end tag is the next thing.
            inner = self.stack[-1] if self.stack else None
            if inner is None or self._closed_later(inner.tag, end):
                self._problem("the name of an end tag is missing", less, at)
            else:
                self._problem(f"expected </{inner.tag}>", less, at)
                self._close(len(self.stack) - 1, less, end)
            return end
        if greater < 0:
            self._problem(f"the end tag </{name[0]}> has no '>'", *name.span())
        else:
            self._problem(f"only the name may stand in the end tag </{name[0]}>", at, greater)
        self._end_tag(name[0], Span(*name.span()), less, end)
        return end

    def _end_tag(self, tag: str, tag_span: Span, start: int, end: int) -> None:
        if self.stack and self.stack[-1].tag == tag:
            self._close(len(self.stack) - 1, start, end)
        elif self.stack and self._stands_for_another(tag, start, end):
            self._problem(f"expected </{self.stack[-1].tag}>", tag_span.start, tag_span.end)
            self._close(len(self.stack) - 1, start, end)
        elif self.open_tags[tag]:
            index = next(i for i in range(len(self.stack) - 1, -1, -1) if self.stack[i].tag == tag)
            self._close(index, start, end)
        elif self.stack and _resembles(tag, self.stack[-1].tag):
            self._problem(f"expected </{self.stack[-1].tag}>", tag_span.start, tag_span.end)
            self._close(len(self.stack) - 1, start, end)
        elif (lost := self._lost_start(tag)) is not None:
            self._problem(f"'<' is missing before '{tag}'", lost, lost + len(tag))
        else:
            how = ", it is closed by its '/>' already" if self._closed_itself(tag, start) else ""
            self._problem(f"</{tag}> closes nothing{how}", tag_span.start, tag_span.end)

    def _closed_later(self, tag: str, at: int) -> bool:
        """Whether the innermost element, of this tag, has an end tag of its own behind `at`."""
        if self.marks is None:
            self.marks = {}
            for mark in _TAG_MARK.finditer(self.text):
                if not mark[3]:
                    self.marks.setdefault(mark[2], ([], []))[bool(mark[1])].append(mark.start())
        starts, ends = self.marks.get(tag, ([], []))
        still_open = self.open_tags[tag] + len(starts) - bisect_left(starts, at)
        return len(ends) - bisect_left(ends, at) >= still_open

    def _stands_for_another(self, tag: str, start: int, end: int) -> bool:
        """Whether an end tag of the wrong name stands where that of the innermost element should, by its indentation.

        It does not if the right one follows, unless the two are swapped.
        """
        inner = self.stack[-1]
        column = self._indentation(start)
        if column is None or column != self._indentation(inner.open_span.start):
            return False
        following = _END_TAG.match(self.text, _skip(_SPACE, self.text, end))
        right_one_follows = following is not None and following[1] == inner.tag
        if not self.open_tags[tag]:
            return not right_one_follows
        outer = self.stack[-2] if len(self.stack) > 1 else None
        return right_one_follows and outer is not None and outer.tag == tag and inner.tag != tag

    def _indentation(self, at: int) -> int | None:
        """The column of `at` if nothing stands before it on its line."""
        _, column = self.lines.position(at)
        return column if column <= _LOOK_BACK and not self.text[at - column : at].strip(_BLANK) else None

    def _lost_start(self, tag: str) -> int | None:
        """Where `tag name=` stands in the text before an end tag that has no start."""
        for node in self.children[: -_LOOK_BACK - 1 : -1]:
            if (
                isinstance(node, Text)
                and self.text.find(tag, node.content.span.start, node.content.span.start + 200) >= 0
            ):
                for found in _TEXT_OF_TAG.finditer(node.content.text, 0, 200):
                    if found[1] == tag:
                        return node.content.to_document(found.start(1))
        return None

    def _closed_itself(self, tag: str, start: int) -> bool:
        """Whether an element of the tag before it, as deep as the end tag, ends with `/>`."""
        _, column = self.lines.position(start)
        return any(
            isinstance(node, Element)
            and node.tag == tag
            and node.span == node.open_span
            and self.lines.position(node.span.start)[1] == column
            for node in self.children[: -_LOOK_BACK - 1 : -1]
        )

    def _close(self, index: int, start: int, end: int) -> None:
        """The end tag at `start` belongs to `stack[index]`; what is open in it has none."""
        if index + 1 < len(self.stack):
            self._give_up(index + 1, start)
        opened = self.stack.pop()
        self.open_tags[opened.tag] -= 1
        self.children = self.stack[-1].children if self.stack else self.top
        self.children.append(opened.closed(end))

    def _give_up(self, keep: int, at: int) -> None:
        """Close the elements above `stack[:keep]`, which have no end tag, at `at` or where a sibling starts.

        Its children from the first that is not indented deeper are its siblings, as whoever wrote them sees it.
        """
        siblings: deque[Node] = deque()
        reported = False
        while len(self.stack) > keep:
            opened = self.stack.pop()
            self.open_tags[opened.tag] -= 1
            self.children = self.stack[-1].children if self.stack else self.top
            cut = self._first_sibling(opened)
            if not opened.broken and not reported:
                if len(self.stack) > keep and self._is_end_tag(opened, self.stack[-1]):
                    self._problem(f"'/' is missing: </{opened.tag}> is expected", *_ends(opened.tag_span))
                    reported = True
                elif lost := self._lost_end(opened, cut):
                    cut = lost[0]
                    self._problem(f"'<' is missing before '/{opened.tag}>'", *lost[1])
                else:
                    self._problem(f"<{opened.tag}> is not closed", *_ends(opened.tag_span))
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
        column = self._indentation(opened.open_span.start)
        return column is not None and column == self._indentation(outer.open_span.start)

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
        line, column = self.lines.position(opened.open_span.start)
        node_line, node_column = self.lines.position(node.span.start)
        if node_line == line:
            return opened.broken
        return node_column <= column


def _ends(span: Span) -> tuple[int, int]:
    return span.start, span.end


def _skip(pattern: re.Pattern[str], text: str, at: int) -> int:
    found = pattern.match(text, at)
    return found.end() if found else at


def _start(node: Node) -> int:
    return node.content.span.start if isinstance(node, Text) else node.span.start


def _code_point(digits: str) -> int | None:
    """The code point of a character reference without `&#` and `;`, None when XML does not allow it."""
    base, digits = (16, digits[1:]) if digits.startswith("x") else (10, digits)
    digits = digits.lstrip("0")
    code = int(digits or "0", base) if len(digits) <= 7 else 0x110000
    if code > 0x10FFFF or (code < 0x20 and chr(code) not in "\t\n\r"):
        return None
    return None if 0xD800 <= code <= 0xDFFF or code in (0xFFFE, 0xFFFF) else code


def _before_next_attribute(value: str) -> int:
    """Length of `value` before ` name=` at its end, -1 when it does not end so."""
    head = value.rstrip(_BLANK)
    if not head.endswith("="):
        return -1
    head = head[:-1].rstrip(_BLANK)
    blank = max(head.rfind(char) for char in _BLANK)
    if blank < 0 or not _NAME.fullmatch(head, blank + 1):
        return -1
    return len(head[:blank].rstrip(_BLANK))


def _resembles(typed: str, meant: str) -> bool:
    """Whether an end tag's name is the element's name mistyped, or the beginning of it."""
    typed, meant = typed.lower(), meant.lower()
    return meant.startswith(typed) or OSA.distance(typed, meant) <= max(1, len(meant) // 3)
