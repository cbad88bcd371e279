"""What names a finding from one revision to the next: nothing in it changes when lines above it come or go."""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Mapping, Sequence

from preflight_analysis.documents.document import Document
from preflight_analysis.findings.finding import Finding
from preflight_analysis.findings.report import positions, relative

_MOST = 4000
"""How many characters count of a line, and of what a finding is about."""


def fingerprints(findings: Sequence[Finding], documents: Mapping[str, Document], base: str | None) -> list[str]:
    """One for each finding, in order: `digest:n`, n counting those alike.

    Made of the rule, the path from the folder `base`, the line that the finding begins on and the text it is about,
    blanks aside. Neither the message, which may count nodes that come and go elsewhere, nor the line's number.
    """
    seen: Counter[str] = Counter()
    found = []
    for finding in findings:
        digest = _digest(finding, documents, base)
        seen[digest] += 1
        found.append(f"{digest}:{seen[digest]}")
    return found


def _digest(finding: Finding, documents: Mapping[str, Document], base: str | None) -> str:
    line = about = ""
    document = documents.get(finding.location.file)
    if document is not None:
        (number, _), _ = positions(finding.location, documents)
        start, end = document.lines.line_span(number)
        line = " ".join(document.text[start : min(end, start + _MOST)].split())
        begin, stop = finding.location.span
        about = " ".join(document.text[begin : min(stop, begin + _MOST)].split())
    parts = "\0".join((finding.rule, relative(finding.location.file, base), line, about))
    return hashlib.sha256(parts.encode("utf-8", "surrogatepass")).hexdigest()[:16]
