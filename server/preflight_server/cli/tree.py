"""`ros-preflight tree`: what a launch file would start."""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterator
from pathlib import Path

from preflight_analysis.environment.detect import workspace_of
from preflight_analysis.evaluation.json_values import json_value
from preflight_analysis.evaluation.tree import LaunchTree, Param
from preflight_analysis.findings.finding import Finding
from preflight_analysis.findings.printable import printable
from preflight_analysis.findings.report import place
from preflight_analysis.queries.node_tree import node_tree
from preflight_analysis.view.tree_page import tree_page
from preflight_analysis.workspace.tree_json import tree_json
from preflight_analysis.workspace.workspace import Analysis

from preflight_server.cli import options
from preflight_server.cli.batch import answer_all
from preflight_server.cli.errors import CannotDoError
from preflight_server.cli.output import colours, print_json, print_text
from preflight_server.cli.paths import with_paths
from preflight_server.cli.project import exit_code, open_project, say_errors

DESCRIPTION = """List the nodes of a launch with their names, parameters, remaps and environment, and the line that each
comes from. No node is run. Parameter commands run in a sandbox, unless with --no-run or --batch. With --batch the
command evaluates many launch files in one process and prints one line of JSON for each."""
_SHOWN = 500
"""Characters of a value in text; a robot description has thousands of lines."""
_COLOURS = (34, 33, 32, 35, 31, 36, 94, 93)
"""Of the launch files in text, in order of first appearance; the next one begins anew."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's own options."""
    options.add_common(parser, ("text", "json", "html"))
    options.add_file(parser, optional=True)
    parser.add_argument(
        "--batch",
        metavar="JOBS.jsonl",
        type=Path,
        help="evaluate the jobs of this file, one a line; exit with 0 if all were evaluated",
    )


def run(args: argparse.Namespace) -> int:
    """Print the tree, or those of all jobs."""
    if args.batch is not None:
        if args.file is not None or args.launch_args:
            raise CannotDoError("--batch takes its launch files from the jobs, not from the command line")
        return answer_all(args.batch, args)
    if args.file is None:
        raise CannotDoError("name a launch file, or jobs with --batch")
    analysis = open_project(args).analysis
    if args.format == "json":
        data = tree_json(analysis.tree, analysis.documents, analysis.findings)
        print_json(with_paths(data, args, [workspace_of(analysis.root)]))
    elif args.format == "html":
        print_text(tree_page(node_tree(analysis, _by_file(analysis)), analysis.documents, os.getcwd()))
        say_errors(analysis)
    else:
        print_text("".join(f"{line}\n" for line in _painted(analysis, colour=colours())), painted=colours())
        say_errors(analysis)
    return exit_code(analysis, args.fail_on)


def _by_file(analysis: Analysis) -> dict[str, list[Finding]]:
    found: dict[str, list[Finding]] = {}
    for finding in analysis.findings:
        found.setdefault(finding.location.file, []).append(finding)
    return found


def _painted(analysis: Analysis, *, colour: bool) -> Iterator[str]:
    """The lines, those of a node in the colour of the launch file that it comes from."""
    files = {file: i for i, file in enumerate(analysis.tree.files)}
    for line, file in _lines(analysis):
        text = printable(line)
        index = files.get(file) if file is not None else None
        yield f"\x1b[{_COLOURS[index % len(_COLOURS)]}m{text}\x1b[0m" if colour and index is not None else text


def _lines(analysis: Analysis) -> Iterator[tuple[str, str | None]]:
    """Each line, with the launch file that it comes from if it has its colour."""
    tree = analysis.tree
    yield tree.file, tree.file
    for name, arg in tree.args.items():
        yield f"  arg {name} = {'(required, not given)' if arg.value is None else arg.value}", None
    for node in tree.nodes:
        yield f"  {node.kind} {node.name}  {node.package}/{node.executable}", node.location.file
        if node.args:
            yield f"    args {node.args}", None
        for remap in node.remaps:
            yield f"    remap {remap.source} -> {remap.target}", None
        for name, value in node.env:
            yield f"    env {name}={value}", None
        for name in _private(tree, node.name):
            yield f"    param {name.removeprefix(node.name + '/')} = {_value(tree.params[name])}", None
        steps = " < ".join(place(step, analysis.documents, os.getcwd()) for step in reversed(node.origin))
        yield f"    from {steps}", node.location.file
    owned = {name for node in tree.nodes for name in _private(tree, node.name)}
    for name, param in tree.params.items():
        if name not in owned:
            yield f"  param {name} = {_value(param)}", None
    for unknown in tree.unknowns:
        yield f"  not known: {unknown.what} ({unknown.reason})", None


def _value(param: Param) -> str:
    text = repr(json_value(param.value))
    return text if len(text) <= _SHOWN else f"{text[:_SHOWN]}… ({len(text)} characters)"


def _private(tree: LaunchTree, node: str) -> list[str]:
    return [name for name in tree.params if name.startswith(node + "/")]
