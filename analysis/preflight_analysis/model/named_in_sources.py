"""The packages that C++ sources and interface files name: by the headers that they include, by the types of fields."""

from __future__ import annotations

import re
from collections.abc import Iterator

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Span
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query

_BLOCK_COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)
_DIRECTIVE = re.compile(r"\s*#\s*(?P<name>ifn?def|if|endif|include)\b\s*(?:[<\"](?P<folder>\w+)/[^>\"]+)?")
_GUARD = re.compile(r"\w+_H(?:PP|XX|H)?_*\b")
_FIELD = re.compile(r"^[ \t]*([a-z]\w*)/(?:msg/)?[A-Z]\w*(?:\[[^\]\n]*\])?[ \t]+\w", re.MULTILINE)


@query
def included_folders(db: Database, path: str) -> tuple[tuple[str, int], ...]:
    """The first folders of the headers that a file includes under no condition but that of an include guard, each with
    its first line, counted from 0."""
    found: dict[str, int] = {}
    content = _BLOCK_COMMENT.sub(lambda comment: "\n" * comment[0].count("\n"), Disk(db).content(path) or "")
    depth = 0
    for number, line in enumerate(content.splitlines()):
        if (directive := _DIRECTIVE.match(line)) is None:
            continue
        if directive["name"].startswith("if"):
            depth += directive["name"] != "ifndef" or _GUARD.search(line) is None
        elif directive["name"] == "endif":
            depth = max(depth - 1, 0)
        elif not depth and directive["folder"] is not None:
            found.setdefault(directive["folder"], number)
    return tuple(found.items())


def packages_of_fields(document: Document) -> Iterator[tuple[str, Span]]:
    """The packages of the types of the fields of a message, service or action, and where they stand."""
    return ((found[1], Span(*found.span(1))) for found in _FIELD.finditer(document.text))
