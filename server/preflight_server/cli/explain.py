"""`ros-preflight explain`: what a rule checks, or what stands behind one finding."""

from __future__ import annotations

import argparse
import os
import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

from preflight_analysis.documents.hash_comments import has_hash_comments
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.findings.fingerprint import fingerprints
from preflight_analysis.findings.policy import EFFECTS, limit_in_words
from preflight_analysis.findings.printable import printable
from preflight_analysis.findings.report import Report, finding_lines, place, to_json
from preflight_analysis.rules.reference import rule_json
from preflight_analysis.rules.registry import all_rules

from preflight_server.cli import options
from preflight_server.cli.check import look_at
from preflight_server.cli.errors import BROKEN, CLEAN, CannotDoError
from preflight_server.cli.launches import launches
from preflight_server.cli.output import colours, links, print_json, print_text, say_failures
from preflight_server.cli.paths import with_paths
from preflight_server.cli.rules import rule_ids, rule_page, rules_named

DESCRIPTION = """Explain a rule by its id or name, or one finding. A finding is FILE:LINE or FILE:LINE:COLUMN as
`check` prints it, or its fingerprint in sarif, gitlab or a baseline. For a finding the command analyses the launches as
`check` does, and runs their nodes in a sandbox; calling it is your consent. --no-run executes nothing."""
SCHEMA = "ros-preflight/explain/1"
_PLACE = re.compile(r"(?P<file>.+?):(?P<line>\d+)(?::(?P<column>\d+))?:?")
_FINGERPRINT = re.compile(r"[0-9a-f]{16}:\d+")
_CONFIDENCE = {
    "certain": "All that it depends on is known.",
    "likely": "All nodes that it depends on are known, as far as a run or an annotation shows.",
    "possible": "Part of what it depends on is not known; it may be wrong.",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's own options."""
    options.add_running(parser, ("text", "json"))
    what = parser.add_argument(
        "what", metavar="RULE|FINDING", help="a rule (TOP001) or a finding (launch/robot.launch:7:31)"
    )
    what.completer = rule_ids  # type: ignore[attr-defined]  # argcomplete's
    parser.add_argument(
        "launch_args",
        metavar="FILE",
        nargs="*",
        help="for a finding: the launch files, with name:=value, as for check (default: the current folder)",
    )
    parser.set_defaults(changed_since=None)


def run(args: argparse.Namespace) -> int:
    """Print the explanation."""
    if rules := rules_named(args.what):
        if args.format == "json":
            print_json({"schema": SCHEMA, "findings": [], "rules": [rule_json(rule) for rule in rules]})
        else:
            print_text(rule_page(rules[0]))
        return CLEAN
    if not _PLACE.fullmatch(args.what) and not _FINGERPRINT.fullmatch(args.what):
        raise CannotDoError(f"{args.what} is neither a rule nor a finding; `ros-preflight rules` lists the rules")
    chosen = launches(args)
    report, _ = look_at(chosen, args)
    say_failures(report.failures)
    code = BROKEN if report.failures else CLEAN
    found = [*_named(report, args.what)]
    if not found:
        raise CannotDoError(f"there is no finding at {args.what}; `ros-preflight check` lists them")
    spoke = {finding.rule for finding in found}
    rules = tuple(rule for rule in all_rules() if rule.id in spoke)
    if args.format == "json":
        document = to_json(Report(found, report.documents))
        data: dict[str, Any] = {"schema": SCHEMA, "findings": document["findings"]}
        data["rules"] = [rule_json(rule) for rule in rules]
        print_json(with_paths(data, args, [each.home for each in chosen]))
        return code
    blocks = ["\n".join(_lines(finding, report)) for finding in found]
    pages = [rule_page(rule) for rule in rules]
    print_text("\n\n".join(blocks) + "\n\n" + "\n".join(pages), painted=colours())
    return code


def _named(report: Report, what: str) -> Iterator[Finding]:
    """The findings at a place, or the one with a fingerprint."""
    base = os.getcwd()
    if _FINGERPRINT.fullmatch(what):
        named = fingerprints(report.findings, report.documents, base)
        yield from (each for each, name in zip(report.findings, named, strict=True) if name == what)
        return
    found = _PLACE.fullmatch(what)
    assert found is not None
    wanted = f"{printable(os.path.abspath(found['file']))}:{found['line']}"
    wanted += f":{found['column']}" if found["column"] else ""
    for finding in report.findings:
        at = place(finding.location, report.documents)
        if wanted in (at, at.rpartition(":")[0]):
            yield finding


def _lines(finding: Finding, report: Report) -> Iterator[str]:
    yield from finding_lines(replace(finding, fixes=()), report.documents, os.getcwd(), colour=colours(), host=links())
    yield ""
    yield f"Severity: {finding.severity}. What it does: {EFFECTS[finding.effect]}."
    yield f"Confidence: {finding.confidence}. {_CONFIDENCE[finding.confidence]}"
    for doubt in dict.fromkeys(finding.doubts):
        about = f" ({doubt.of})" if doubt.of else ""
        yield f"Doubt: {doubt.reason.sentence}{printable(about)}; at most {limit_in_words(doubt.reason)}."
        if doubt.remedy:
            yield f"  To remove it: {printable(doubt.remedy)}."
    if finding.condition:
        yield f"Only with: {printable(finding.condition)}"
    if finding.roots:
        yield f"In the launch of: {', '.join(printable(os.path.relpath(root)) for root in finding.roots)}"
    for fix in finding.fixes:
        yield f"Fix: {printable(fix.title)}"
        yield from _edits(fix, report)
    comment = "# {}" if has_hash_comments(finding.location.file, "") else "<!-- {} -->"
    suppressed = comment.format(f"preflight: ignore[{finding.rule}] the reason")
    yield f"Suppress it with a comment on its line or the line above: {suppressed}"


def _edits(fix: Fix, report: Report) -> Sequence[str]:
    """The lines that a fix changes, as a diff has them."""
    lines: list[str] = []
    for edit in fix.edits:
        document = report.documents.get(edit.location.file)
        if document is None:
            continue
        span = edit.location.span
        first, _ = document.lines.position(span.start)
        last, _ = document.lines.position(span.end)
        begin, end = document.lines.line_span(first)[0], document.lines.line_span(last)[1]
        before = document.text[begin:end]
        after = document.text[begin : span.start] + edit.text + document.text[span.end : end]
        lines += [f"  - {printable(line)}" for line in before.splitlines()]
        lines += [f"  + {printable(line)}" for line in after.splitlines()]
    return lines
