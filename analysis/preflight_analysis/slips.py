"""How far two names are apart: the one measure of what somebody may have meant. And what two sequences have in common.

Restricted Damerau-Levenshtein distance: letters that are missing, too many, others or swapped with the next one.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from rapidfuzz import process
from rapidfuzz.distance import OSA, LCSseq


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


def aligned(one: Sequence[str], other: Sequence[str]) -> Iterator[tuple[int, int, int, int, bool]]:
    """Two sequences as runs of what is the same in both, as much as there is, and of what is not: begin and end of each
    run in the one and in the other, and whether it is the same."""
    at = beside = 0
    for each in LCSseq.opcodes(one, other):
        if each.tag != "equal":
            continue
        start, end, first, last = each.src_start, each.src_end, each.dest_start, each.dest_end
        if (at, beside) != (start, first):
            yield at, start, beside, first, False
        yield start, end, first, last, True
        at, beside = end, last
    if (at, beside) != (len(one), len(other)):
        yield at, len(one), beside, len(other), False
