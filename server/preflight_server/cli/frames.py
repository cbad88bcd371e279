"""`ros-preflight frames`: the coordinate frames of a launch, who broadcasts them and who asks for them."""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterator

from preflight_analysis.environment.detect import workspace_of
from preflight_analysis.findings.printable import printable
from preflight_analysis.findings.report import place
from preflight_analysis.frames.forest import branches, forest
from preflight_analysis.frames.model import Frames
from preflight_analysis.model.frames import frames_of, place_of_edge, place_of_use
from preflight_analysis.queries.frames_json import frames_json
from preflight_analysis.workspace.workspace import Analysis

from preflight_server.cli import options
from preflight_server.cli.output import print_json, print_text
from preflight_server.cli.paths import with_paths
from preflight_server.cli.project import exit_code, open_project, run_nodes, say_errors

DESCRIPTION = """Print the coordinate frames of a launch as trees: links of robot descriptions, static transforms, and
transforms that nodes broadcast. Each has its source. Frames that nodes use without a publisher follow. The command runs
the nodes and xacro in a sandbox; calling it is your consent. --no-run executes nothing."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's own options."""
    options.add_common(parser, ("text", "json"))
    options.add_file(parser)


def run(args: argparse.Namespace) -> int:
    """Print the frames."""
    analysis = run_nodes(open_project(args), args)
    if args.format == "json":
        print_json(with_paths(frames_json(analysis), args, [workspace_of(analysis.root)]))
    else:
        print_text("".join(f"{printable(line)}\n" for line in _lines(analysis)))
        say_errors(analysis)
    return exit_code(analysis, args.fail_on)


def _lines(analysis: Analysis) -> Iterator[str]:
    context, documents = analysis.context, analysis.all_documents
    frames = frames_of(context)
    for space in frames.spaces:
        yield f"{space}/tf"
        for depth, branch in branches(forest(frames, space)):
            # Several parents of one frame are a mistake: each has its line.
            sources = [
                f"{edge.by}{f', {edge.doubt}' if edge.doubt else ''}"
                f"{f', parent {edge.parent}' if edge.parent != branch.edges[0].parent else ''}"
                f"  [{place(place_of_edge(context, edge), documents, os.getcwd())}]"
                for edge in branch.edges
            ]
            yield "  " * (depth + 1) + branch.frame + "".join(f"  {source}" for source in sources)
    if not frames.spaces:
        yield "no frames are known"
    yield from _unpublished(analysis, frames)
    if frames.gaps:
        yield "may be incomplete"
        yield from (f"  {gap}" for gap in frames.gaps)


def _unpublished(analysis: Analysis, frames: Frames) -> Iterator[str]:
    missing = [use for use in frames.uses if use.looked_up and use.frame not in frames.names(use.space)]
    if missing:
        yield "used, not published by a known node"
    for use in missing:
        where = place(place_of_use(analysis.context, use), analysis.all_documents, os.getcwd())
        yield f"  {use.written}  {use.node.name}, {use.what}  [{where}]"
