"""Findings as GitLab's Code Quality report, which a merge request shows beside its changes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from preflight_analysis.findings.finding import Severity
from preflight_analysis.findings.fingerprint import fingerprints
from preflight_analysis.findings.printable import printable
from preflight_analysis.findings.report import Report, by_cause, place, positions, relative

_SEVERITIES: Mapping[Severity, str] = {"error": "critical", "warning": "major", "info": "minor", "hint": "info"}


def to_gitlab(report: Report, base: str) -> list[dict[str, Any]]:
    """An object for each cause, with the keys that GitLab requires: `description`, `check_name`, `fingerprint`,
    `severity` and `location` (https://docs.gitlab.com/ci/testing/code_quality/, "Code Quality report format"). Files
    below the folder `base`, which is that of the repository, are relative to it. Lines are counted from 1."""
    findings = [*by_cause(report.findings)]
    named = fingerprints(findings, report.documents, base)
    found = []
    for finding, fingerprint in zip(findings, named, strict=True):
        (line, _), (end_line, _) = positions(finding.location, report.documents)
        text = [printable(finding.message)]
        text += [f"{place(r.location, report.documents, base)}: {printable(r.message)}" for r in finding.related]
        found.append(
            {
                "description": "\n".join(text),
                "check_name": f"{finding.rule} {finding.name}",
                "fingerprint": fingerprint,
                "severity": _SEVERITIES[finding.severity],
                "location": {
                    "path": printable(relative(finding.location.file, base)),
                    "lines": {"begin": line + 1, "end": end_line + 1},
                },
            }
        )
    return found
