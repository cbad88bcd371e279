"""`ros-preflight trace`: what the nodes of a launch file do, as seen in the sandbox."""

from __future__ import annotations

import argparse
from collections.abc import Iterator

from preflight_analysis.environment.detect import workspace_of
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.printable import printable
from preflight_analysis.tracing.interface import Interface
from preflight_analysis.tracing.trace_json import trace_json

from preflight_server.cli import options
from preflight_server.cli.errors import CannotDoError
from preflight_server.cli.output import print_json, print_text
from preflight_server.cli.paths import with_paths
from preflight_server.cli.project import exit_code, open_project, run_nodes, say_errors

DESCRIPTION = """Run the nodes of a launch file in a sandbox until they reach their event loop. Print their
publishers, subscribers, services, actions and parameters. Names are those in the code, before namespaces
and remaps."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's own options."""
    options.add_common(parser)
    options.add_file(parser)
    parser.add_argument("--node", metavar="/NAME", help="run only this node")


def run(args: argparse.Namespace) -> int:
    """Print the interfaces."""
    project = open_project(args)
    nodes = project.analysis.tree.nodes
    only = None
    if args.node is not None:
        only = "/" + args.node.lstrip("/")
        if only not in {node.name for node in nodes}:
            names = ", ".join(node.name for node in nodes) or "none"
            raise CannotDoError(f"the launch file has no node {only}; it has: {names}")
    analysis = run_nodes(project, args, only)
    interfaces = analysis.graph.processes if analysis.graph else ()
    shown = [(n, i) for n, i in zip(nodes, interfaces, strict=True) if only in (None, n.name)]
    if args.format == "json":
        print_json(with_paths(trace_json(shown), args, [workspace_of(analysis.root)]))
    else:
        print_text("".join(f"{printable(line)}\n" for node, interface in shown for line in _lines(node, interface)))
        say_errors(analysis)
    return exit_code(analysis, args.fail_on)


def _lines(node: LaunchNode, interface: Interface) -> Iterator[str]:
    outcome = interface.outcome
    how = f"{outcome.status} after {outcome.seconds:.2f} s" if interface.source == "trace" else outcome.status
    cached = ", cached" if interface.cached else ""
    yield f"{node.name}  {node.package}/{node.executable}  ({interface.source}{cached}; {how})"
    if outcome.reason:
        yield f"  {outcome.reason}"
    if outcome.status == "crashed":
        yield from (f"  | {line}" for line in outcome.stderr_tail)
    for endpoint in interface.endpoints:
        if not endpoint.builtin:
            made_up = "  (after a made-up answer)" if "made-up answer" in endpoint.evidence.doubts else ""
            made_up += "  (on demand)" if "on demand" in endpoint.evidence.doubts else ""
            made_at = _at(endpoint.source_file, endpoint.source_line)
            what = f"{endpoint.role} {endpoint.name}  {endpoint.type or 'type not known'}"
            yield f"  {what}{_of(endpoint.node)}{made_at}{made_up}"
    for use in interface.params:
        if not use.builtin:
            default = f"  default {use.default!r}" if use.has_default else ""
            yield f"  {use.access} param {use.name}{default}{_of(use.node)}{_at(use.source_file, use.source_line)}"
    if interface.looks:
        yield "  it asks which nodes, topics or services there are, and may do more where there are others"
    yield from (f"  note: {note}" for note in interface.notes)
    if node.launch_prefix and interface.source == "trace":
        yield f"  note: it was run without its launch-prefix '{node.launch_prefix}'"


def _of(node: str | None) -> str:
    """Which of several nodes of the process it is of."""
    return f"  of {node}" if node is not None else ""


def _at(file: str | None, line: int | None) -> str:
    return f"  {file}:{line}" if file else ""
