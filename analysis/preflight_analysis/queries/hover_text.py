"""What a hover is."""

from __future__ import annotations

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Span


@dataclass(frozen=True, slots=True)
class Hover:
    """A text in Markdown and what it speaks of."""

    markdown: str
    span: Span
