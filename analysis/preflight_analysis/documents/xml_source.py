"""A text of XML that is being scanned: its characters and references decoded, what is wrong in it gathered."""

from __future__ import annotations

import re

from preflight_analysis.documents.document import SpannedText, SyntaxProblem
from preflight_analysis.documents.span import LineIndex, Span
from preflight_analysis.documents.xml_patterns import BLANK, VALUE_SPECIAL

_UNFINISHED_REFERENCE = re.compile("&(?:lt|gt|amp|quot|apos)(?![A-Za-z0-9])")
_PREDEFINED = {"lt": "<", "gt": ">", "amp": "&", "quot": '"', "apos": "'"}
_VALUE_BLANKS = {ord("\n"): " ", ord("\t"): " "}
_DEEPEST = 50
"""The deepest indentation that counts: what is broken again and again must not cost more than its length each time."""


class XmlSource:
    """`problems` in the order in which they were found; `entities` are the uses of those that the DOCTYPE declares
    (`declared`), or may declare where it refers to another file (`external`)."""

    def __init__(self, text: str, lines: LineIndex) -> None:
        self.text = text
        self.lines = lines
        self.problems: list[SyntaxProblem] = []
        self.entities: list[tuple[str, Span]] = []
        self.declared: frozenset[str] = frozenset()
        self.external = False
        self._found_at: dict[str, tuple[int, int]] = {}

    def problem(self, message: str, start: int, end: int) -> None:
        """Something is wrong from `start` to `end`."""
        self.problems.append(SyntaxProblem(message, Span(start, end)))

    def find(self, needle: str, start: int) -> int:
        """`text.find`, for searches from ever later starts: a far hit, or none, is not searched for again."""
        since, hit = self._found_at.get(needle, (len(self.text) + 1, -1))
        if since > start or 0 <= hit < start:
            hit = self.text.find(needle, start)
            self._found_at[needle] = (start, hit)
        return hit

    def line_end(self, start: int) -> int:
        """End of the content of the line that `start` is in; at least `start`."""
        line, _ = self.lines.position(start)
        end = self.lines.line_start(line + 1)
        while end > start and self.text[end - 1] in "\r\n":
            end -= 1
        return end

    def indentation(self, at: int) -> int | None:
        """The column of `at` if nothing stands before it on its line."""
        _, column = self.lines.position(at)
        return column if column <= _DEEPEST and not self.text[at - column : at].strip(BLANK) else None

    def decoded(self, start: int, end: int, special: re.Pattern[str]) -> SpannedText:
        """A value (`VALUE_SPECIAL`) or text (`TEXT_SPECIAL`) with its references and line ends as XML reads them."""
        raw = self.text[start:end]
        value = special is VALUE_SPECIAL
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
                self.problem(f"';' is missing after '{unfinished[0]}'", at, unfinished.end())
            else:
                self.problem("'&' must be written as &amp;", at, at + 1)
        elif name.startswith("#"):
            code = _code_point(name[1:])
            if code is not None:
                return chr(code)
            self.problem(f"{reference} is not a character of XML", span.start, span.end)
        elif name in _PREDEFINED:
            return _PREDEFINED[name]
        elif name in self.declared or self.external:
            self.entities.append((name, span))
        else:
            self.problem(f"the entity {reference} is not defined", span.start, span.end)
        return reference

    def unified(self, start: int, end: int) -> SpannedText:
        """Text that holds no references, with its line ends as XML has them."""
        offsets = [at for at in range(start, end) if self.text[at] != "\n" or self.text[at - 1] != "\r"]
        unified = self.text[start:end].replace("\r\n", "\n").replace("\r", "\n")
        return SpannedText(unified, Span(start, end), (*offsets, end))


def _code_point(digits: str) -> int | None:
    """The code point of a character reference without `&#` and `;`, None when XML does not allow it."""
    base, digits = (16, digits[1:]) if digits.startswith("x") else (10, digits)
    digits = digits.lstrip("0")
    code = int(digits or "0", base) if len(digits) <= 7 else 0x110000
    if code > 0x10FFFF or (code < 0x20 and chr(code) not in "\t\n\r"):
        return None
    return None if 0xD800 <= code <= 0xDFFF or code in (0xFFFE, 0xFFFF) else code
