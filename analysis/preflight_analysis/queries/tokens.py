"""The substitutions inside of values, cut into pieces to be coloured."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Literal, get_args

from preflight_analysis.documents.span import Span
from preflight_analysis.launch.model import Action, LaunchFile, Substitution, Value

TokenKind = Literal["keyword", "operator", "parameter", "namespace", "variable", "function", "number", "string"]
"""Semantic token types of LSP: `parameter` for arguments, `namespace` for packages, `variable` for those of the
environment and for what `$(anon)` names."""
KINDS: tuple[TokenKind, ...] = get_args(TokenKind)

_OF_COMMAND: Mapping[str, TokenKind] = {
    "arg": "parameter",
    "find": "namespace",
    "env": "variable",
    "optenv": "variable",
    "anon": "variable",
}
_EXPRESSION = re.compile(
    r"""(?P<string>'(?:\\.|[^'\\])*'|"(?:\\.|[^"\\])*"|&quot;.*?&quot;|&apos;.*?&apos;)"""
    r"|(?P<number>\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+)"
    r"|(?P<name>[^\W\d]\w*)"
    r"|(?P<operator>&(?:lt|gt|amp);=?|\*\*|//|[=!]=|[-+*/%<>|^~])"
)
_WORDS = frozenset({"and", "or", "not", "in", "is", "if", "else", "True", "False", "None", "true", "false"})
_CALLED = re.compile(r"\s*\(")
_LINE = re.compile(r"[^\r\n]+")


@dataclass(frozen=True, slots=True)
class Token:
    """A piece of a substitution; it never goes over the end of a line."""

    kind: TokenKind
    span: Span


def tokens(launch_file: LaunchFile, within: Span | None = None) -> tuple[Token, ...]:
    """The tokens of a file in order, or of the values that touch `within`."""
    return tuple(sorted(_tokens(launch_file, within), key=lambda token: token.span))


def _tokens(launch_file: LaunchFile, within: Span | None) -> Iterator[Token]:
    text = launch_file.document.text
    for value in _values(launch_file.root) if launch_file.root is not None else ():
        if within is not None and (value.span.end < within.start or value.span.start > within.end):
            continue
        for part in value.substitutions:
            for token in _of(text, part):
                for line in _LINE.finditer(text, token.span.start, token.span.end):
                    yield Token(token.kind, Span(*line.span()))


def _values(action: Action) -> Iterator[Value]:
    for attribute in action.attributes:
        if "$" in attribute.value.text:
            yield attribute.value
    substituted = action.value("subst_value")
    if substituted is not None and "$" in action.body.text:
        yield action.body
    for child in action.children:
        yield from _values(child)


def _of(text: str, part: Substitution) -> Iterator[Token]:
    yield Token("operator", Span(part.span.start, part.span.start + 2))
    if part.command_span.end > part.command_span.start:
        yield Token("keyword", part.command_span)
    span = part.arguments_span
    if part.command == "eval":
        yield from _of_expression(text, span)
    elif part.command in _OF_COMMAND and span.end > span.start:
        first = span.start + len(text[span.start : span.end].split(" ", 1)[0])
        yield Token(_OF_COMMAND[part.command], Span(span.start, first))
        if part.command == "optenv" and first + 1 < span.end:
            yield Token("string", Span(first + 1, span.end))
    yield Token("operator", Span(part.span.end - 1, part.span.end))


def _of_expression(text: str, span: Span) -> Iterator[Token]:
    called = ""
    for found in _EXPRESSION.finditer(text, span.start, span.end):
        place = Span(*found.span())
        match found.lastgroup:
            case "name" if _CALLED.match(text, place.end, span.end):
                called = found[0]
                yield Token("function", place)
                continue
            case "name":
                yield Token("keyword" if found[0] in _WORDS else "parameter", place)
            case "string":
                # arg('x'), find('p'), env('X'): what is in quotes is a name.
                yield Token(_OF_COMMAND.get(called, "string"), place)
            case "number":
                yield Token("number", place)
            case _:
                yield Token("operator", place)
        called = ""
