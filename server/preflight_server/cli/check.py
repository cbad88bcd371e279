"""`ros-preflight check`: the findings of a launch file."""

from __future__ import annotations

import argparse
import os
import sys

from preflight_analysis.findings.report import Report, to_json, to_text

from preflight_server.cli import options
from preflight_server.cli.output import print_json, print_text
from preflight_server.cli.project import open_project, run_nodes

HELP = "what is wrong with a launch file"
DESCRIPTION = """Tells what is wrong with a launch file and everything it includes. The nodes, and the commands that
parameters come from, are run in a sandbox, without network and with your files out of reach of their writes, to see
what they publish, subscribe to, read and print: calling this command is your consent. With --no-run nothing is
executed, and what only a run can tell is missing."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's own options."""
    options.add_common(parser)
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
    if args.format == "json":
        print_json(to_json(report))
    else:
        print_text(to_text(report, base=os.getcwd(), colour=sys.stdout.isatty() and "NO_COLOR" not in os.environ))
    return int(options.fails(analysis.findings, args.fail_on))
