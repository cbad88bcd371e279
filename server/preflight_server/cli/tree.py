"""`ros-preflight tree`: what a launch file would start."""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterator
from pathlib import Path

from preflight_analysis.evaluation.tree import LaunchTree, Param
from preflight_analysis.evaluation.tree_json import json_value, tree_json
from preflight_analysis.findings.report import place
from preflight_analysis.workspace.workspace import Analysis

from preflight_server.cli import options
from preflight_server.cli.batch import answer_all
from preflight_server.cli.errors import CannotDoError
from preflight_server.cli.output import print_json, print_text
from preflight_server.cli.project import exit_code, open_project, say_errors

HELP = "what a launch file would start"
DESCRIPTION = """Shows the nodes with their names, parameters, remaps and environment, and where each comes from.
No node is run; the commands that parameters come from are, in a sandbox, unless with --no-run or --batch. With
--batch many launch files are answered in one process, one line of JSON each."""
_SHOWN = 500
"""Characters of a value in text; a robot description has thousands of lines."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's own options."""
    options.add_common(parser)
    options.add_file(parser, optional=True)
    parser.add_argument(
        "--batch", metavar="JOBS.jsonl", type=Path, help="one job a line; the exit code is 0 if all were answered"
    )


def run(args: argparse.Namespace) -> int:
    """Print the tree, or those of all jobs."""
    if args.batch is not None:
        if args.file is not None or args.launch_args:
            raise CannotDoError("--batch takes its launch files from the jobs, not from the command line")
        return answer_all(args.batch, no_run=args.no_run)
    if args.file is None:
        raise CannotDoError("name a launch file, or jobs with --batch")
    analysis = open_project(args).analysis
    if args.format == "json":
        print_json(tree_json(analysis.tree, analysis.documents, analysis.findings))
    else:
        print_text("\n".join(_lines(analysis)) + "\n")
        say_errors(analysis)
    return exit_code(analysis, args.fail_on)


def _lines(analysis: Analysis) -> Iterator[str]:
    tree = analysis.tree
    yield tree.file
    for name, arg in tree.args.items():
        yield f"  arg {name} = {'(required, not given)' if arg.value is None else arg.value}"
    for node in tree.nodes:
        yield f"  {node.kind} {node.name}  {node.package}/{node.executable}"
        if node.args:
            yield f"    args {node.args}"
        for remap in node.remaps:
            yield f"    remap {remap.source} -> {remap.target}"
        for name, value in node.env:
            yield f"    env {name}={value}"
        for name in _private(tree, node.name):
            yield f"    param {name.removeprefix(node.name + '/')} = {_value(tree.params[name])}"
        yield f"    from {' < '.join(place(step, analysis.documents, os.getcwd()) for step in reversed(node.origin))}"
    owned = {name for node in tree.nodes for name in _private(tree, node.name)}
    for name, param in tree.params.items():
        if name not in owned:
            yield f"  param {name} = {_value(param)}"
    for unknown in tree.unknowns:
        yield f"  not known: {unknown.what} ({unknown.reason})"


def _value(param: Param) -> str:
    text = repr(json_value(param.value))
    return text if len(text) <= _SHOWN else f"{text[:_SHOWN]}… ({len(text)} characters)"


def _private(tree: LaunchTree, node: str) -> list[str]:
    return [name for name in tree.params if name.startswith(node + "/")]
