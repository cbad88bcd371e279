"""A list of findings that are known, so that only new ones count: `check --baseline`."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

from preflight_analysis.findings.fingerprint import fingerprints
from preflight_analysis.findings.printable import printable
from preflight_analysis.findings.report import Report, relative

BASELINE_SCHEMA = "ros-preflight/baseline/1"


def to_baseline(report: Report, base: str) -> dict[str, Any]:
    """The findings as known ones, by file and rule, for review. `base` is the folder that the list is to lie in: what
    stands in it holds wherever that folder is. Only the fingerprints are compared."""
    named = fingerprints(report.findings, report.documents, base)
    entries = [
        {
            "file": printable(relative(finding.location.file, base)),
            "fingerprint": fingerprint,
            "message": printable(finding.message),
            "rule": finding.rule,
        }
        for finding, fingerprint in zip(report.findings, named, strict=True)
    ]
    entries.sort(key=lambda entry: (entry["file"], entry["rule"], entry["fingerprint"]))
    return {"schema": BASELINE_SCHEMA, "findings": entries}


def read_baseline(text: str) -> frozenset[str]:
    """The fingerprints in a list of known findings. Raises `ValueError` for what is none."""
    data = json.loads(text)
    if not isinstance(data, dict) or data.get("schema") != BASELINE_SCHEMA:
        raise ValueError(f"it has no schema {BASELINE_SCHEMA}")
    entries = data.get("findings")
    if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
        raise ValueError("its findings are no list of objects")
    return frozenset(str(entry.get("fingerprint")) for entry in entries)


def without_known(report: Report, known: frozenset[str], base: str) -> Report:
    """The report without the findings that the list in the folder `base` knows."""
    named = fingerprints(report.findings, report.documents, base)
    pairs = zip(report.findings, named, strict=True)
    return replace(report, findings=tuple(finding for finding, fingerprint in pairs if fingerprint not in known))
