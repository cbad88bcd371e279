"""Edits that suppress a finding by a comment beside it."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

import yaml

from preflight_analysis.documents.document import Document, Element
from preflight_analysis.documents.hash_comments import has_hash_comments, preflight_comments
from preflight_analysis.documents.python_text import is_python
from preflight_analysis.documents.reading import digest
from preflight_analysis.documents.span import LineIndex, Span
from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.documents.yaml import parse_yaml
from preflight_analysis.edits.edit import Edit
from preflight_analysis.findings.finding import Finding
from preflight_analysis.findings.suppression import read_suppressions

_BLANKS = re.compile(r"[ \t]*")


def suppress_on_line(document: Document, finding: Finding) -> Edit | None:
    """The edit of `document`, in which the finding is, that makes a comment cover it: its rule joins a comment that is
    there, or one is written on the line above, or at the end of its line. None where no comment can stand there, as in
    the middle of a text."""
    offset = finding.location.span.start
    for span, inserted in _candidates(document, offset, finding.rule):
        text = document.text[: span.start] + inserted + document.text[span.end :]
        moved = offset + len(inserted) - (span.end - span.start) if span.start <= offset else offset
        if _means_the_same(document, text) and _covers(document.path, text, moved, finding.rule):
            return Edit(document.location(span), inserted)
    return None


def _candidates(document: Document, offset: int, rule: str) -> Iterator[tuple[Span, str]]:
    text, lines = document.text, document.lines
    line, _ = lines.position(offset)
    for suppression in read_suppressions(_parsed(document.path, text))[0]:
        if suppression.first_line <= line <= suppression.last_line:
            end = suppression.location.span.end
            yield Span(end, end), f", {rule}"
    newline = "\r\n" if "\r\n" in text else "\n"
    mark = f"preflight: ignore[{rule}]"
    comment = f"# {mark}" if has_hash_comments(document.path, document.text) else f"<!-- {mark} -->"
    for above in dict.fromkeys((line, lines.position(_start_of_tag(document, offset))[0])):
        start = lines.line_start(above)
        blanks = _BLANKS.match(text, start)
        yield Span(start, start), f"{blanks.group() if blanks is not None else ''}{comment}{newline}"
    start, end = lines.line_span(line)
    end = start + len(text[start:end].rstrip())
    yield Span(end, end), f" {comment}"


def _start_of_tag(document: Document, offset: int) -> int:
    """Where the start tag begins that an offset is in; the offset itself where it is in none."""
    inside: Document | Element = document
    while True:
        children = (each for each in inside.children if isinstance(each, Element) and each.span.contains(offset))
        child = next(children, None)
        if child is None:
            return offset
        if child.open_span.contains(offset):
            return child.open_span.start
        inside = child


def _parsed(path: str, text: str) -> Document:
    if not has_hash_comments(path, text):
        return parse_xml(path, text)
    lines = LineIndex(text)
    return Document(path, text, digest(text), preflight_comments(text, lines), (), lines)


def _covers(path: str, text: str, offset: int, rule: str) -> bool:
    document = _parsed(path, text)
    line, _ = document.lines.position(offset)
    return any(
        each.rule == rule and each.first_line <= line <= each.last_line for each in read_suppressions(document)[0]
    )


def _means_the_same(document: Document, text: str) -> bool:
    """Whether what was inserted is but a comment."""
    if is_python(document.path, document.text):
        before, after = _syntax(document.text), _syntax(text)
        return before == after
    if has_hash_comments(document.path, document.text):
        before_yaml, after_yaml = parse_yaml(document.path, document.text), parse_yaml(document.path, text)
        return _plain(before_yaml.node) == _plain(after_yaml.node)
    return len(parse_xml(document.path, text).problems) <= len(parse_xml(document.path, document.text).problems)


def _syntax(text: str) -> str | None:
    """The program without places and comments; None where it is none."""
    try:
        return ast.dump(ast.parse(text))
    except (SyntaxError, ValueError, RecursionError):
        return None


def _plain(node: yaml.Node | None) -> object:
    if isinstance(node, yaml.MappingNode):
        return [(_plain(key), _plain(value)) for key, value in node.value]
    if isinstance(node, yaml.SequenceNode):
        return [_plain(item) for item in node.value]
    return (node.tag, node.value) if node is not None else None
