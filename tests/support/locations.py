"""Locations for tests that make findings by hand, of files that nobody reads."""

from __future__ import annotations

from functools import lru_cache

from preflight_analysis.documents.span import LineIndex, Location, Span


def location(file: str, start: int, end: int) -> Location:
    """The part of a file from one offset to another; equal ones for equal places."""
    return _lines(file).location(file, Span(start, end))


@lru_cache
def _lines(file: str) -> LineIndex:
    return LineIndex("")
