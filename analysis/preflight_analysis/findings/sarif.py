"""Findings as SARIF 2.1.0, which code scanning of GitHub, GitLab, Azure and editors read."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import PurePosixPath
from typing import Any
from urllib.parse import quote

from preflight_analysis import __version__
from preflight_analysis.catalogue.launches import catalogued_file
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location
from preflight_analysis.findings.failure import Failure
from preflight_analysis.findings.finding import Finding, Fix, Severity
from preflight_analysis.findings.fingerprint import fingerprints
from preflight_analysis.findings.policy import cell
from preflight_analysis.findings.printable import printable
from preflight_analysis.findings.report import Report, by_cause, doubt_json, environment_lines, positions, relative
from preflight_analysis.findings.rule_description import RuleDescription

SCHEMA = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
FINGERPRINT = "rosPreflight/v1"
_BASE_ID = "SRCROOT"
_LEVELS: Mapping[Severity, str] = {"error": "error", "warning": "warning", "info": "note", "hint": "note"}


def to_sarif(report: Report, rules: Sequence[RuleDescription], base: str) -> dict[str, Any]:
    """A log with one run, and a result for each cause. Files below the folder `base` are relative to it; `rules` are
    all that there are, those with findings are described. Severity and confidence, of which SARIF knows less, are in
    the properties of each result."""
    findings = [*by_cause(report.findings)]
    spoke = {finding.rule for finding in findings}
    described = [rule for rule in rules if rule.id in spoke]
    index = {rule.id: number for number, rule in enumerate(described)}
    named = fingerprints(findings, report.documents, base)
    results = [
        _result(finding, index[finding.rule], fingerprint, report.documents, base)
        for finding, fingerprint in zip(findings, named, strict=True)
    ]
    driver = {"name": "ros-preflight", "version": __version__, "rules": [_rule(rule) for rule in described]}
    run = {
        "tool": {"driver": driver},
        "columnKind": "unicodeCodePoints",
        "originalUriBaseIds": {_BASE_ID: {"uri": PurePosixPath(base, "_").as_uri()[:-1]}},
        "invocations": [
            {
                "executionSuccessful": not report.failures,
                "toolConfigurationNotifications": _notes(report),
                "toolExecutionNotifications": [_failed(failure, base) for failure in report.failures],
            }
        ],
        "results": results,
    }
    return {"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}


def _notes(report: Report) -> list[dict[str, Any]]:
    """What is missing on this machine, and how much was looked at: no results, as they are nobody's mistakes."""
    missing = () if report.complete else ("\n".join(environment_lines(report)),)
    return [{"level": "note", "message": {"text": text}} for text in (*missing, str(report.coverage))]


def _failed(failure: Failure, base: str) -> dict[str, Any]:
    return {
        "level": "error",
        "message": {"text": printable(failure.message(relative(failure.file, base)))},
        **({"associatedRule": {"id": failure.rule}} if failure.rule is not None else {}),
        "locations": [{"physicalLocation": {"artifactLocation": _artifact(failure.file, base)}}],
    }


def _rule(rule: RuleDescription) -> dict[str, Any]:
    text = f"{rule.what}\n\n{rule.why}"
    example = f"Example:\n\n```\n{rule.example}\n```\n\nUse instead:\n\n```\n{rule.instead}\n```"
    return {
        "id": rule.id,
        "name": rule.name,
        "shortDescription": {"text": rule.name.replace("-", " ")},
        "fullDescription": {"text": rule.what},
        "help": {"text": text, "markdown": f"{text}\n\n{example}\n"},
        "defaultConfiguration": {"level": _LEVELS[rule.severity]},
    }


def _result(
    finding: Finding, rule_index: int, fingerprint: str, documents: Mapping[str, Document], base: str
) -> dict[str, Any]:
    return {
        "ruleId": finding.rule,
        "ruleIndex": rule_index,
        "level": _LEVELS[finding.severity],
        "message": {"text": printable(finding.message)},
        "locations": [{"physicalLocation": _physical(finding.location, documents, base)}],
        "relatedLocations": [
            {
                "id": number,
                "message": {"text": printable(related.message)},
                "physicalLocation": _physical(related.location, documents, base),
            }
            for number, related in enumerate(finding.related)
        ],
        "fixes": [_fix(fix, documents, base) for fix in finding.fixes if fix.edits],
        "partialFingerprints": {FINGERPRINT: fingerprint},
        "properties": {
            "severity": finding.severity,
            "confidence": finding.confidence,
            "effect": finding.effect,
            "kind": finding.kind,
            "decidedBy": cell(finding),
            "doubts": [doubt_json(each) for each in dict.fromkeys(finding.doubts)],
            **({"condition": finding.condition} if finding.condition else {}),
            "roots": [relative(root, base) for root in finding.roots],
        },
    }


def _fix(fix: Fix, documents: Mapping[str, Document], base: str) -> dict[str, Any]:
    changes: dict[str, list[dict[str, Any]]] = {}
    for edit in fix.edits:
        replacement = {"deletedRegion": _region(edit.location, documents), "insertedContent": {"text": edit.text}}
        changes.setdefault(edit.location.file, []).append(replacement)
    return {
        "description": {"text": printable(fix.title)},
        "artifactChanges": [
            {"artifactLocation": _artifact(file, base), "replacements": replacements}
            for file, replacements in changes.items()
        ],
    }


def _physical(location: Location, documents: Mapping[str, Document], base: str) -> dict[str, Any]:
    return {"artifactLocation": _artifact(location.file, base), "region": _region(location, documents)}


def _region(location: Location, documents: Mapping[str, Document]) -> dict[str, int]:
    (line, column), (end_line, end_column) = positions(location, documents)
    return {"startLine": line + 1, "startColumn": column + 1, "endLine": end_line + 1, "endColumn": end_column + 1}


def _artifact(file: str, base: str) -> dict[str, str]:
    path = relative(file, base)
    if path == file or catalogued_file(file) is not None:
        return {"uri": PurePosixPath(file).as_uri()}
    return {"uri": quote(os.fsencode(path)), "uriBaseId": _BASE_ID}
