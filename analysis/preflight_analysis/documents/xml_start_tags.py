"""Start tags of XML: those that are in order, and those that are guessed from what is wrong in them.

An unclosed quote ends with its line, or before what looks like the next attribute or tag.
"""

from __future__ import annotations

import re

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Attribute, SpannedText
from preflight_analysis.documents.lazy_pattern import lazy_pattern
from preflight_analysis.documents.span import Span
from preflight_analysis.documents.xml_patterns import (
    BLANK,
    NAME,
    NAME_EQUALS,
    NAME_START,
    NO_NAME_STARTS,
    ONE_NAME,
    SPACE,
    VALUE_SPECIAL,
    S,
    skip,
)
from preflight_analysis.documents.xml_source import XmlSource

START_TAG = lazy_pattern(f"<({NAME})((?:{S}+{NAME}{S}*={S}*(?:\"[^<\"]*\"|'[^<']*'))*){S}*(/?)>")
"""One that is in order: its name, its attributes, and `/` if the element is empty."""
_ATTRIBUTE = lazy_pattern(f"{S}+({NAME}){S}*={S}*(?:\"([^<\"]*)\"|'([^<']*)')")
_TO_DECODE = re.compile("[&\r\n\t]")
_UNQUOTED = re.compile(r"""(?:\$\([^()<>"'\n]*\)|[^ \t\r\n<>"'/$]|/(?!>)|\$)+""")
_TAG_LIKE = lazy_pattern(f"<[/!?]?{NAME_START}|<!--|</")
_JUNK = lazy_pattern(f"(?:(?![ \t\r\n<>/\"'=])[{NO_NAME_STARTS}])+")
_AFTER_COMMENT = lazy_pattern(f"{S}*(?:{NAME}{S}*=|/?>)")
_STRAIGHT_END = re.compile("[^<>\"'= \t\r\n]*[\"'](?=[ \t\r\n/>])")
_CURLY_QUOTES = "\u201c\u201d\u201e\u2018\u2019"


def attributes_of(source: XmlSource, tag: re.Match[str]) -> list[Attribute]:
    """The attributes of a start tag that is in order (`START_TAG`)."""
    attributes: list[Attribute] = []
    start, end = tag.span(2)
    if end > start:
        decodes = _TO_DECODE.search(source.text, start, end)
        for found in _ATTRIBUTE.finditer(source.text, start, end):
            quoted = found.lastindex or 0  # 2 or 3, by the kind of quote
            span = Span(*found.span(quoted))
            value = source.decoded(*span, VALUE_SPECIAL) if decodes else SpannedText(found[quoted], span)
            name = Span(*found.span(1))
            attributes.append(Attribute(found[1], name, value, Span(name.start, found.end())))
    return attributes


@dataclass(frozen=True, slots=True)
class BrokenTag:
    """What a start tag with something wrong in it was meant to be. The scan goes on at `after`, which is behind `end`
    where the tag has no `>` (`broken`)."""

    attributes: list[Attribute]
    end: int
    after: int
    empty: bool = False
    broken: bool = False


def read_broken_tag(source: XmlSource, name: re.Match[str]) -> BrokenTag:
    """A start tag with something wrong in it, from its name on."""
    return _Reader(source).tag(name)


class _Reader:
    def __init__(self, source: XmlSource) -> None:
        self.source = source

    def tag(self, name: re.Match[str]) -> BrokenTag:
        text = self.source.text
        attributes: list[Attribute] = []
        at = name.end()
        last_start, last_end = name.span()
        reported = False  # whether the last piece has a problem of its own
        while True:
            gap = at
            at = skip(SPACE, text, at)
            char = text[at : at + 1]
            if char == ">":
                return BrokenTag(attributes, at + 1, at + 1)
            if char == "<" and (comment := self._comment_in_tag(at)) > 0:
                at, reported = comment, True
                last_end = at
                continue
            if char in ("", "<"):
                if not reported:
                    self.source.problem(f"the tag <{name[0]}> has no '>'", last_start, last_end)
                return BrokenTag(attributes, last_end, at, broken=True)
            if char == "\\" and text.startswith(">", at + 1):
                self.source.problem("'\\' must be '/'", at, at + 1)
                return BrokenTag(attributes, at + 2, at + 2, empty=True)
            if char == "/":
                after = skip(SPACE, text, at + 1)
                if text[after : after + 1] in (">", "<", ""):
                    complete = text[after : after + 1] == ">"
                    end = after + 1 if complete else at + 1
                    if not complete or after > at + 1:
                        self.source.problem("'/' must be followed by '>'", at, at + 1)
                    return BrokenTag(attributes, end, end, empty=True)
            attribute_name = ONE_NAME.match(text, at)
            count = len(self.source.problems)
            last_start = at
            if attribute_name:
                if gap == at and not reported:
                    self.source.problem(f"a blank is missing before '{attribute_name[0]}'", *attribute_name.span())
                attribute = self._attribute(attribute_name)
                attributes.append(attribute)
                at = attribute.span.end
                reported = len(self.source.problems) > count
            else:
                at = self._stray(at, name[0])
                reported = True
            last_end = at

    def _comment_in_tag(self, at: int) -> int:
        """End of the comment at `at` if the tag goes on behind it, else -1."""
        if not self.source.text.startswith("<!--", at):
            return -1
        close = self.source.find("-->", at + 4)
        if close < 0 or not _AFTER_COMMENT.match(self.source.text, close + 3):
            return -1
        self.source.problem("a comment cannot stand in a tag", at, close + 3)
        return close + 3

    def _stray(self, at: int, tag: str) -> int:
        """Something in a start tag that is no attribute. Returns where it ends."""
        text = self.source.text
        if text[at] == "=":
            self.source.problem("the name of an attribute is missing before '='", at, at + 1)
            return self._value(skip(SPACE, text, at + 1), at, at + 1)[1]
        end = max(at + 1, skip(_JUNK, text, at))
        while (word := ONE_NAME.match(text, end)) and not NAME_EQUALS.match(text, end):
            end = skip(_JUNK, text, word.end())
        self.source.problem(f"{text[at:end]!r} does not belong in the tag <{tag}>", at, end)
        return end

    def _attribute(self, name: re.Match[str]) -> Attribute:
        text = self.source.text
        name_span = Span(*name.span())
        equals = skip(SPACE, text, name.end())
        if (
            equals > name.end()
            and text[equals : equals + 1] in ('"', "'")
            and self.source.line_end(name.end()) > equals
        ):
            self.source.problem(f"'=' is missing after '{name[0]}'", *name.span())
            value, end = self._quote(equals, text[equals])
            return Attribute(name[0], name_span, value, Span(name.start(), end))
        if text[equals : equals + 1] != "=":
            self.source.problem(f"the attribute '{name[0]}' has no value", *name.span())
            return Attribute(name[0], name_span, SpannedText("", Span(name.end(), name.end())), name_span)
        after = skip(SPACE, text, equals + 1)
        value, end = self._value(after, name.start(), equals + 1)
        return Attribute(name[0], name_span, value, Span(name.start(), end))

    def _value(self, at: int, start: int, after_equals: int) -> tuple[SpannedText, int]:
        """The value that should start at `at`, of an attribute from `start`, and where the attribute ends."""
        text = self.source.text
        quote = text[at : at + 1]
        if quote and quote in "\"'":
            return self._quote(at, quote)
        unquoted = _UNQUOTED.match(text, at)
        on_next_line = "\n" in text[after_equals:at] or "\r" in text[after_equals:at]
        if unquoted is None or on_next_line or NAME_EQUALS.match(text, at):
            self.source.problem(f"a value in quotes is missing after '{text[start:after_equals]}'", start, after_equals)
            return SpannedText("", Span(after_equals, after_equals)), after_equals
        end = unquoted.end()
        if text[end : end + 1] in ('"', "'") and _STRAIGHT_END.match(text, end):
            self.source.problem(f"the opening {text[end]} is missing", at, end + 1)
            return self.source.decoded(at, end, VALUE_SPECIAL), end + 1
        if text[at] in _CURLY_QUOTES and text[end - 1] in _CURLY_QUOTES and end > at + 1:
            self.source.problem("the quotes must be straight ones", at, end)
            return self.source.decoded(at + 1, end - 1, VALUE_SPECIAL), end
        self.source.problem("the value must stand in quotes", at, end)
        return self.source.decoded(at, end, VALUE_SPECIAL), end

    def _quote(self, at: int, quote: str) -> tuple[SpannedText, int]:
        """A value that starts with a quote: it may lack its closing one, or hold a `<`."""
        start = at + 1
        close = self.source.find(quote, start)
        doubled = _STRAIGHT_END.match(self.source.text, start + 1) if close == start else None
        if doubled and doubled.end() > start + 2:
            self.source.problem(f"there is one {quote} too many", start, start + 1)
            return self.source.decoded(start + 1, doubled.end() - 1, VALUE_SPECIAL), doubled.end()
        end = self._unclosed_value_end(start, close)
        if end >= 0 and (mixed := _STRAIGHT_END.match(self.source.text, start)):
            self.source.problem(f"the value starts with {quote} and ends with {mixed[0][-1]}", at, mixed.end())
            return self.source.decoded(start, mixed.end() - 1, VALUE_SPECIAL), mixed.end()
        if end < 0:
            less = self.source.text.find("<", start, close)
            while less >= 0:
                self.source.problem("'<' must be written as &lt; in a value", less, less + 1)
                less = self.source.text.find("<", less + 1, close)
            return self.source.decoded(start, close, VALUE_SPECIAL), close + 1
        self.source.problem(f"the closing {quote} is missing", at, end)
        return self.source.decoded(start, end, VALUE_SPECIAL), end

    def _unclosed_value_end(self, start: int, close: int) -> int:
        """Where the value from `start` ends if it lacks its closing quote; -1 if the quote at `close` is that.

        It is not when it opens the next attribute's value, or when a tag starts on a line in between.
        """
        text = self.source.text
        line_end = self.source.line_end(start)
        tag = _TAG_LIKE.search(text, start, close if close >= 0 else line_end)
        end = line_end
        if close >= 0:
            closes = text[close + 1 : close + 2] in ("", ">", *BLANK) or text.startswith("/>", close + 1)
            next_attribute = -1 if closes else _before_next_attribute(text[start:close])
            if next_attribute >= 0:
                end = min(end, start + next_attribute)
            elif not (tag and tag.start() > line_end):
                return -1
        if tag and tag.start() < end:
            end = tag.start()
        kept = text[start:end].rstrip(BLANK)
        if kept.endswith(">"):
            kept = kept[:-1].removesuffix("/").rstrip(BLANK)
        return start + len(kept)


def _before_next_attribute(value: str) -> int:
    """Length of `value` before ` name=` at its end, -1 when it does not end so."""
    head = value.rstrip(BLANK)
    if not head.endswith("="):
        return -1
    head = head[:-1].rstrip(BLANK)
    blank = max(head.rfind(char) for char in BLANK)
    if blank < 0 or not ONE_NAME.fullmatch(head, blank + 1):
        return -1
    return len(head[:blank].rstrip(BLANK))
