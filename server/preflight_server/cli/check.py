"""`ros-preflight check`: the findings of launch files, or of a whole workspace."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

from preflight_analysis.documents.document import Document
from preflight_analysis.environment.detect import SETTINGS_FILE
from preflight_analysis.evaluation.tree_json import dumps
from preflight_analysis.findings.baseline import read_baseline, to_baseline, without_known
from preflight_analysis.findings.contexts import RootFindings, by_file
from preflight_analysis.findings.finding import Finding
from preflight_analysis.findings.github import to_github
from preflight_analysis.findings.junit import to_junit
from preflight_analysis.findings.report import Report, printable, relative, to_json, to_text
from preflight_analysis.findings.sarif import to_sarif
from preflight_analysis.rules.registry import all_rules
from preflight_analysis.workspace.workspace import Analysis

from preflight_server.cli import options
from preflight_server.cli.changes import changed_since, touched
from preflight_server.cli.errors import CLEAN, CannotDoError
from preflight_server.cli.launches import Launches, launches
from preflight_server.cli.output import print_json, print_text, say
from preflight_server.cli.progress import Progress
from preflight_server.cli.project import run_nodes

FORMATS = ("text", "json", "sarif", "junit", "github")

HELP = "what is wrong with launch files"
DESCRIPTION = """Tells what is wrong with launch files and everything they include. Without a file it is those of
the current folder that nothing includes, and what .ros-preflight.yaml names, with each of its sets of arguments.
The nodes, and the commands that parameters come from, are run in a sandbox, without network and with your files out
of reach of their writes, to see what they publish, subscribe to, read and print: calling this command is your
consent. With --no-run nothing is executed, and what only a run can tell is missing."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's own options."""
    options.add_common(parser, FORMATS)
    parser.add_argument(
        "launch_args",
        metavar="FILE",
        nargs="*",
        help="launch files, with name:=value for their arguments, or folders (default: the current one)",
    )
    parser.add_argument("--baseline", metavar="FILE", help="leave out the findings that this list knows")
    parser.add_argument("--write-baseline", metavar="FILE", help="write a list of all findings, and exit with 0")
    parser.add_argument(
        "--changed-since",
        metavar="REV",
        help="only launches of which something changed since this revision: a file they are read from, the settings, "
        "a file of a package of which they start a node",
    )


def run(args: argparse.Namespace) -> int:
    """Print the findings."""
    known = _known(args.baseline) if args.baseline else frozenset()
    chosen = launches(args)
    checked: dict[str, None] = {}
    report = _check(chosen, args, checked)
    if args.write_baseline:
        return _write_baseline(report, args.write_baseline)
    if args.baseline:
        total = len(report.findings)
        report = without_known(report, known, _folder(args.baseline))
        say(f"ros-preflight: {total - len(report.findings)} of {total} findings are in {args.baseline}")
    failing = options.failing(report.findings, args.fail_on)
    _print(report, failing, list(checked), args.format)
    return int(bool(failing))


def _check(chosen: Sequence[Launches], args: argparse.Namespace, checked: dict[str, None]) -> Report:
    """The findings of all that is launched, each once; `checked` gets the launch files."""
    changed = {each.home: changed_since(args.changed_since, each.home) for each in chosen} if args.changed_since else {}
    progress = Progress(sum(len(each.roots) for each in chosen))
    reports: list[RootFindings] = []
    documents: dict[str, Document] = {}
    nodes = traced = done = 0
    try:
        for launch in chosen:
            for root in launch.roots:
                progress.step(done, printable(relative(root.label, os.getcwd())))
                done += 1
                project = launch.workspace.analysed(root.path, dict(root.args))
                if changed and not touched(project.analysis, changed[launch.home], _settings(launch.home)):
                    continue
                analysis = run_nodes(project, args, report=progress.part)
                reports.append(_root_findings(root.label, analysis))
                documents |= analysis.documents
                checked |= dict.fromkeys(analysis.tree.files)
                nodes += len(analysis.tree.nodes)
                traced += _traced(analysis)
    finally:
        progress.end()
    return Report(_merged(reports), documents, files=len(checked), nodes=nodes, traced=traced)


def _root_findings(label: str, analysis: Analysis) -> RootFindings:
    return RootFindings(label, frozenset((*analysis.tree.files, *analysis.tree.inputs)), analysis.findings)


def _traced(analysis: Analysis) -> int:
    return sum(each.source == "trace" for each in analysis.graph.interfaces) if analysis.graph else 0


def _merged(reports: Sequence[RootFindings]) -> tuple[Finding, ...]:
    """As an editor shows them: once, and what nodes do together only where it holds in each launch of the file."""
    if len(reports) == 1:
        return reports[0].findings
    found: Mapping[str, Sequence[Finding]] = by_file(reports, {rule.id for rule in all_rules() if rule.every_root})
    return tuple(finding for file in sorted(found) for finding in found[file])


def _settings(home: str) -> str:
    return os.path.join(home, SETTINGS_FILE)


def _folder(file: str) -> str:
    return os.path.dirname(os.path.abspath(file))


def _known(file: str) -> frozenset[str]:
    try:
        return read_baseline(Path(file).read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise CannotDoError(f"{file} does not exist; --write-baseline {file} makes it") from None
    except (OSError, ValueError) as error:
        raise CannotDoError(f"{file} is no list of known findings: {error}") from None


def _write_baseline(report: Report, file: str) -> int:
    try:
        Path(file).write_text(dumps(to_baseline(report, _folder(file)), indent=2) + "\n", encoding="utf-8")
    except OSError as error:
        raise CannotDoError(f"{file} cannot be written: {error}") from None
    say(f"ros-preflight: {file} has {len(report.findings)} findings")
    return CLEAN


def _print(report: Report, failing: Sequence[Finding], checked: Sequence[str], form: str) -> None:
    base = os.getcwd()
    match form:
        case "json":
            print_json(to_json(report))
        case "sarif":
            print_json(to_sarif(report, all_rules(), base))
        case "junit":
            print_text(to_junit(report, failing, checked, base))
        case "github":
            print_text(to_github(report, base))
        case _:
            # Empty counts as not set: https://no-color.org
            colour = sys.stdout.isatty() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"
            print_text(to_text(report, base=base, colour=colour))
