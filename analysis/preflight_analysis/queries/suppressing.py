"""Edits that suppress a finding by a comment beside it."""

from __future__ import annotations

import ast
import configparser
from collections.abc import Iterator

import yaml

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.hash_comments import has_hash_comments, preflight_comments
from preflight_analysis.documents.python_text import is_python
from preflight_analysis.documents.reading import digest
from preflight_analysis.documents.span import LineIndex
from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.documents.yaml import parse_yaml
from preflight_analysis.edits import layout
from preflight_analysis.edits.edit import Edit, applied
from preflight_analysis.edits.writer import writer_of
from preflight_analysis.environment.build import LISTS, SETTINGS
from preflight_analysis.environment.cmake_syntax import commands
from preflight_analysis.findings.finding import Finding
from preflight_analysis.findings.suppression import read_suppressions

_CMAKE = (LISTS, ".cmake")


def suppress_on_line(document: Document, finding: Finding) -> Edit | None:
    """The edit of `document`, in which the finding is, that makes a comment cover it: its rule joins a comment that is
    there, or one is written on the line above, or at the end of its line. None where no comment can stand there, as in
    the middle of a text."""
    offset = finding.location.span.start
    for edit in _candidates(document, offset, finding.rule):
        text = applied(document.text, [edit])
        moved = offset + len(edit.text) if edit.location.span.start <= offset else offset
        if _means_the_same(document, text) and _covers(document.path, text, moved, finding.rule):
            return edit
    return None


def _candidates(document: Document, offset: int, rule: str) -> Iterator[Edit]:
    line, _ = document.lines.position(offset)
    for suppression in read_suppressions(_parsed(document.path, document.text))[0]:
        if suppression.first_line <= line <= suppression.last_line:
            yield layout.insertion(document, suppression.location.span.end, f", {rule}")
    yield from writer_of(document).suppress(offset, f"preflight: ignore[{rule}]")


def _parsed(path: str, text: str) -> Document:
    lines = LineIndex(text)
    comments = preflight_comments(text, lines) if has_hash_comments(path, text) else ()
    return Document(path, text, digest(text), comments, (), lines)


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
    if document.path.endswith(_CMAKE):
        return commands(document.text) == commands(text)
    if document.path.endswith(SETTINGS):
        return _options(document.text) == _options(text)
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


def _options(text: str) -> object:
    parser = configparser.ConfigParser(interpolation=None, strict=False)
    try:
        parser.read_string(text)
    except configparser.Error:
        return None
    return {name: dict(section) for name, section in parser.items()}


def _plain(node: yaml.Node | None) -> object:
    if isinstance(node, yaml.MappingNode):
        return [(_plain(key), _plain(value)) for key, value in node.value]
    if isinstance(node, yaml.SequenceNode):
        return [_plain(item) for item in node.value]
    return (node.tag, node.value) if node is not None else None
