"""`ros-preflight snapshot`: the known good graph, in a file."""

from __future__ import annotations

import argparse
from pathlib import Path

from preflight_analysis.environment.writing import write_file
from preflight_analysis.interfaces.nodl_write import nodl_files
from preflight_analysis.snapshot.files import to_json, to_yaml
from preflight_analysis.workspace.workspace import Analysis

from preflight_server.cli import options
from preflight_server.cli.errors import CannotDoError
from preflight_server.cli.operand import from_launch
from preflight_server.cli.output import dumps_json, print_text, say
from preflight_server.cli.project import exit_code, say_errors

DESCRIPTION = """Write the nodes and the graph of a launch to a file for reviews. The file is the same on each
machine, and `diff` compares with it. The command runs the nodes in a sandbox to see their interfaces; calling it
is your consent. --no-run executes nothing."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's own options."""
    options.add_common(parser, formats=("yaml", "json", "nodl"))
    options.add_file(parser)
    parser.add_argument(
        "--output",
        "-o",
        metavar="PATH",
        type=Path,
        help="write to this file instead of standard output; with --format nodl to this folder, one document for each "
        "executable",
    )


def run(args: argparse.Namespace) -> int:
    """Write the snapshot."""
    if args.format == "nodl" and args.output is None:
        raise CannotDoError("--format nodl writes several files: name their folder with --output")
    path = options.launch_file(args)
    analysis, snapshot = from_launch(path, options.launch_args(args.launch_args, path), args)
    if args.format == "nodl":
        _write_nodl(analysis, args.output)
        say_errors(analysis)
        return exit_code(analysis, args.fail_on)
    text = dumps_json(to_json(snapshot)) if args.format == "json" else to_yaml(snapshot)
    if args.output is None:
        print_text(text)
    else:
        _write(args.output, text)
    unsure = [name for name, node in snapshot.nodes.items() if not node.sure]
    if unsure:
        say(f"incomplete: {', '.join(unsure)}; `ros-preflight check` reports the reasons")
    say_errors(analysis)
    return exit_code(analysis, args.fail_on)


def _write_nodl(analysis: Analysis, folder: Path) -> None:
    if analysis.graph is not None:
        for name, text in nodl_files(analysis.graph).items():
            _write(folder / name, text)
            say(f"{folder / name}")


def _write(path: Path, text: str) -> None:
    try:
        write_file(path, text.encode("utf-8", "backslashreplace"))
    except OSError as error:
        raise CannotDoError(f"{path} cannot be written: {error.strerror}") from None
