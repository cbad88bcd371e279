"""`ros-preflight graph`: who talks to whom after the launch."""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Iterator, Mapping

from preflight_analysis.findings.printable import printable
from preflight_analysis.graph.graph_json import graph_json
from preflight_analysis.graph.model import Channel, Graph
from preflight_analysis.tracing.interface import DOES
from preflight_analysis.view.dot import dot
from preflight_analysis.view.graph_page import graph_page
from preflight_analysis.view.layout import lay_out
from preflight_analysis.view.mermaid import mermaid
from preflight_analysis.view.model import GraphView, graph_view
from preflight_analysis.view.svg import standalone_svg
from preflight_analysis.workspace.workspace import Analysis

from preflight_server.cli import options
from preflight_server.cli.errors import FAILED
from preflight_server.cli.output import print_json, print_text, say
from preflight_server.cli.project import exit_code, open_project, run_nodes, say_errors

DESCRIPTION = """Print the topics, services and actions of a launch under their resolved names, with the nodes at both
ends. The command runs the nodes in a sandbox to see their interfaces; calling it is your consent. --no-run executes
nothing."""

_PICTURES: Mapping[str, Callable[[GraphView], str]] = {
    "dot": dot,
    "mermaid": mermaid,
    "svg": lambda view: standalone_svg(view, lay_out(view), os.getcwd()),
    "html": lambda view: graph_page(view, os.getcwd()),
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's own options."""
    options.add_common(parser, ("text", "json", *_PICTURES))
    options.add_file(parser)
    parser.add_argument(
        "--builtin",
        action="store_true",
        help="with dot, mermaid and svg: include the topics and services of the client library (html has a switch)",
    )


def run(args: argparse.Namespace) -> int:
    """Print the graph."""
    analysis = run_nodes(open_project(args), args)
    if analysis.graph is None:
        say("ros-preflight: the launch file has no graph")
        return FAILED
    if args.format == "json":
        print_json(graph_json(analysis.graph))
    elif args.format in _PICTURES:
        print_text(_PICTURES[args.format](_view(analysis, analysis.graph, args)))
        say_errors(analysis)
    else:
        print_text("".join(f"{printable(line)}\n" for line in _lines(analysis.graph)))
        say_errors(analysis)
    return exit_code(analysis, args.fail_on)


def _view(analysis: Analysis, graph: Graph, args: argparse.Namespace) -> GraphView:
    view = graph_view(graph, analysis.findings, analysis.context)
    return view if args.builtin or args.format == "html" else view.without_builtin()


def _lines(graph: Graph) -> Iterator[str]:
    for node, interface in zip(graph.tree.nodes, graph.interfaces, strict=True):
        reason = f": {interface.outcome.reason}" if interface.outcome.reason else ""
        yield f"node {node.name}  {interface.source}, {interface.outcome.status}{reason}"
        for each in interface.unnamed:
            yield f"  {DOES[each.role]} an unresolved name, random in each run  {each.type or 'unknown type'}"
    for kind, channels in (("topic", graph.topics), ("service", graph.services), ("action", graph.actions)):
        yield from _channels(kind, channels)


def _channels(kind: str, channels: Mapping[str, Channel]) -> Iterator[str]:
    for name, channel in channels.items():
        connections = (*channel.providers, *channel.consumers)
        if all(c.endpoint.builtin or c.action is not None for c in connections):
            continue  # an action is shown as such
        providers, consumers = (
            ", ".join(sorted({c.node.name for c in side})) or "none" for side in (channel.providers, channel.consumers)
        )
        yield f"{kind} {name}  {' | '.join(channel.types) or 'unknown type'}  {providers} -> {consumers}"
