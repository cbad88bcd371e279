"""`<!-- preflight: ignore[TOP001, PRM001] reason -->` on the line of a finding or the line above it, or above the start
tag that it is in."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Comment, Document, Element, Node
from preflight_analysis.documents.hash_comments import MARK, has_hash_comments
from preflight_analysis.documents.span import Location
from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.edits import layout
from preflight_analysis.edits.edit import Edit
from preflight_analysis.findings.finding import Finding

_MARK = re.compile(r"preflight:\s*ignore\b(?:\[(?P<ids>[^\]]*)\])?")


@dataclass(frozen=True, slots=True)
class Suppression:
    """One rule that one comment silences. `first_line` to `last_line`, counted from 0, are the lines it covers.

    `removal` is the edit that takes it back: the whole comment if it names no other rule.
    """

    rule: str
    location: Location
    removal: Edit
    first_line: int
    last_line: int


@dataclass(frozen=True, slots=True)
class Malformed:
    """A comment that is meant to silence something and names no rule."""

    location: Location


@dataclass(frozen=True, slots=True)
class Filtered:
    """Findings that are left, and the suppressions that silenced nothing."""

    left: tuple[Finding, ...]
    unused: tuple[Suppression, ...]


def read_suppressions(document: Document) -> tuple[tuple[Suppression, ...], tuple[Malformed, ...]]:
    """The suppressions in the comments of `document`, each at the place of its rule's id, in order."""
    if MARK not in document.text:
        return (), ()  # nearly every file, on every keystroke
    if not document.children and not has_hash_comments(document.path, document.text):
        document = parse_xml(document.path, document.text)  # a text that nobody has parsed, such as a manifest
    found: list[Suppression] = []
    malformed: list[Malformed] = []
    ends_of_tags: dict[int, int] | None = None
    for comment in _comments(document.children):
        content = comment.content
        marks = list(_MARK.finditer(content.text))
        for mark in marks:
            ids = list(re.finditer(r"[^\s,]+", mark["ids"] or ""))
            if not ids:
                malformed.append(Malformed(document.location(content.slice_span(*mark.span()))))
            first, _ = document.lines.position(comment.span.start)
            last, _ = document.lines.position(comment.span.end)
            # Behind something else on its line a comment speaks of that, not of the next line.
            alone = not document.text[document.lines.line_start(first) : comment.span.start].strip()
            if alone:
                ends_of_tags = _ends_of_tags(document) if ends_of_tags is None else ends_of_tags
                last = max(last + 1, ends_of_tags.get(last + 1, 0))
            for at, each in enumerate(ids):
                base = mark.start("ids")
                span = content.slice_span(base + each.start(), base + each.end())
                removal = layout.removal(document, comment.span)
                if len(ids) > 1:
                    # With the comma that parts it from the next one, or from the one before.
                    ends = (each.start(), ids[at + 1].start()) if at + 1 < len(ids) else (ids[at - 1].end(), each.end())
                    removal = Edit(document.location(content.slice_span(base + ends[0], base + ends[1])), "")
                elif len(marks) > 1:
                    removal = Edit(document.location(content.slice_span(*mark.span())), "")
                place = document.location(span)
                found.append(Suppression(each.group(), place, removal, first, last))
    return tuple(found), tuple(malformed)


def _ends_of_tags(document: Document) -> dict[int, int]:
    """The line on which a start tag begins to that on which the last one that begins there ends, counted from 0."""
    found: dict[int, int] = {}
    for node in _walk(document.children):
        if isinstance(node, Element):
            first, last = (document.lines.position(at)[0] for at in node.open_span)
            found[first] = max(last, found.get(first, 0))
    return found


def apply_suppressions(
    findings: Iterable[Finding], suppressions: Sequence[Suppression], document: Document | None
) -> Filtered:
    """Without the findings that a comment silences; all are of the one file. A finding counts where it starts."""
    if document is None or not suppressions:
        return Filtered(tuple(findings), ())
    used: set[Suppression] = set()
    kept: list[Finding] = []
    for finding in findings:
        of_rule = [suppression for suppression in suppressions if suppression.rule == finding.rule]
        line = document.lines.position(finding.location.span.start)[0] if of_rule else -1
        hits = [suppression for suppression in of_rule if suppression.first_line <= line <= suppression.last_line]
        used.update(hits)
        if not hits:
            kept.append(finding)
    return Filtered(tuple(kept), tuple(each for each in suppressions if each not in used))


def _comments(nodes: Iterable[Node]) -> Iterator[Comment]:
    return (node for node in _walk(nodes) if isinstance(node, Comment))


def _walk(nodes: Iterable[Node]) -> Iterator[Node]:
    # A stack, not recursion: a hostile file nests deeper than Python's stack.
    stack = list(nodes)[::-1]
    while stack:
        node = stack.pop()
        yield node
        if isinstance(node, Element):
            stack.extend(reversed(node.children))
