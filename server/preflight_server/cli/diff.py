"""`ros-preflight diff`: what is not the same in two launch configurations."""

from __future__ import annotations

import argparse
import signal
from contextlib import ExitStack
from types import FrameType

from preflight_analysis.snapshot import report
from preflight_analysis.snapshot.difference import difference

from preflight_server.cli import options
from preflight_server.cli.errors import CannotDoError
from preflight_server.cli.operand import operands, snapshot_of_operand
from preflight_server.cli.output import colours, print_json, print_text

DESCRIPTION = """Compare the nodes, connections, types, QoS and parameters of two launch configurations. An OPERAND is a
launch file with its arguments, or a file that `snapshot` wrote; REV:path takes either from a git revision. The command
runs the nodes in a sandbox, those of revisions too; calling it is your consent. --no-run executes nothing. Exit codes:
0 equal, 1 different, 2 the comparison failed."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's own options."""
    options.add_running(parser, formats=("text", "json", "markdown"))
    parser.add_argument(
        "launch_args",
        metavar="OPERAND",
        nargs="+",
        help="two of: FILE [name:=value ...], SNAPSHOT, REV:FILE [name:=value ...], REV:SNAPSHOT",
    )


def run(args: argparse.Namespace) -> int:
    """Print what came, went or changed."""
    both = operands(args.launch_args)
    if len(both) != 2:
        raise CannotDoError(f"diff compares two operands, {len(both)} given: {', '.join(s.title for s in both)}")
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, _leave)
    with ExitStack() as cleanup:
        before, after = (snapshot_of_operand(operand, args, cleanup) for operand in both)
    found = difference(before, after)
    if args.format == "json":
        print_json(report.to_json(found))
    elif args.format == "markdown":
        print_text(report.to_markdown(found, both[0].title, both[1].title))
    else:
        print_text(report.to_text(found, both[0].title, both[1].title, colour=colours()), painted=colours())
    return int(not found.same)


def _leave(_number: int, _frame: FrameType | None) -> None:
    """Through what stops the runs and cleans up."""
    raise KeyboardInterrupt
