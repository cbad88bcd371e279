"""An edit of a text: plain data, no editor types."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location


@dataclass(frozen=True, slots=True)
class Edit:
    """Replace the text at `location` by `text`."""

    location: Location
    text: str


def by_file(edits: Iterable[Edit]) -> Mapping[str, list[Edit]]:
    """The edits of each file, in the order of their places; insertions at one place in the order given."""
    found: dict[str, list[Edit]] = {}
    for edit in edits:
        found.setdefault(edit.location.file, []).append(edit)
    return {file: sorted(each, key=lambda edit: edit.location.span) for file, each in found.items()}


def applied(text: str, edits: Iterable[Edit]) -> str:
    """The text of a file after edits of it. Raises `ValueError` where they share text or lie outside of it."""
    return "".join(_pieces(text, edits))


def _pieces(text: str, edits: Iterable[Edit]) -> Iterator[str]:
    at = 0
    for edit in sorted(edits, key=lambda edit: edit.location.span):
        start, end = edit.location.span
        if not at <= start <= end <= len(text):
            raise ValueError("edits of the same text")
        yield text[at:start]
        yield edit.text
        at = end
    yield text[at:]
