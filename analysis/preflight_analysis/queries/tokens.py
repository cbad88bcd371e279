"""The substitutions inside of values, cut into pieces to be coloured."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Literal, NamedTuple, get_args

from preflight_analysis.documents.span import Span
from preflight_analysis.launch.model import Action, LaunchFile, Substitution, Value
from preflight_analysis.launch.references import NAMES, Named

TokenKind = Literal["keyword", "operator", "parameter", "namespace", "variable", "function", "number", "string"]
"""Semantic token types of LSP: `parameter` for arguments, `namespace` for packages, `variable` for those of the
environment and for what `$(anon)` names."""
KINDS: tuple[TokenKind, ...] = get_args(TokenKind)

_OF_NAMED: Mapping[Named, TokenKind] = {
    "argument": "parameter",
    "package": "namespace",
    "variable": "variable",
    "identifier": "variable",
}
_OF_COMMAND = {command: _OF_NAMED[named] for command, named in NAMES.items()}
_EXPRESSION = re.compile(
    r"""(?P<string>'(?:\\.|[^'\\])*'|"(?:\\.|[^"\\])*"|&quot;.*?&quot;|&apos;.*?&apos;)"""
    r"|(?P<number>\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+)"
    r"|(?P<name>[^\W\d]\w*)"
    r"|(?P<operator>&(?:lt|gt|amp);=?|\*\*|//|[=!]=|[-+*/%<>|^~])"
)
_WORDS = frozenset({"and", "or", "not", "in", "is", "if", "else", "True", "False", "None", "true", "false"})
_CALLED = re.compile(r"\s*\(")
_LINE_END = re.compile(r"[\r\n]")
_LINE = re.compile(r"[^\r\n]+")


class Token(NamedTuple):
    """A piece of a substitution; it never goes over the end of a line."""

    span: Span
    kind: TokenKind


def tokens(launch_file: LaunchFile, within: Span | None = None) -> tuple[Token, ...]:
    """The tokens of a file in order, or of the values that touch `within`."""
    return tuple(sorted(_tokens(launch_file, within)))


def _tokens(launch_file: LaunchFile, within: Span | None) -> Iterator[Token]:
    text = launch_file.document.text
    within = within or Span(0, len(text))
    for value in _values(launch_file.root, within) if launch_file.root is not None else ():
        one_line = not _LINE_END.search(text, value.span.start, value.span.end)
        for part in value.substitutions:
            if one_line:
                yield from _of(text, part)
                continue
            for token in _of(text, part):
                for line in _LINE.finditer(text, token.span.start, token.span.end):
                    yield Token(Span(*line.span()), token.kind)


def _values(action: Action, within: Span) -> Iterator[Value]:
    """Those with substitutions, below an action; what lies wholly outside is not looked into."""
    values = [attribute.value for attribute in action.attributes]
    if action.value("subst_value") is not None:
        values.append(action.body)
    for value in values:
        if "$" in value.text and value.span.end >= within.start and value.span.start <= within.end:
            yield value
    for child in action.children:
        if child.span.end >= within.start and child.span.start <= within.end:
            yield from _values(child, within)


def _of(text: str, part: Substitution) -> Iterator[Token]:
    yield Token(Span(part.span.start, part.span.start + 2), "operator")
    if part.command_span.end > part.command_span.start:
        yield Token(part.command_span, "keyword")
    span = part.arguments_span
    if part.words:
        yield from _of_words(text, part)
    elif part.command == "eval":
        yield from _of_expression(text, span)
    elif part.command in _OF_COMMAND and span.end > span.start:
        first = span.start + len(text[span.start : span.end].split(" ", 1)[0])
        yield Token(Span(span.start, first), _OF_COMMAND[part.command])
        if part.command == "optenv" and first + 1 < span.end:
            yield Token(Span(first + 1, span.end), "string")
    yield Token(Span(part.span.end - 1, part.span.end), "operator")


def _of_words(text: str, part: Substitution) -> Iterator[Token]:
    """The arguments of a substitution of ROS 2, other substitutions among them."""
    for number, word in enumerate(part.words):
        for piece in word:
            if isinstance(piece, Substitution):
                yield from _of(text, piece)
            elif part.command == "eval" and number == 0:
                yield from _of_expression(text, piece.span)
            elif piece.span.end > piece.span.start:
                yield Token(piece.span, _OF_COMMAND.get(part.command, "string") if number == 0 else "string")


def _of_expression(text: str, span: Span) -> Iterator[Token]:
    called = ""
    for found in _EXPRESSION.finditer(text, span.start, span.end):
        place = Span(*found.span())
        match found.lastgroup:
            case "name" if _CALLED.match(text, place.end, span.end):
                called = found[0]
                yield Token(place, "function")
                continue
            case "name":
                yield Token(place, "keyword" if found[0] in _WORDS else "parameter")
            case "string":
                # arg('x'), find('p'), env('X'): what is in quotes is a name.
                yield Token(place, _OF_COMMAND.get(called, "string"))
            case "number":
                yield Token(place, "number")
            case _:
                yield Token(place, "operator")
        called = ""
