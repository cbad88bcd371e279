"""Other severities than the rules' own, everywhere or below some paths, as a project wants them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from fnmatch import fnmatchcase

from preflight_analysis.dataclass import dataclass
from preflight_analysis.findings.finding import SEVERITIES, Finding, Severity

OFF = "off"
ALL = "all"
"""Stands for each rule that is not named beside it."""
CHOICES: Mapping[str, Severity | None] = {OFF: None, **{severity: severity for severity in SEVERITIES}}
"""What may be asked for; None for a rule that is not to speak."""


@dataclass(frozen=True, slots=True)
class Severities:
    """The severities of rules in the files that `pattern` matches: a path in which `*` stands for anything, slashes
    among it, or a folder, which stands for all below it. None is every file."""

    rules: Mapping[str, Severity | None]
    pattern: str | None = None

    def speak_of(self, file: str) -> bool:
        """Whether they hold in a file."""
        pattern = self.pattern
        return pattern is None or fnmatchcase(file, pattern) or fnmatchcase(file, f"{pattern.rstrip('/')}/*")


def adjusted(findings: Iterable[Finding], wanted: Sequence[Severities]) -> tuple[Finding, ...]:
    """The findings with the severities that are `wanted` where they are, the last that speak of one counting; without
    those that are off. What is missing on this machine stays the hint that it is."""
    if not wanted:
        return tuple(findings)
    kept = []
    for finding in findings:
        severity: Severity | None = finding.severity
        for each in wanted:
            rule = finding.rule if finding.rule in each.rules else ALL
            if rule in each.rules and each.speak_of(finding.location.file):
                severity = each.rules[rule]
        if finding.lack is not None and severity is not None:
            severity = finding.severity
        if severity is not None:
            kept.append(finding if severity == finding.severity else replace(finding, severity=severity))
    return tuple(kept)
