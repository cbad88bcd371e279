"""Which files are launched, and what holds of a file that several of them reach: see docs/architecture.md."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import replace
from itertools import groupby
from operator import attrgetter

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.findings.lack import Lack
from preflight_analysis.incremental.kept import Kept


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


def by_file(
    reports: Iterable[RootFindings], every_root: Collection[str], kept: Kept | None = None
) -> dict[str, tuple[Finding, ...]]:
    """The findings of each file over all roots, each once, with the roots in which it holds.

    A finding about a value holds in any context. One of the rules `every_root` (by id), which speak of what nodes do
    together, or one that is marked so, is shown only if it holds in every root that reaches its file. What was `kept`
    of the files of which the same is found is taken over.
    """
    reports, kept, speaking = tuple(reports), kept or Kept(), frozenset(every_root)
    found: dict[str, list[tuple[str, tuple[Finding, ...]]]] = {}
    for report in reports:
        for path, of_file in _grouped(report.findings).items():
            found.setdefault(path, []).append((report.root, of_file))
    made = {}
    for path, of_roots in found.items():
        reaching = tuple(report.root for report in reports if path in report.files)
        if shown := kept.get(_of_file, path, tuple(of_roots), reaching, speaking):
            made[path] = shown
    return made


def lacks_once(findings: tuple[Finding, ...]) -> tuple[Finding, ...]:
    """The findings of a file, of those that show the same lack of this machine only the first."""
    shown_before: set[Lack] = set()
    shown = []
    for finding in findings:
        if finding.lack is None or finding.lack not in shown_before:
            shown.append(finding)
        if finding.lack is not None:
            shown_before.add(finding.lack)
    return tuple(shown) if len(shown) < len(findings) else findings


def causes_first(findings: Mapping[str, tuple[Finding, ...]], crash: str) -> Mapping[str, tuple[Finding, ...]]:
    """The findings by file, each crash of which the cause is a finding of the same root behind that as a related place.
    `crash` is the rule that reports crashes."""
    marked = [finding for found in findings.values() for finding in found if finding.crash_of]
    causes = [finding for finding in marked if finding.rule != crash]
    behind: dict[int, list[Related]] = {}
    without: set[int] = set()
    for ended in marked if causes else ():
        if ended.rule != crash:
            continue
        cause = next((each for each in causes if each.crash_of == ended.crash_of and _share_root(each, ended)), None)
        if cause is not None:
            without.add(id(ended))
            behind.setdefault(id(cause), []).append(Related(ended.message, ended.location))
    if not without:
        return findings
    folded = dict(findings)
    for path in {finding.location.file for finding in marked}:
        folded[path] = tuple(
            replace(each, related=(*each.related, *behind[id(each)])) if id(each) in behind else each
            for each in findings.get(path, ())
            if id(each) not in without
        )
    return folded


def _share_root(one: Finding, other: Finding) -> bool:
    return one.roots == other.roots or not set(one.roots).isdisjoint(other.roots)


def _grouped(findings: Iterable[Finding]) -> dict[str, tuple[Finding, ...]]:
    files: dict[str, tuple[Finding, ...]] = {}
    for path, of_file in groupby(findings, attrgetter("location.file")):
        files[path] = (*files.get(path, ()), *of_file)
    return files


def _of_file(
    found: tuple[tuple[str, tuple[Finding, ...]], ...], reaching: tuple[str, ...], every_root: frozenset[str]
) -> tuple[Finding, ...]:
    """What is shown of one file: `found` has what is found in each root."""
    first: dict[tuple[str, Location], list[Finding]] = {}
    holds: dict[tuple[str, Location], list[str]] = {}
    for root, findings in found:
        for found_here in findings:
            finding = _holding_in(found_here, (root,))
            key = (finding.rule, finding.location)
            same = first.setdefault(key, [])
            # One root may say several things of one place; a second root's wording of the same thing is not news.
            if same and same[0].condition and not finding.condition:
                same[:] = [finding]  # what needs no condition counts before what has one
            elif not same or (root in same[0].roots and finding not in same and not finding.condition):
                same.append(finding)
            if root not in (roots_of := holds.setdefault(key, [])):
                roots_of.append(root)
    shown: list[Finding] = []
    for (rule, location), same in first.items():
        held = holds[rule, location]
        everywhere = set(reaching) <= set(held)
        of_rule = rule in every_root
        shown.extend(
            _holding_in(finding, tuple(held)) for finding in same if everywhere or not (of_rule or finding.every_root)
        )
    return tuple(sorted(shown, key=lambda finding: (finding.location.span, finding.rule)))


def _holding_in(finding: Finding, roots: tuple[str, ...]) -> Finding:
    return finding if finding.roots == roots else replace(finding, roots=roots)
