"""Other severities than the rules' own, and the choice of rules, everywhere or below some paths: what a project or a
command wants."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from fnmatch import fnmatchcase
from typing import Final, Literal

from preflight_analysis.dataclass import dataclass
from preflight_analysis.findings.finding import SEVERITIES, Finding, Severity

Wanted = Literal["off", "on"] | Severity
"""What may be asked for: that a rule does not speak, that it does, in its own severity or in another one."""
OFF: Final = "off"
ON: Final = "on"
ALL = "all"
"""Stands for each rule that is not named beside it."""
CHOICES: tuple[Wanted, ...] = (OFF, ON, *SEVERITIES)


def family_of(rule: str) -> str:
    """The letters before the number of a rule: `TOP` of `TOP001`."""
    return rule.rstrip("0123456789")


@dataclass(frozen=True, slots=True)
class Severities:
    """The severities of rules, of families or of `ALL`, in the files that `pattern` matches: a path in which `*` stands
    for anything, slashes among it, or a folder, which stands for all below it. None is every file."""

    rules: Mapping[str, Wanted]
    pattern: str | None = None

    def speak_of(self, file: str) -> bool:
        """Whether they hold in a file."""
        pattern = self.pattern
        return pattern is None or fnmatchcase(file, pattern) or fnmatchcase(file, f"{pattern.rstrip('/')}/*")

    def of(self, rule: str) -> Wanted | None:
        """What is wanted of a rule: by its own entry, else by that of its family, else by that of all."""
        return next((self.rules[key] for key in (rule, family_of(rule), ALL) if key in self.rules), None)


def chosen(select: Iterable[str] = (), ignore: Iterable[str] = ()) -> Mapping[str, Wanted]:
    """What `Severities` have where only some rules or families are selected (none: all), and some are ignored."""
    selected: dict[str, Wanted] = dict.fromkeys(select, ON)
    rest: dict[str, Wanted] = {ALL: OFF} if selected and ALL not in selected else {}
    return {**rest, **selected, **dict.fromkeys(ignore, OFF)}


def adjusted(findings: Iterable[Finding], wanted: Sequence[Severities]) -> tuple[Finding, ...]:
    """The findings with the severities that are `wanted` where they are, the last that speak of one counting; without
    those that are off. What is missing on this machine stays the hint that it is."""
    if not wanted:
        return tuple(findings)
    kept = []
    for finding in findings:
        severity, shown = finding.severity, True
        for each in wanted:
            match each.of(finding.rule) if each.speak_of(finding.location.file) else None:
                case None:
                    pass
                case "off" | "on" as asked:
                    shown = asked == ON
                case asked:
                    shown, severity = True, asked if finding.lack is None else severity
        if shown:
            kept.append(finding if severity == finding.severity else replace(finding, severity=severity))
    return tuple(kept)
