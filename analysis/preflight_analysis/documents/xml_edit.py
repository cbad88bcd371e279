"""What an edit makes of the tree of an XML text: the children of the document element that it does not touch stay."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from dataclasses import replace

from preflight_analysis.documents.change import change
from preflight_analysis.documents.document import Document, Element, Node, Text
from preflight_analysis.documents.span import LineIndex, Span
from preflight_analysis.documents.xml_scanner import scan_children


def edited_children(before: Document, text: str, lines: LineIndex) -> tuple[Node, ...] | None:
    """What `before`, well-formed and without a DOCTYPE, has become: what a scan of the whole text would give if that is
    well-formed, too. None where the edit is not within the document element, or reaches beyond the tags around it.

    Up to the last tag in front of the edit the scanner goes as before, and so it does from the next tag behind it, if
    it arrives there in the same way: within the document element, and with nothing that it had to guess.
    """
    root = before.root
    if root is None or root.span == root.open_span or before.problems or "<!DOCTYPE" in text:
        return None
    edit = change(before.text, text)
    by = edit.after.end - edit.before.end
    root_ends = before.text.rindex("</", 0, root.span.end)
    if edit.before.start < root.open_span.end or edit.before.end > root_ends:
        return None
    children = root.children
    tags = [at for at, child in enumerate(children) if isinstance(child, Element)]
    ahead = bisect_right(tags, edit.before.start, key=lambda at: _span(children[at]).end)
    behind = bisect_left(tags, edit.before.end, key=lambda at: _span(children[at]).start)
    first, start = (tags[ahead - 1] + 1, _span(children[tags[ahead - 1]]).end) if ahead else (0, root.open_span.end)
    last, end = (
        (tags[behind], _span(children[tags[behind]]).start) if behind < len(tags) else (len(children), root_ends)
    )
    between = scan_children(text, lines, root, Span(start, end + by))
    if between is None:
        return None
    kept = (*children[:first], *between, *(child.moved(by) for child in children[last:]))
    edited = replace(root, children=kept, span=Span(root.span.start, root.span.end + by))
    at = before.children.index(root)
    return (*before.children[:at], edited, *(child.moved(by) for child in before.children[at + 1 :]))


def _span(child: Node) -> Span:
    return child.content.span if isinstance(child, Text) else child.span
