"""Comments that begin with a hash, of YAML and Python: annotations and suppressions."""

from __future__ import annotations

from collections.abc import Sequence

from preflight_analysis.documents.document import Comment, Document
from preflight_analysis.documents.hash_comments import MARK
from preflight_analysis.documents.span import Span
from preflight_analysis.edits import layout
from preflight_analysis.edits.edit import Edit
from preflight_analysis.launch.model import Action


class HashComments:
    """What the writers of these formats share."""

    def __init__(self, document: Document) -> None:
        self._document = document

    def annotate(self, action: Action, lines: Sequence[str]) -> tuple[Edit, ...]:
        """Write an annotation above the line on which an action begins."""
        first, *more = (line.strip() for line in lines)
        body = "\n".join([f"# {MARK} {first}", *(f"# {line}" for line in more)])
        return (layout.lines_above(self._document, action.span.start, body),)

    def suppress(self, offset: int, mark: str) -> tuple[Edit, ...]:
        """The places where a comment can suppress what is found at an offset, the best first: the line above it, and
        the end of its line."""
        return (
            layout.lines_above(self._document, offset, f"# {mark}"),
            layout.at_end_of_line(self._document, offset, f" # {mark}"),
        )

    def _in_comment(self, span: Span, new: str) -> tuple[Edit, ...]:
        """Write `new` in the place of a part of a comment of ours."""
        comments = (each for each in self._document.children if isinstance(each, Comment))
        if "\n" in new or not any(each.span.start <= span.start and span.end <= each.span.end for each in comments):
            return ()
        return (Edit(self._document.location(span), new),)

    def remove_comment(self, comment: Comment) -> tuple[Edit, ...]:
        """Remove a comment."""
        return (layout.removal(self._document, comment.span),)
