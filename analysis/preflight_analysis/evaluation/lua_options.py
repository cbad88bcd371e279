"""Assignments of plain values in Lua files that only configure, as cartographer's do. Nothing is run: a value that is
computed is not known, and the keys of all tables count alike. `options.x` is `x`."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Span
from preflight_analysis.incremental.derived import derived

_ASSIGNMENT = re.compile(r"^[ \t]*(?:options[ \t]*\.[ \t]*)?([A-Za-z_][\w.]*)[ \t]*=(?!=)[ \t]*([^\n]*)$", re.MULTILINE)
_TEXT = re.compile(r"""(?:"([^"\\]*)"|'([^'\\]*)')[\s,;}]*\Z""")
_WORD = re.compile(r"(true|false|-?\d+(?:\.\d+)?)[\s,;}]*\Z")
_INCLUDE = re.compile(r"""^[ \t]*include[ \t]*\(?[ \t]*["']([\w./-]+\.lua)["']""", re.MULTILINE)
_BLOCK, _END, _LINE = "--[[", "]]", "--"
_MOST = 1000
"""Assignments of a file."""
_MAX_LENGTH = 200_000


class Assignment(NamedTuple):
    """A name with its value, None for one that is computed, and where the name is written."""

    name: str
    value: str | bool | float | None
    span: Span


@derived
def assignments(document: Document) -> tuple[Assignment, ...]:
    """Those of a file in their order."""
    return tuple(_assignments(document.text[:_MAX_LENGTH]))


@derived
def included(document: Document) -> tuple[str, ...]:
    """The files that it includes."""
    return tuple(dict.fromkeys(_INCLUDE.findall(_without_comments(document.text[:_MAX_LENGTH]))))


def _assignments(text: str) -> Iterator[Assignment]:
    for at, found in enumerate(_ASSIGNMENT.finditer(_without_comments(text))):
        if at == _MOST:
            return
        yield Assignment(found[1], _value(found[2]), Span(found.start(1), found.end(1)))


def _value(written: str) -> str | bool | float | None:
    text = _TEXT.match(written)
    if text is not None:
        return text[1] if text[1] is not None else text[2]
    word = _WORD.match(written)
    if word is None:
        return None
    return word[1] == "true" if word[1] in ("true", "false") else float(word[1])


def _without_comments(text: str) -> str:
    """The text with blanks in their place."""
    parts, at = list[str](), 0
    while (start := text.find(_LINE, at)) >= 0:
        is_block = text.startswith(_BLOCK, start)
        end = text.find(_END, start) + len(_END) if is_block else text.find("\n", start)
        end = end if end >= (len(_END) if is_block else 0) else len(text)
        parts += text[at:start], re.sub(r"[^\n]", " ", text[start:end])
        at = end
    return "".join((*parts, text[at:]))
