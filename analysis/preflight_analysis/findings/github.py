"""Findings as workflow commands, which GitHub's runners turn into annotations of the files."""

from __future__ import annotations

from collections.abc import Mapping

from preflight_analysis.findings.finding import SEVERITIES, Finding, Severity
from preflight_analysis.findings.printable import printable
from preflight_analysis.findings.report import Report, closing, failure_lines, place, positions, relative

_COMMANDS: Mapping[Severity, str] = {"error": "error", "warning": "warning", "info": "notice", "hint": "notice"}


def to_github(report: Report, base: str) -> str:
    """A line for each finding, the most severe first: GitHub shows the first ten of a step only. Files below the folder
    `base`, where the repository was checked out, are relative to it."""
    ranked = sorted(report.findings, key=lambda finding: -SEVERITIES.index(finding.severity))
    failed = "".join(
        f"::error title=ros-preflight::{_escaped(line)}\n" for line in failure_lines(report.failures, base)
    )
    found = "".join(f"{_command(finding, report, base)}\n" for finding in ranked)
    return failed + found + "\n".join(closing(report)) + "\n"


def _command(finding: Finding, report: Report, base: str) -> str:
    (line, column), (end_line, end_column) = positions(finding.location, report.documents)
    file = printable(relative(finding.location.file, base))
    properties: dict[str, str | int] = {"file": file, "line": line + 1, "endLine": end_line + 1}
    if line == end_line:  # GitHub takes columns only then
        properties |= {"col": column + 1, "endColumn": end_column + 1}
    unsure = "" if finding.confidence == "certain" else f" ({finding.confidence})"
    properties["title"] = f"{finding.rule} {finding.name}{unsure}"
    text = [printable(finding.message)]
    text += [f"{place(r.location, report.documents, base)}: {printable(r.message)}" for r in finding.related]
    text += [f"fix: {printable(fix.title)}" for fix in finding.fixes]
    written = ",".join(f"{name}={_escaped(str(value), ':,')}" for name, value in properties.items())
    message = _escaped("\n".join(text))
    return f"::{_COMMANDS[finding.severity]} {written}::{message}"


def _escaped(text: str, also: str = "") -> str:
    """As the runner wants it: `%` first."""
    for char in "%\r\n" + also:
        text = text.replace(char, f"%{ord(char):02X}")
    return text
