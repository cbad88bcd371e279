"""The writer of a file, by its format. Rules and queries say what is to change, and a writer how that is written."""

from __future__ import annotations

import re

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.hash_comments import has_hash_comments
from preflight_analysis.documents.python_text import is_python
from preflight_analysis.documents.span import Span
from preflight_analysis.edits.edit import Edit
from preflight_analysis.edits.python import PythonWriter
from preflight_analysis.edits.xml import XmlWriter
from preflight_analysis.edits.yaml import YamlWriter
from preflight_analysis.incremental.derived import derived

Writer = XmlWriter | YamlWriter | PythonWriter
"""All of them have the operations on launch files, under the same names."""


@derived
def writer_of(document: Document) -> Writer:
    """The writer of a launch file, or of a file that one names."""
    if is_python(document.path, document.text):
        return PythonWriter(document)
    if has_hash_comments(document.path, document.text) or not document.text.lstrip("\ufeff \t\r\n").startswith("<"):
        return YamlWriter(document)
    return XmlWriter(document)


def replaced(document: Document, span: Span, old: str, new: str) -> tuple[Edit, ...]:
    """Write `new` for `old`, which the value at `span` holds exactly once as a word; in a program also where the one
    text stands that the value is made of. No edit where that is not certain."""
    writer = writer_of(document)
    within = document.text[span.start : span.end]
    hits = [m.start() for m in re.finditer(rf"(?<![\w]){re.escape(old)}(?![\w])", within)] if old else []
    if len(hits) == 1:
        start = span.start + hits[0]
        edits = writer.replace(Span(start, start + len(old)), new)
        if edits:
            return edits
    if old and isinstance(writer, PythonWriter):
        places = writer.literals_of(span, old)
        return writer.replace(places[0], new) if len(places) == 1 else ()
    return ()
