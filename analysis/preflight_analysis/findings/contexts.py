"""Which files are launched, and what holds of a file that several of them reach: DESIGN, "Contexts"."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, replace

from preflight_analysis.documents.span import Location
from preflight_analysis.findings.finding import Finding


@dataclass(frozen=True, slots=True)
class RootFindings:
    """The findings of one root, and the files that it reads. `root` is its path, with its arguments if it has any."""

    root: str
    files: frozenset[str]
    findings: tuple[Finding, ...]


def roots(reached: Mapping[str, Iterable[str]]) -> tuple[str, ...]:
    """The keys of `reached` that no other key reaches, in order; of files that include each other in a circle the
    first. `reached` maps each launch file to the files that it includes, directly or not (itself does not matter)."""
    below = {file: frozenset(files) - {file} for file, files in reached.items()}
    found = [file for file in below if not any(file in files for other, files in below.items() if other != file)]
    covered = set(found).union(*(below[file] for file in found))
    for file, files in below.items():
        if file not in covered:
            found.append(file)
            covered |= {file, *files}
    return tuple(file for file in below if file in found)


def by_file(reports: Iterable[RootFindings], every_root: Collection[str]) -> dict[str, tuple[Finding, ...]]:
    """The findings of each file over all roots, each once, with the roots in which it holds.

    A finding about a value holds in any context. One of the rules `every_root` (by id), which speak of what nodes do
    together, is shown only if it holds in every root that reaches its file.
    """
    reports = tuple(reports)
    first: dict[tuple[str, Location], list[Finding]] = {}
    holds: dict[tuple[str, Location], list[str]] = {}
    for report in reports:
        for found_here in report.findings:
            finding = _holding_in(found_here, (report.root,))
            key = (finding.rule, finding.location)
            same = first.setdefault(key, [])
            # One root may say several things of one place; a second root's wording of the same thing is not news.
            if not same or (report.root in same[0].roots and finding not in same):
                same.append(finding)
            if report.root not in (roots_of := holds.setdefault(key, [])):
                roots_of.append(report.root)
    files: dict[str, list[Finding]] = {}
    for (rule, location), found in first.items():
        held = holds[rule, location]
        if rule in every_root:
            reaching = {r.root for r in reports if location.file in r.files}
            if not reaching <= set(held):
                continue
        files.setdefault(location.file, []).extend(_holding_in(f, tuple(held)) for f in found)
    return {file: tuple(sorted(found, key=lambda f: (f.location.span, f.rule))) for file, found in files.items()}


def _holding_in(finding: Finding, roots: tuple[str, ...]) -> Finding:
    return finding if finding.roots == roots else replace(finding, roots=roots)
