"""Where the value of a parameter is written."""

from __future__ import annotations

import re

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location, Span

_MOST = 4_000
"""How many characters behind its name a value is looked for."""


def value_place(place: Location, value: str, document: Document | None) -> Location | None:
    """Where a text stands that a parameter has, or that is in its list. `place` is that of the parameter's name, and
    `document` the text of that file. None where it is not written there as such."""
    if document is None or not value or document.path != place.file:
        return None
    start = place.span.end
    text = document.text[start : start + _MOST]
    found = re.search(rf"(?<![\w/~.-]){re.escape(value)}(?![\w/~-]|\.\w)", text)
    if found is None or not _is_of_value(text[: found.start()], place.column):
        return None
    return document.location(Span(start + found.start(), start + found.end()))


def _is_of_value(between: str, column: int) -> bool:
    """Whether what comes between the name of a parameter and a text is the rest of its value: in YAML a list of which
    each line stands further to the right, or begins with a dash."""
    _, *lines = between.split("\n")
    for line in lines:
        indent = len(line) - len(line.lstrip())
        if line.strip() and not (indent > column or (indent == column and line.lstrip().startswith("-"))):
            return False
    return True
