"""How far two names are apart: the one measure of what somebody may have meant.

Restricted Damerau-Levenshtein distance: letters that are missing, too many, others or swapped with the next one.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rapidfuzz import process
from rapidfuzz.distance import OSA


def edits(name: str, other: str, most: int | None = None) -> int:
    """How many letters are others; where that is more than `most`, one more than that."""
    return int(OSA.distance(name, other, score_cutoff=most))


def closest(name: str, others: Iterable[str]) -> list[str]:
    """Those with the fewest edits."""
    found = {other: edits(name, other) for other in others}
    return [other for other, each in found.items() if each == min(found.values())]


def within(name: str, others: Sequence[str], most: int, limit: int) -> list[str]:
    """Others that are at most so many edits away, at most `limit`, the nearest first: among many thousands in little
    time."""
    found = process.extract(name, others, scorer=OSA.distance, score_cutoff=most, limit=limit)
    return [other for other, apart, _ in found if apart]
