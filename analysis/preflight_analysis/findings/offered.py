"""The fixes that are offered: those whose edits pass the gate."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from preflight_analysis.edits.gate import TextOf, passes
from preflight_analysis.findings.finding import Finding


def with_offered_fixes(findings: Iterable[Finding], text_of: TextOf) -> tuple[Finding, ...]:
    """The findings, each with those of its fixes that may be offered. It parses each file that a fix changes, so it is
    for who shows fixes, not for each keystroke."""
    return tuple(_offered(finding, text_of) for finding in findings)


def _offered(finding: Finding, text_of: TextOf) -> Finding:
    fixes = tuple(fix for fix in finding.fixes if passes(f"{finding.rule} {fix.title}", fix.edits, text_of))
    return finding if fixes == finding.fixes else replace(finding, fixes=fixes)
