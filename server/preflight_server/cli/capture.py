"""`ros-preflight capture`: what the nodes of a running system do, written down"""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterable, Sequence
from pathlib import Path

from preflight_analysis.documents.document import Document
from preflight_analysis.edits.edit import Edit, applied
from preflight_analysis.edits.gate import passes
from preflight_analysis.environment.writing import write_file
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.printable import printable
from preflight_analysis.findings.report import place
from preflight_analysis.graph.annotations import annotation_edits, annotation_text
from preflight_analysis.graph.model import Graph
from preflight_analysis.live.capture import Captured, capture, settings_text
from preflight_analysis.live.model import CannotObserveError, Observation
from preflight_analysis.live.settled import settled
from preflight_analysis.live.watcher import Observer, observer
from preflight_analysis.tracing.interface import Interface
from preflight_analysis.workspace.workspace import Analysis

from preflight_server.cli import options
from preflight_server.cli.errors import CLEAN, FOUND, CannotDoError
from preflight_server.cli.output import print_text, say
from preflight_server.cli.project import open_project, run_nodes

DESCRIPTION = """Print the interfaces of running nodes as annotations for the launch file, or as settings. The nodes
run in the ROS 1 master (ROS_MASTER_URI) or ROS 2 domain (ROS_DOMAIN_ID). Without --node, capture the nodes that cannot
run in the sandbox. --no-run executes nothing. Exit codes: 0 captured, 1 a node is not captured, 2 no system found."""
_NO_NODES = ("test", "process")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's own options."""
    options.add_running(parser, ("annotations", "settings"))
    options.add_file(parser)
    parser.add_argument(
        "--node", metavar="/NAME", action="append", default=[], help="capture this node; may be repeated"
    )
    parser.add_argument("--all", action="store_true", help="capture all nodes of the launch file")
    parser.add_argument("--write", action="store_true", help="write the annotations into the launch files")
    parser.add_argument(
        "--timeout",
        type=float,
        default=10.0,
        metavar="S",
        help="wait this many seconds for the nodes (default: %(default)s)",
    )
    parser.add_argument(
        "--settle",
        type=float,
        default=2.0,
        metavar="S",
        help="accept a state after this many seconds without a change (default: %(default)s)",
    )


def run(args: argparse.Namespace) -> int:
    """Print or write what was seen."""
    if args.write and args.format == "settings":
        raise CannotDoError("--write writes annotations only; copy the printed settings into .ros-preflight.yaml")
    analysis = run_nodes(open_project(args), args)
    if analysis.graph is None:
        raise CannotDoError("the launch file has no graph")
    chosen = _chosen(analysis.tree.nodes, analysis.graph.processes, args)
    if not chosen:
        say("nothing to capture: all nodes run in the sandbox or are annotated (--all captures them)")
        return CLEAN
    watched = observer(analysis.tree.generation, analysis.environment)
    try:
        captured = _captured(watched, analysis.graph, chosen, args)
    finally:
        watched.close()
    for each in captured:
        if each.interface is None:
            say(printable(f"{each.node.name} is not captured: {each.reason}"))
    if args.format == "settings":
        print_text(settings_text(captured, analysis.tree.nodes))
    elif args.write:
        _write(analysis, captured)
    else:
        print_text("".join(_lines(analysis, captured)))
    return FOUND if any(each.interface is None for each in captured) else CLEAN


def _chosen(
    started: Sequence[LaunchNode], interfaces: Sequence[Interface], args: argparse.Namespace
) -> list[LaunchNode]:
    nodes = [node for node in started if node.kind not in _NO_NODES]
    named = {"/" + name.lstrip("/") for name in args.node}
    if missing := named - {node.name for node in nodes}:
        there = ", ".join(node.name for node in nodes) or "none"
        raise CannotDoError(f"the launch file has no node {', '.join(sorted(missing))}; it has: {there}")
    if named or args.all:
        return [node for node in nodes if args.all or node.name in named]
    known = {id(node) for node, interface in zip(started, interfaces, strict=True) if interface.complete}
    return [node for node in nodes if id(node) not in known]


def _captured(
    watched: Observer, graph: Graph, chosen: Sequence[LaunchNode], args: argparse.Namespace
) -> list[Captured]:
    """What the chosen ones do, once all of them are there and nothing changes any more, or the time is over."""

    def captured(seen: Observation) -> list[Captured]:
        return capture(graph, chosen, seen)

    def complete(seen: Observation) -> bool:
        found = captured(seen)
        return bool(found) and all(each.interface is not None for each in found)

    try:
        return captured(settled(watched, timeout=args.timeout, settle=args.settle, enough=complete))
    except CannotObserveError as error:
        raise CannotDoError(str(error)) from None


def _lines(analysis: Analysis, captured: Iterable[Captured]) -> Iterable[str]:
    for each in captured:
        if each.interface is not None:
            where = place(each.node.location, analysis.documents, os.getcwd())
            text = annotation_text(each.interface) or "nothing beside what every node has"
            yield f"{where}: {printable(each.node.name)}\n{text}\n"


def _write(analysis: Analysis, captured: Iterable[Captured]) -> None:
    """Write the annotations; what stands on one tag several times is that of the first node."""
    found: dict[str, dict[tuple[Edit, ...], None]] = {}
    for each in captured:
        if each.interface is None:
            continue
        document = analysis.documents.get(each.node.location.file)
        text = annotation_text(each.interface)
        edits = annotation_edits(each.node, text, document) if document is not None else ()
        places = {edit.location for known in found.get(each.node.location.file, {}) for edit in known}
        if not edits:
            say(printable(f"{each.node.name} is annotated already, or has nothing to write"))
        elif places.isdisjoint(edit.location for edit in edits):
            found.setdefault(each.node.location.file, {})[edits] = None
    for file, groups in found.items():
        _apply(file, [edit for edits in groups for edit in edits], analysis.documents[file])
        say(f"{file}: {len(groups)} annotation{'' if len(groups) == 1 else 's'} written")


def _apply(file: str, edits: Sequence[Edit], document: Document) -> None:
    if not passes("capture --write", edits, {file: document.text}.get):
        raise CannotDoError(f"{file} would not be well-formed with the annotations; print them instead")
    text = applied(document.text, edits)
    try:
        if Path(file).read_bytes() != document.text.encode():
            raise CannotDoError(f"{file} is not UTF-8, or changed in the meantime; print the annotations instead")
        write_file(file, text.encode())
    except OSError as error:
        raise CannotDoError(f"{file} cannot be written: {error.strerror}") from None
