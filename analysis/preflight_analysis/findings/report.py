"""Findings as text for people and as JSON for programs (`ros-preflight/check/1`, docs/formats)."""

from __future__ import annotations

import unicodedata
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import field, replace
from typing import Any, NamedTuple
from urllib.parse import quote

from preflight_analysis.catalogue.launches import catalogued_file
from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.findings.claim import Text
from preflight_analysis.findings.clipping import clipped
from preflight_analysis.findings.coverage import Coverage
from preflight_analysis.findings.doubt import Doubt
from preflight_analysis.findings.failure import Failure, failures_json
from preflight_analysis.findings.finding import SEVERITIES, Confidence, Finding, Related, Severity
from preflight_analysis.findings.lack import Missing, commands, in_words, missing
from preflight_analysis.findings.printable import printable

CHECK_SCHEMA = "ros-preflight/check/1"
_COLOURS: Mapping[Severity, str] = {"error": "31", "warning": "33", "info": "34", "hint": "36"}
_TAB = 4
_SHOWN_BEFORE = 200
_SHOWN_BEHIND = 400
"""How many characters of a line are shown before the place of a finding, and from there on."""


_MOST_ALIKE = 5
"""Further places of the same cause that are shown in a text."""
_SAME = "the same here"
_MANY = 4
"""So many findings that are alike in a file are one."""
_MENDED_TOGETHER = 2
"""So many are one where another file is to be mended."""
_MOST_NAMES = 5
"""That such a one has in its message."""
_FEW = 10
"""So many findings are seen at a glance: more are counted by rule."""


@dataclass(frozen=True, slots=True)
class Report:
    """What a check found. `documents` has the text of each file that a finding points into; one that is missing costs
    its source line and the right line number. `findings` are those of the robot, `missing` is what this machine lacks,
    with `problems`, sentences about its ROS. `hidden` counts those that are not among them, as they are not severe
    enough; `failures` are the parts of ours that raised, whose findings are missing."""

    findings: Sequence[Finding]
    documents: Mapping[str, Document] = field(repr=False)
    coverage: Coverage = field(default_factory=Coverage)
    missing: tuple[Missing, ...] = ()
    problems: tuple[str, ...] = ()
    hidden: Mapping[Severity, int] = field(default_factory=dict)
    failures: tuple[Failure, ...] = ()

    @classmethod
    def of(
        cls,
        findings: Iterable[Finding],
        documents: Mapping[str, Document],
        coverage: Coverage,
        problems: Iterable[str] = (),
        failures: Iterable[Failure] = (),
    ) -> Report:
        """The findings in order, and apart from them what is missing on this machine."""
        found = list(findings)
        lacks = missing((each.lack, each.location) for each in found if each.lack is not None)
        of_robot = sorted((each for each in found if each.lack is None), key=_rank)
        return cls(of_robot, documents, coverage, lacks, tuple(problems), failures=tuple(dict.fromkeys(failures)))

    def at_least(self, severity: Severity) -> Report:
        """The report with the findings of this severity and worse."""
        least = SEVERITIES.index(severity)
        shown = [each for each in self.findings if SEVERITIES.index(each.severity) >= least]
        hidden = Counter(each.severity for each in self.causes() if SEVERITIES.index(each.severity) < least)
        return replace(self, findings=shown, hidden=hidden + Counter(self.hidden))

    def causes(self) -> tuple[Finding, ...]:
        """One finding for each cause, whatever the number of its places: these are counted, in each format."""
        return tuple(by_cause(self.findings, alike=False))

    @property
    def complete(self) -> bool:
        """Whether nothing is missing on this machine."""
        return not self.missing and not self.problems


def _rank(finding: Finding) -> tuple[int, str, Span]:
    """The most severe first, then by file and place."""
    return -SEVERITIES.index(finding.severity), finding.location.file, finding.location.span


def by_cause(findings: Iterable[Finding], *, alike: bool = True) -> Iterator[Finding]:
    """One finding for each cause: the first of those that say the same of several places, or point at each other's
    place. The other places are related to it, and it holds in the roots of all of them. `alike`: also one for many
    that differ in a name alone."""
    for first, *others in _causes(findings, alike=alike):
        if not others:
            yield first
            continue
        shown = {first.location, *(related.location for related in first.related)}
        more = [Related(_same(each), each.location) for each in others if each.location not in shown]
        yield replace(
            first,
            related=(*first.related, *more),
            fixes=tuple(dict.fromkeys(fix for each in (first, *others) for fix in each.fixes)),
            roots=tuple(dict.fromkeys(root for each in (first, *others) for root in each.roots)),
        )


def to_json(report: Report) -> dict[str, Any]:
    """The document of `check --format json`. Dump it with sorted keys; lines and columns count from 1, columns in code
    points. `findings` has one for each cause, but each name of those that are alike, with a `condition` where it needs
    other arguments than those of its root; `rules` counts them. `coverage` is how much was looked at, `sources`
    there how many nodes are known in which way; `environment` is what is missing. `failures` are errors of ours: the
    findings of that rule, of all rules where it is null, are missing for that launch file."""
    coverage, causes = report.coverage, report.causes()
    return {
        "schema": CHECK_SCHEMA,
        "findings": [_finding_json(finding, report.documents) for finding in causes],
        "failures": failures_json(report.failures),
        "rules": {rule: dict(counts) for rule, counts in _by_rule(causes).items()},
        "environment": {
            "complete": report.complete,
            **missing_json(report),
            "problems": list(report.problems),
        },
        "coverage": {
            "files": coverage.files,
            "evaluated": coverage.evaluated,
            "not_evaluated": list(coverage.not_evaluated),
            "untried": coverage.untried,
            "nodes": coverage.total_nodes,
            "sources": dict(coverage.nodes),
            "unknown_nodes": list(coverage.unknown_nodes),
            "other_files": coverage.other_files,
        },
        "files": coverage.files,
        "nodes": coverage.total_nodes,
        "traced": coverage.nodes.get("trace", 0),
    }


def to_text(report: Report, *, base: str | None = None, colour: bool = False, host: str | None = None) -> str:
    """For reading: place, severity, rule and message, the source line with the place underlined, other places, fixes;
    at the end what is missing here, how many findings there are and what was looked at. Ends with a newline. Files
    below the folder `base` are shown relative to it. What is found of one cause in several places is shown once.
    Places are links to the files of this `host`, if it is given."""
    blocks = [*_incomplete(report.coverage)]
    for first, *others in _causes(report.findings):
        lines = [*finding_lines(first, report.documents, base, colour=colour, host=host)]
        shown = {related.location for related in first.related}
        more = [each for each in others if each.location not in shown]
        lines += [
            f"  {_linked(each.location, report.documents, base, host)}: {printable(_same(each))}"
            for each in more[:_MOST_ALIKE]
        ]
        if len(more) > _MOST_ALIKE:
            lines.append(f"  and in {len(more) - _MOST_ALIKE} more places")
        blocks.append("\n".join(lines))
    return "\n".join(("\n\n".join([*blocks, *closing(report, base)]), *_first_steps(report, base))) + "\n"


def closing(report: Report, base: str | None = None) -> Iterator[str]:
    """What follows the findings, in blocks: their number by rule, where there are many, what is missing on this
    machine, what was not looked at, and the summary. Files below the folder `base` are shown relative to it."""
    causes = report.causes()
    if len(causes) > _FEW:
        yield "\n".join(line for _, line in _rule_lines(causes))
    if not report.complete:
        yield "\n".join(environment_lines(report))
    if lines := [*_not_looked_at(report.coverage, base)]:
        yield "\n".join(("not looked at:", *lines))
    found = _counted(Counter(finding.severity for finding in causes)) or "no findings"
    yield f"{found}{_hidden(report)}; {report.coverage}"


def statistics(report: Report, base: str | None = None) -> str:
    """How many findings each rule has, and of how many a fix is certain, instead of the findings."""
    causes = report.causes()
    fixable = Counter(each.rule for each in causes if each.safe_fix is not None)
    lines = [f"{line}, {n} fixed by --fix" if (n := fixable[rule]) else line for rule, line in _rule_lines(causes)]
    return "\n".join([*_incomplete(report.coverage), *lines, [*closing(report, base)][-1]]) + "\n"


def _hidden(report: Report) -> str:
    if not report.hidden:
        return ""
    least = next(each for each in SEVERITIES if report.hidden.get(each))
    return f" ({_counted(report.hidden)} not shown: --severity {least})"


def _incomplete(coverage: Coverage) -> Iterator[str]:
    """That half or more was not looked at, which a clean result does not show."""
    if coverage.files and 2 * coverage.evaluated <= coverage.files:
        files = f"only {coverage.evaluated} of {_plural(coverage.files, 'launch file')}"
        yield f"{files} evaluated as a whole: findings of the others are missing"
    nodes, unknown = coverage.total_nodes, coverage.nodes.get("none", 0)
    if nodes and 2 * unknown >= nodes:
        what = f"what {unknown} of {_plural(nodes, 'node')} do is unknown"
        yield f"{what}: findings of their topics and parameters are missing"


def _first_steps(report: Report, base: str | None) -> Iterator[str]:
    """Where to begin: with what stops the launch, else with the most severe; and what need not be done by hand."""
    causes = report.causes()
    grave = [each for each in causes if each.severity in ("error", "warning")]
    if len(causes) > _FEW and grave:
        stops = [each for each in grave if each.effect == "stops-launch"]
        begin = min(stops, key=lambda each: each.launch_order, default=grave[0])
        why = ", which stops the launch" if stops else ""
        yield f"begin with {place(begin.location, report.documents, base)}: {begin.rule}{why}"
    if fixable := sum(each.safe_fix is not None for each in causes):
        yield f"{fixable} of them {'is' if fixable == 1 else 'are'} fixed by --fix"


def _not_looked_at(coverage: Coverage, base: str | None) -> Iterator[str]:
    if coverage.not_evaluated:
        files = [printable(relative(file, base)) for file in coverage.not_evaluated]
        yield f"  launch files that were not evaluated as a whole: {_first(files)}"
    if coverage.unknown_nodes:
        yield f"  what these nodes do: {_first([printable(name) for name in coverage.unknown_nodes])}"


def _first(names: Sequence[str]) -> str:
    more = len(names) - _FEW
    return ", ".join(names[:_FEW]) + (f" and {more} more" if more > 0 else "")


def environment_lines(report: Report) -> Iterator[str]:
    """What is missing on this machine, and the commands that install it."""
    yield "missing on this machine:"
    yield from (f"  {printable(line)}" for line in (*in_words(report.missing), *report.problems))
    yield from (f"    {printable(command)}" for command in commands(report.missing))


def _rule_lines(causes: Sequence[Finding]) -> Iterator[tuple[str, str]]:
    """The rules that have most findings first, each with a line about it."""
    names = {finding.rule: finding.name for finding in causes}
    for rule, counts in sorted(_by_rule(causes).items(), key=lambda each: (-each[1].total(), each[0])):
        yield rule, f"{rule} {names[rule]}: {_counted(counts)}"


def _by_rule(causes: Iterable[Finding]) -> dict[str, Counter[Severity]]:
    found: dict[str, Counter[Severity]] = {}
    for finding in causes:
        found.setdefault(finding.rule, Counter())[finding.severity] += 1
    return found


def _counted(counts: Mapping[Severity, int]) -> str:
    """`2 errors, 1 warning`, the most severe first."""
    return ", ".join(_plural(counts[each], each) for each in reversed(SEVERITIES) if counts.get(each))


class _Cause(NamedTuple):
    """What findings have in common that are shown as one: `where` is a file, or "" for wherever they are."""

    rule: str
    severity: Severity
    said: Text | tuple[str, Confidence, Text]
    where: str
    least: int = 1
    """So many names of those that are alike are shown as one."""


def _causes(findings: Iterable[Finding], *, alike: bool = True) -> Iterator[Sequence[Finding]]:
    """Findings that say the same of several places, or of which each points at the other's place, together, and many
    that are alike. What names nothing is of one cause in one file only."""
    findings = [*findings]
    found: dict[_Cause, list[Finding]] = {}
    pointing: dict[tuple[str, Location, Location], list[Finding]] = {}
    many = _many_alike(findings) if alike else frozenset()
    for finding in findings:
        cause = _alike(finding)
        if cause in many:
            found.setdefault(cause, []).append(finding)
            continue
        where = "" if finding.subject.name else finding.location.file
        key = _Cause(finding.rule, finding.severity, finding.text.cause, where)
        same = found.get(key)
        to = [(related.location, finding.location) for related in finding.related]
        back = (pointing.get((finding.rule, there, here)) for there, here in to)
        group = same if same is not None else next(filter(None, back), None)
        if group is None:
            group = found[key] = []
        group.append(finding)
        for there, here in to:
            pointing.setdefault((finding.rule, here, there), group)
    for cause, group in found.items():
        yield _as_one(group) if cause in many else group


def _many_alike(findings: Iterable[Finding]) -> frozenset[_Cause]:
    """The causes for which there are so many names that one finding has them all."""
    names: dict[_Cause, set[str]] = {}
    for finding in findings:
        if finding.alike is not None:
            names.setdefault(_alike(finding), set()).add(finding.alike.name)
    return frozenset(cause for cause, of in names.items() if len(of) >= cause.least)


def _alike(finding: Finding) -> _Cause:
    what, mended_in = (finding.alike.what, finding.alike.mended_in) if finding.alike is not None else (Text(""), "")
    said, least = (finding.condition, finding.confidence, what), _MENDED_TOGETHER if mended_in else _MANY
    return _Cause(finding.rule, finding.severity, said, mended_in or finding.location.file, least)


def _as_one(group: Sequence[Finding]) -> Sequence[Finding]:
    """Findings that are alike, the first of which speaks of all."""
    first, alike = group[0], [each.alike for each in group if each.alike is not None]
    names = [*dict.fromkeys(f"'{each.name}'" for each in alike)]
    more = f" and {len(names) - _MOST_NAMES} more" if len(names) > _MOST_NAMES else ""
    message = f"{len(names)} {alike[0].what}: {', '.join(names[:_MOST_NAMES])}{more}"
    return (replace(first, message=clipped(message)), *group[1:])


def _same(finding: Finding) -> str:
    """What is said at a further place of a cause."""
    return f"'{finding.alike.name}': {_SAME}" if finding.alike is not None else _SAME


def missing_json(report: Report) -> dict[str, Any]:
    """What is missing on this machine, and the commands that install it."""
    return {
        "missing": [_missing_json(each, report.documents) for each in report.missing],
        "commands": list(commands(report.missing)),
    }


def _missing_json(each: Missing, documents: Mapping[str, Document]) -> dict[str, Any]:
    return {
        "kind": each.lack.kind,
        "name": each.lack.name,
        "remedy": each.lack.remedy,
        "count": each.count,
        "first": {"file": each.places[0].file, "range": _range_json(each.places[0], documents)},
    }


def _finding_json(finding: Finding, documents: Mapping[str, Document]) -> dict[str, Any]:
    return {
        "rule": finding.rule,
        "name": finding.name,
        "severity": finding.severity,
        "confidence": finding.confidence,
        "effect": finding.effect,
        "kind": finding.kind,
        "subject": {"kind": finding.subject.kind, "name": finding.subject.name},
        "node": finding.text.node,
        "candidates": list(finding.candidates),
        "doubts": [doubt_json(each) for each in dict.fromkeys(finding.doubts)],
        "message": finding.message,
        **({"condition": finding.condition} if finding.condition else {}),
        "file": finding.location.file,
        "range": _range_json(finding.location, documents),
        "related": [
            {"message": r.message, "file": r.location.file, "range": _range_json(r.location, documents)}
            for r in finding.related
        ],
        "roots": list(finding.roots),
        "fixes": [fix.title for fix in finding.fixes],
    }


def doubt_json(doubt: Doubt) -> dict[str, str]:
    """A doubt: its name, what it says, what it is about, and what would remove it; the latter two may be empty."""
    return {"name": doubt.reason.name, "message": doubt.reason.sentence, "about": doubt.of, "remedy": doubt.remedy}


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
    finding: Finding,
    documents: Mapping[str, Document],
    base: str | None,
    *,
    colour: bool = False,
    host: str | None = None,
) -> Iterator[str]:
    """One finding for reading, without the line breaks. Places are links to the files of this `host`, if it is
    given."""
    severity = f"{finding.severity}{_unsure(finding.confidence)} {finding.rule} {finding.name}"
    paint = f"\x1b[{_COLOURS[finding.severity]}m{{}}\x1b[0m" if colour else "{}"
    severity = paint.format(severity)
    yield f"{_linked(finding.location, documents, base, host)}: {severity}: {printable(finding.message)}"
    yield from _underlined(finding.location, documents, paint)
    for related in finding.related:
        yield f"  {_linked(related.location, documents, base, host)}: {printable(related.message)}"
    for fix in finding.fixes:
        yield f"  fix: {printable(fix.title)}"


def _unsure(confidence: Confidence) -> str:
    return "" if confidence == "certain" else f" ({confidence})"


def place(location: Location, documents: Mapping[str, Document], base: str | None = None) -> str:
    """`file:line:column`, both counted from 1; the file relative to the folder `base` where it lies below it."""
    (line, column), _ = positions(location, documents)
    return f"{printable(relative(location.file, base))}:{line + 1}:{column + 1}"


def _linked(location: Location, documents: Mapping[str, Document], base: str | None, host: str | None) -> str:
    """The place, as a link to its file (OSC 8) where `host` names this machine."""
    text = place(location, documents, base)
    if host is None or not location.file.startswith("/") or catalogued_file(location.file) is not None:
        return text
    # Without the line, as terminals differ in how they take it; ripgrep does so too.
    uri = f"file://{quote(host)}{quote(location.file, errors='surrogateescape')}"
    return f"\x1b]8;;{uri}\x1b\\{text}\x1b]8;;\x1b\\"


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


def relative(file: str, base: str | None) -> str:
    """The path from the folder `base` where the file lies below it; the name of one of the catalogue; else the path as
    it is."""
    if base is not None and file.startswith(base.rstrip("/") + "/"):
        return file[len(base.rstrip("/")) + 1 :]
    catalogued = catalogued_file(file)
    return catalogued.label if catalogued is not None else file


def failure_lines(failures: Sequence[Failure], base: str | None = None) -> list[str]:
    """A line for each rule and error: a rule that fails on one launch mostly fails on many. Files below the folder
    `base` are shown relative to it."""
    same: dict[tuple[str | None, str], list[Failure]] = {}
    for each in failures:
        same.setdefault((each.rule, each.error), []).append(each)
    lines = []
    for first, *others in same.values():
        more = f" and {len(others)} more" if others else ""
        lines.append(printable(first.message(f"{relative(first.file, base)}{more}")))
    return lines


def _plural(count: int, word: str) -> str:
    if word == "info":
        return f"{count} info"
    return f"{count} {word}{'' if count == 1 else 's'}"
