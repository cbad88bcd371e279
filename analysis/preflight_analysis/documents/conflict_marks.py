"""The lines that git writes into a file where two branches do not fit (git-merge(1))."""

from __future__ import annotations

import re

from preflight_analysis.documents.span import Span

_MARK = re.compile(r"^(?:<{7} |={7}\r?$|>{7} )[^\n]*", re.MULTILINE)


def conflict_mark(text: str) -> Span | None:
    """The first line of a conflict, which has two more behind it: between its sides, and at its end."""
    start: Span | None = None
    between = False
    for found in _MARK.finditer(text):
        match text[found.start()]:
            case "<":
                start, between = Span(*found.span()), False
            case "=":
                between = start is not None
            case _ if start is not None and between:
                return start
    return None
