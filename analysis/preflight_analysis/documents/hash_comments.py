"""`# preflight: ...` in YAML, Python and build files: what a comment of an XML file says there."""

from __future__ import annotations

import re
from collections.abc import Iterable

from preflight_analysis.documents.document import Comment, SpannedText
from preflight_analysis.documents.python_text import is_python
from preflight_analysis.documents.span import LineIndex, Span

MARK = "preflight:"
_HASH_SUFFIXES = (".yaml", ".yml", ".py", ".cmake", "CMakeLists.txt", "setup.cfg")
"""Of files whose comments begin with a hash."""
_COMMENT = re.compile(r"(?P<before>(?:^|(?<=\s)))#(?P<content>[ \t]*preflight:[^\r\n]*)", re.MULTILINE)
_MORE = re.compile(r"[ \t]*#(?P<content>[^\r\n]*)")


def has_hash_comments(path: str, text: str) -> bool:
    """Whether comments of a file begin with a hash."""
    return path.endswith(_HASH_SUFFIXES) or is_python(path, text)


def preflight_comments(text: str, lines: LineIndex) -> tuple[Comment, ...]:
    """The comments of ours, in order. Lines of comment below one that stands alone go on with it."""
    if MARK not in text:
        return ()  # nearly every file, on every keystroke
    found: list[Comment] = []
    for match in _COMMENT.finditer(text):
        if found and match.start() < found[-1].span.end:
            continue
        pieces = [match.span("content")]
        line, _ = lines.position(match.start())
        alone = not text[lines.line_start(line) : match.start()].strip()
        while alone and line + 1 < len(lines):
            line += 1
            more = _MORE.match(text, lines.line_start(line))
            if more is None or more["content"].lstrip().startswith(MARK):
                break
            pieces.append(more.span("content"))
        found.append(Comment(_joined(text, pieces), Span(match.start(), pieces[-1][1])))
    return tuple(found)


def above(comments: Iterable[Comment], lines: LineIndex, offset: int) -> tuple[SpannedText, ...]:
    """What the comments right above the line of `offset` say, without the mark."""
    line, _ = lines.position(offset)
    found: list[SpannedText] = []
    for comment in reversed(tuple(comments)):
        last, _ = lines.position(comment.span.end)
        if last == line - 1:
            found.append(_without_mark(comment.content))
            line, _ = lines.position(comment.span.start)
    return tuple(reversed(found))


def _joined(text: str, pieces: list[tuple[int, int]]) -> SpannedText:
    parts: list[str] = []
    offsets: list[int] = []
    for start, end in pieces:
        if parts:
            parts.append("\n")
            offsets.append(start)
        parts.append(text[start:end])
        offsets += range(start, end)
    return SpannedText("".join(parts), Span(pieces[0][0], pieces[-1][1]), (*offsets, pieces[-1][1]))


def _without_mark(content: SpannedText) -> SpannedText:
    at = content.text.index(MARK) + len(MARK)
    start = content.to_document(at)
    offsets = content.offsets[at:] if content.offsets is not None else None
    return SpannedText(content.text[at:], Span(start, content.span.end), offsets)
