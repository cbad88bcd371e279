"""`ros-preflight check`: the findings of a launch file."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence

from preflight_analysis.findings.finding import Finding
from preflight_analysis.findings.github import to_github
from preflight_analysis.findings.junit import to_junit
from preflight_analysis.findings.report import Report, to_json, to_text
from preflight_analysis.findings.sarif import to_sarif
from preflight_analysis.rules.registry import all_rules

from preflight_server.cli import options
from preflight_server.cli.output import print_json, print_text
from preflight_server.cli.project import open_project, run_nodes

FORMATS = ("text", "json", "sarif", "junit", "github")

HELP = "what is wrong with a launch file"
DESCRIPTION = """Tells what is wrong with a launch file and everything it includes. The nodes, and the commands that
parameters come from, are run in a sandbox, without network and with your files out of reach of their writes, to see
what they publish, subscribe to, read and print: calling this command is your consent. With --no-run nothing is
executed, and what only a run can tell is missing."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's own options."""
    options.add_common(parser, FORMATS)
    options.add_file(parser)


def run(args: argparse.Namespace) -> int:
    """Print the findings."""
    analysis = run_nodes(open_project(args), args)
    interfaces = analysis.graph.interfaces if analysis.graph else ()
    report = Report(
        analysis.findings,
        analysis.documents,
        files=len(analysis.tree.files),
        nodes=len(analysis.tree.nodes),
        traced=sum(interface.source == "trace" for interface in interfaces),
    )
    failing = options.failing(report.findings, args.fail_on)
    _print(report, failing, analysis.tree.files, args.format)
    return int(bool(failing))


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
