"""Cutting a value into literals and substitutions, as the grammar of `launch.frontend` does
(ros2/launch, `launch/share/launch/frontend/grammar.lark`).

Unlike in ROS 1 substitutions nest, arguments are separated by one blank and may be quoted, and a backslash takes the
meaning from the character after it.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from preflight_analysis.documents.document import SpannedText
from preflight_analysis.documents.span import Span
from preflight_analysis.launch.model import Literal, Substitution, Value

MAX_NESTING = 50
"""Substitutions nested deeper than this are refused; Python's stack ends at a multiple."""

_Part = Literal | Substitution
_IDENTIFIER = re.compile(r"[A-Za-z][A-Za-z0-9_-]*")
_ESCAPED = re.compile(r"\\(.)", re.DOTALL)


class Arity:
    """How many arguments a substitution takes; `most` None: any number."""

    __slots__ = ("least", "most")

    def __init__(self, least: int, most: int | None) -> None:
        self.least, self.most = least, most

    def __str__(self) -> str:
        if self.most is None:
            return "any number of arguments" if self.least == 0 else f"at least {self.least} arguments"
        if self.least == self.most:
            return "no argument" if not self.least else f"{self.least} argument{'s' if self.least > 1 else ''}"
        return f"{self.least} to {self.most} arguments"


SUBSTITUTIONS_ROS2: Mapping[str, tuple[str, str, Arity]] = {
    "var": ("NAME [DEFAULT]", "The value of a launch configuration: an argument, or what `<let>` set.", Arity(1, 2)),
    "find-pkg-share": ("PACKAGE", "The share folder of a package.", Arity(1, 1)),
    "find-pkg-prefix": ("PACKAGE", "The install prefix of a package.", Arity(1, 1)),
    "exec-in-pkg": ("EXECUTABLE PACKAGE", "The path of an executable of a package.", Arity(2, 2)),
    "find-exec": ("NAME", "The path of an executable on the PATH.", Arity(1, 1)),
    "env": ("NAME [DEFAULT]", "An environment variable, which must be set if there is no default.", Arity(1, 2)),
    "eval": ("EXPRESSION [MODULES]", "A Python expression.", Arity(1, 2)),
    "dirname": ("", "The folder of this launch file.", Arity(0, 0)),
    "filename": ("", "The path of this launch file.", Arity(0, 0)),
    "command": ("COMMAND [ON_STDERR]", "What a command prints.", Arity(1, 2)),
    "anon": ("ID", "A name that is made unique; the same for the same id.", Arity(1, 1)),
    "not": ("VALUE", "true if the value is false.", Arity(1, 1)),
    "and": ("LEFT RIGHT", "true if both are.", Arity(2, 2)),
    "or": ("LEFT RIGHT", "true if one of both is.", Arity(2, 2)),
    "any": ("VALUE...", "true if one of them is.", Arity(0, None)),
    "all": ("VALUE...", "true if all of them are.", Arity(0, None)),
    "equals": ("LEFT RIGHT", "true if both are the same text, number or truth value.", Arity(2, 2)),
    "not-equals": ("LEFT RIGHT", "true if they differ.", Arity(2, 2)),
    "if": ("CONDITION VALUE [OTHERWISE]", "The first value if the condition is true, else the second.", Arity(2, 3)),
    "file-content": ("PATH", "The text of a file.", Arity(1, 1)),
    "param": ("NAME [DEFAULT]", "A parameter that `<set_parameter>` set in this scope.", Arity(1, 2)),
    "launch_log_dir": ("", "The folder of this launch's logs.", Arity(0, 0)),
    "log_dir": ("", "The folder of this launch's logs.", Arity(0, 0)),
    "path-join": ("PART...", "A path made of its parts. Of a launch newer than 3.8.", Arity(0, None)),
    "string-join": ("BETWEEN PART...", "The parts with a text between. Of a launch newer than 3.8.", Arity(2, None)),
    "index": ("NAME", "The round of a `<for>`, from 0. Of a launch newer than 3.7.", Arity(1, 1)),
    "for-var": ("NAME [DEFAULT]", "A variable of a `<for_each>`. Of a launch newer than 3.7.", Arity(1, 2)),
}
"""What each takes, and what it stands for."""


class _Malformed(Exception):  # noqa: N818 - it becomes the problem of a value
    def __init__(self, message: str, start: int, end: int) -> None:
        super().__init__(message)
        self.message, self.start, self.end = message, start, end


def unescaped(text: str) -> str:
    """Without the backslashes that take away the meaning of what follows them."""
    return _ESCAPED.sub(r"\1", text) if "\\" in text else text


def parse_value_ros2(source: SpannedText) -> Value:
    """The value of an attribute or text, cut into pieces; `problem` says why where that failed."""
    text = source.text
    if "$" not in text:
        return Value(text, source.span, (Literal(unescaped(text), source.span),) if text else ())
    reader = _Reader(source)
    try:
        return Value(text, source.span, reader.template(0, len(text), None))
    except _Malformed as error:
        span = source.slice_span(error.start, max(error.start, min(error.end, len(text))))
        parts = (Literal(text, source.span),)
        return Value(text, source.span, parts, error.message, span)


class _Reader:
    """Reads one text from left to right; `at` arguments and results are indices into it."""

    def __init__(self, source: SpannedText) -> None:
        self._source, self._text = source, source.text
        self._depth = 0

    def template(self, at: int, end: int, quote: str | None) -> tuple[_Part, ...]:
        """All of the text; for a quoted argument use `_quoted`."""
        parts, _ = self._fragments(at, end, quote)
        return parts

    def _fragments(self, at: int, end: int, quote: str | None) -> tuple[tuple[_Part, ...], int]:
        """Texts and substitutions up to `end` or the quote that ends them."""
        parts: list[_Part] = []
        start = at
        while at < end:
            character = self._text[at]
            if character == quote and not self._is_escaped(at):
                break
            if character == "$" and self._text.startswith("(", at + 1) and not self._is_escaped(at):
                self._literal(parts, start, at)
                part, at = self._substitution(at, quote)
                parts.append(part)
                start = at
            else:
                at += 1
        self._literal(parts, start, at)
        return tuple(parts), at

    def _is_escaped(self, at: int) -> bool:
        """Whether a backslash stands before it, which may well be the second of two."""
        return at > 0 and self._text[at - 1] == "\\"

    def _literal(self, parts: list[_Part], start: int, end: int) -> None:
        if end > start:
            parts.append(Literal(unescaped(self._text[start:end]), self._source.slice_span(start, end)))

    def _substitution(self, start: int, quote: str | None) -> tuple[Substitution, int]:
        """`$(command argument argument)`; inside of quotes its arguments cannot be quoted themselves."""
        text = self._text
        found = _IDENTIFIER.match(text, start + 2)
        if found is None:
            raise _Malformed("the name of a substitution has to follow '$('", start, start + 2)
        self._depth += 1
        if self._depth > MAX_NESTING:
            raise _Malformed(f"substitutions are nested more than {MAX_NESTING} deep", start, start + 2)
        at = found.end()
        words: list[tuple[_Part, ...]] = []
        while at < len(text) and text[at] == " ":
            word, at = self._word(at + 1, start, quote)
            words.append(word)
        if at >= len(text):
            raise _Malformed("'$(' is never closed", start, found.end())
        if text[at] != ")":
            raise _Malformed(f"'{text[at]}' cannot stand here in a substitution", at, at + 1)
        self._depth -= 1
        begin = min(found.end() + 1, at)
        return (
            Substitution(
                found[0],
                self._source.slice_span(found.start(), found.end()),
                text[begin:at],
                self._source.slice_span(begin, at),
                text[start : at + 1],
                self._source.slice_span(start, at + 1),
                tuple(words),
            ),
            at + 1,
        )

    def _word(self, at: int, start: int, quote: str | None) -> tuple[tuple[_Part, ...], int]:
        """One argument, quoted or not."""
        text = self._text
        if at < len(text) and quote is None and text[at] in "'\"":
            parts, end = self._fragments(at + 1, len(text), text[at])
            if end >= len(text) or text[end] != text[at]:
                raise _Malformed("this quote is never closed", at, at + 1)
            return parts, end + 1
        parts_: list[_Part] = []
        begin = literal = at
        while at < len(text):
            character = text[at]
            if character == " ":
                break
            if self._is_escaped(at):
                at += 1
                continue
            if character == "$" and text.startswith("(", at + 1):
                self._literal(parts_, literal, at)
                part, at = self._substitution(at, quote)
                parts_.append(part)
                literal = at
                continue
            if character in (")", quote):
                break
            if character == "(" or (quote is None and character in "'\""):
                what = "a parenthesis" if character == "(" else "a quote"
                raise _Malformed(f"{what} inside of an argument needs a backslash before it, or quotes", at, at + 1)
            at += 1
        self._literal(parts_, literal, at)
        if at == begin:
            if at >= len(text):
                raise _Malformed("'$(' is never closed", start, start + 2)
            raise _Malformed("exactly one blank separates the arguments of a substitution", at - 1, at + 1)
        return tuple(parts_), at


def nested(parts: tuple[_Part, ...]) -> list[Substitution]:
    """All substitutions of a value, the inner ones too, in the order in which they are written."""
    found: list[Substitution] = []
    for part in parts:
        if isinstance(part, Substitution):
            found.append(part)
            for word in part.words:
                found += nested(word)
    return found


def span_of(parts: tuple[_Part, ...], otherwise: Span) -> Span:
    """From the first to the last of the pieces."""
    return Span(parts[0].span.start, parts[-1].span.end) if parts else otherwise
