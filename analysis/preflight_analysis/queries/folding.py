"""What can be folded: elements over several lines, comments, and the regions that comments mark."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import Literal

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Comment, Document, Element, Node
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.recognize import is_yaml

FoldKind = Literal["element", "comment", "region"]

_REGION = re.compile(r"\s*#(end)?region\b")


@dataclass(frozen=True, slots=True)
class Fold:
    """First and last line, counted from 0, both inclusive; the first stays visible."""

    kind: FoldKind
    start: int
    end: int


def folds(launch_file: LaunchFile) -> tuple[Fold, ...]:
    """The folds of a file in document order. The line of an end tag stays visible."""
    document = launch_file.document
    found: list[Fold] = []
    if is_yaml(launch_file.path) and launch_file.root is not None:
        for action in launch_file.root.walk():
            found += _fold(document, "element", action.span.start, action.span.end)
    comments: list[Comment] = []
    nodes: list[Node] = list(document.children)
    while nodes:
        node = nodes.pop()
        if isinstance(node, Comment):
            comments.append(node)
            found += _fold(document, "comment", node.span.start, node.span.end)
        elif isinstance(node, Element):
            found += _fold(document, "element", node.span.start, _last(document, node))
            nodes += node.children
    found += _regions(document, sorted(comments, key=lambda comment: comment.span))
    return tuple(sorted(found, key=lambda fold: (fold.start, -fold.end)))


def _last(document: Document, element: Element) -> int:
    """The offset up to which an element is folded: before the line of its end tag if that stands there alone."""
    text, end = document.text, element.span.end
    less = text.rfind("<", element.open_span.end, end)
    if less >= 0 and text.startswith("</", less):
        line_start = document.lines.line_start(document.lines.position(less)[0])
        return line_start - 1 if line_start > element.span.start and not text[line_start:less].strip() else less
    while end > element.open_span.end and text[end - 1].isspace():  # given up, in front of what follows it
        end -= 1
    return end


def _fold(document: Document, kind: FoldKind, start: int, end: int) -> Iterator[Fold]:
    first, last = document.lines.position(start)[0], document.lines.position(end)[0]
    if last > first:
        yield Fold(kind, first, last)


def _regions(document: Document, comments: Iterable[Comment]) -> Iterator[Fold]:
    """`<!-- #region -->` to `<!-- #endregion -->`, as VS Code has them in XML."""
    opened: list[int] = []
    for comment in comments:
        mark = _REGION.match(comment.content.text)
        if mark is None:
            continue
        line = document.lines.position(comment.span.start)[0]
        if mark[1] is None:
            opened.append(line)
        elif opened and line > opened[-1]:
            yield Fold("region", opened.pop(), line)
