"""Findings as text for people and as JSON for programs (`ros-preflight/check/1`, docs/formats)."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location
from preflight_analysis.findings.finding import SEVERITIES, Confidence, Finding, Severity

CHECK_SCHEMA = "ros-preflight/check/1"
_COLOURS: Mapping[Severity, str] = {"error": "31", "warning": "33", "info": "34", "hint": "36"}
_TAB = 4
_SHOWN_BEFORE = 200
_SHOWN_BEHIND = 400
"""How many characters of a line are shown before the place of a finding, and from there on."""


@dataclass(frozen=True, slots=True)
class Report:
    """What a check found. `documents` has the text of each file that a finding points into; one that is missing costs
    its source line and the right line number. `files`, `nodes` and `traced` count what was looked at."""

    findings: Sequence[Finding]
    documents: Mapping[str, Document] = field(repr=False)
    files: int
    nodes: int
    traced: int


def to_json(report: Report) -> dict[str, Any]:
    """The document of `check --format json`. Dump it with sorted keys; lines and columns count from 1, columns in code
    points; `files`, `nodes` and `traced` are the counts."""
    return {
        "schema": CHECK_SCHEMA,
        "findings": [_finding_json(finding, report.documents) for finding in report.findings],
        "files": report.files,
        "nodes": report.nodes,
        "traced": report.traced,
    }


def to_text(report: Report, *, base: str | None = None, colour: bool = False, show_hints: bool = True) -> str:
    """For reading: place, severity, rule and message, the source line with the place underlined, other places, fixes;
    at the end how many findings there are and what was looked at. Ends with a newline. Files below the folder `base`
    are shown relative to it."""
    shown = [f for f in report.findings if show_hints or f.severity != "hint"]
    blocks = ["\n".join(finding_lines(finding, report.documents, base, colour=colour)) for finding in shown]
    return "\n\n".join([*blocks, summary(report)]) + "\n"


def _finding_json(finding: Finding, documents: Mapping[str, Document]) -> dict[str, Any]:
    return {
        "rule": finding.rule,
        "name": finding.name,
        "severity": finding.severity,
        "confidence": finding.confidence,
        "message": finding.message,
        "file": finding.location.file,
        "range": _range_json(finding.location, documents),
        "related": [
            {"message": r.message, "file": r.location.file, "range": _range_json(r.location, documents)}
            for r in finding.related
        ],
        "roots": list(finding.roots),
        "fixes": [fix.title for fix in finding.fixes],
    }


def _range_json(location: Location, documents: Mapping[str, Document]) -> dict[str, Any]:
    (line, column), (end_line, end_column) = positions(location, documents)
    return {
        "start": {"line": line + 1, "column": column + 1},
        "end": {"line": end_line + 1, "column": end_column + 1},
    }


def positions(location: Location, documents: Mapping[str, Document]) -> tuple[tuple[int, int], tuple[int, int]]:
    """Start and end as line and column, counted from 0; the start of the file where its text is not known."""
    document = documents.get(location.file)
    if document is None:
        return (0, 0), (0, 0)
    return document.lines.position(location.span.start), document.lines.position(location.span.end)


def finding_lines(
    finding: Finding, documents: Mapping[str, Document], base: str | None, *, colour: bool = False
) -> Iterator[str]:
    """One finding for reading, without the line breaks."""
    severity = f"{finding.severity}{_unsure(finding.confidence)} {finding.rule} {finding.name}"
    paint = f"\x1b[{_COLOURS[finding.severity]}m{{}}\x1b[0m" if colour else "{}"
    severity = paint.format(severity)
    yield f"{place(finding.location, documents, base)}: {severity}: {printable(finding.message)}"
    yield from _underlined(finding.location, documents, paint)
    for related in finding.related:
        yield f"  {place(related.location, documents, base)}: {printable(related.message)}"
    for fix in finding.fixes:
        yield f"  fix: {printable(fix.title)}"


def _unsure(confidence: Confidence) -> str:
    return "" if confidence == "certain" else f" ({confidence})"


def place(location: Location, documents: Mapping[str, Document], base: str | None = None) -> str:
    """`file:line:column`, both counted from 1; the file relative to the folder `base` where it lies below it."""
    (line, column), _ = positions(location, documents)
    return f"{printable(relative(location.file, base))}:{line + 1}:{column + 1}"


def relative(file: str, base: str | None) -> str:
    """The path from the folder `base` where the file lies below it, else the path as it is."""
    if base is not None and file.startswith(base.rstrip("/") + "/"):
        return file[len(base.rstrip("/")) + 1 :]
    return file


def _underlined(location: Location, documents: Mapping[str, Document], paint: str) -> Iterator[str]:
    """The source line and, below it, carets under the place, to the end of its first line; `paint` colours them."""
    document = documents.get(location.file)
    if document is None:
        return
    (line, column), (end_line, end_column) = positions(location, documents)
    span = document.lines.line_span(line)
    first = max(0, column - _SHOWN_BEFORE)
    end = min(span.end, span.start + column + _SHOWN_BEHIND)
    text = document.text[span.start + first : end].rstrip("\r\n")
    if not text.strip():
        return
    stop = end_column - first if end_line == line else len(text)
    text = ("\u2026" if first else "") + text + ("\u2026" if end < span.end else "")
    column, stop = (column - first + 1, stop + 1) if first else (column, stop)
    number = str(line + 1)
    before, under = _widths(text[:column]), max(1, _widths(text[:stop]) - _widths(text[:column]))
    yield f"  {number} | {printable(text.expandtabs(_TAB))}"
    yield f"  {' ' * len(number)} | {' ' * before}{paint.format('^' * under)}"


def _widths(text: str) -> int:
    """How many columns of a terminal a text takes: wide characters take two, combining ones none."""
    if text.isascii() and "\t" not in text:
        return len(text)
    columns = 0
    for char in text:
        if char == "\t":
            columns += _TAB - columns % _TAB
        elif unicodedata.combining(char):
            continue
        else:
            columns += 2 if unicodedata.east_asian_width(char) in "WF" else 1
    return columns


def printable(text: str) -> str:
    """Without control characters: a file's text must not drive the terminal on which it is printed."""
    if text.isprintable():
        return text
    return "".join(char if char.isprintable() or char == " " else "\N{REPLACEMENT CHARACTER}" for char in text)


def summary(report: Report) -> str:
    """How many findings there are, and what was looked at."""
    counts = [(severity, sum(f.severity == severity for f in report.findings)) for severity in reversed(SEVERITIES)]
    found = ", ".join(_plural(count, severity) for severity, count in counts if count) or "no findings"
    looked_at = f"{_plural(report.files, 'file')}, {_plural(report.nodes, 'node')}, {report.traced} of them traced"
    return f"{found} in {looked_at}"


def _plural(count: int, word: str) -> str:
    if word == "info":
        return f"{count} info"
    return f"{count} {word}{'' if count == 1 else 's'}"
