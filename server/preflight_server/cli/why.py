"""`ros-preflight why`: why one node hears another, or does not, and why a node is started, or is not."""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterator, Sequence
from typing import Any

from preflight_analysis.environment.detect import workspace_of
from preflight_analysis.evaluation.inversion import Assignment
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.findings.printable import printable
from preflight_analysis.findings.report import place
from preflight_analysis.live.model import CannotObserveError, Observation
from preflight_analysis.live.settled import settled
from preflight_analysis.live.watcher import observer
from preflight_analysis.queries.why import Chain, Link, NoSuchNodeError, State, chains, first_broken
from preflight_analysis.queries.why_live import live_links
from preflight_analysis.queries.why_started import Start, why_started
from preflight_analysis.workspace.tree_json import place_json
from preflight_analysis.workspace.workspace import Analysis

from preflight_server.cli import options
from preflight_server.cli.errors import CLEAN, FAILED, FOUND, CannotDoError
from preflight_server.cli.output import colours, print_json, print_text, say
from preflight_server.cli.paths import with_paths
from preflight_server.cli.project import Project, open_project, run_nodes

DESCRIPTION = """Explain the connection of two nodes, link by link: names with their remaps, type, QoS, environment,
lifecycle, clock. With --live, also look for each link in the running system. With one node, explain why the launch
file starts it, or which condition leaves it out. The command runs the nodes in a sandbox to see their interfaces;
calling it is your consent. --no-run executes nothing. Exit codes: 0 no link is broken, 1 a link is broken, 2 the
command failed."""
SCHEMA = "ros-preflight/why/1"
_MOST_WORDS = 3
_LIVE_SECONDS, _SETTLE_SECONDS = 10.0, 2.0
"""At most for the running system to answer, and how long it may not change: discovery takes a moment."""
_MARKS: dict[State, tuple[str, int]] = {"ok": ("ok", 32), "broken": ("BROKEN", 31), "unknown": ("?", 33)}
"""By state its word in text, and its colour on a terminal."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's own options."""
    options.add_running(parser, ("text", "json"))
    parser.add_argument(
        "--live",
        action="store_true",
        help="also look for each link in the running ROS 1 master (ROS_MASTER_URI) or ROS 2 domain (ROS_DOMAIN_ID)",
    )
    parser.add_argument("file", metavar="FILE", help="a launch file")
    parser.add_argument(
        "launch_args",
        metavar="NODE|CHANNEL|name:=value",
        nargs="+",
        help="one or two nodes, after two a topic, service or action; arguments of the launch file",
    )


def run(args: argparse.Namespace) -> int:
    """Print the answer."""
    words = [word for word in args.launch_args if not options.is_assignment(word)]
    args.launch_args = [word for word in args.launch_args if options.is_assignment(word)]
    if not 1 <= len(words) <= _MOST_WORDS:
        raise CannotDoError("name one node, or two nodes and, if you like, a topic, service or action")
    project = open_project(args)
    try:
        return _started(project, words[0], args) if len(words) == 1 else _connected(project, words, args)
    except NoSuchNodeError as error:
        near = f"; did you mean {' or '.join(error.near)}?" if error.near else "; `ros-preflight tree` lists the nodes"
        raise CannotDoError(f"no node '{error.name}' in this launch{near}") from None


def _started(project: Project, name: str, args: argparse.Namespace) -> int:
    analysis = project.analysis

    def evaluate(wanted: Assignment) -> LaunchTree:
        return project.workspace.evaluated(analysis.root, wanted).tree

    try:
        start = why_started(analysis, name, evaluate)
    except NoSuchNodeError:
        # Controllers and other nodes that a node of the launch makes are known with the interfaces only.
        analysis = run_nodes(project, argparse.Namespace(**{**vars(args), "no_run": True}))
        start = why_started(analysis, name, evaluate)
    if args.format == "json":
        data = {"schema": SCHEMA, "start": _start_json(start, analysis)}
        print_json(with_paths(data, args, [workspace_of(analysis.root)]))
    else:
        _print([start.verdict, *_lines(start.links, analysis)])
    return FOUND if start.broken else CLEAN


def _connected(project: Project, words: Sequence[str], args: argparse.Namespace) -> int:
    analysis = run_nodes(project, args)
    if analysis.graph is None:
        say("ros-preflight: the launch file has no graph")
        return FAILED
    found = chains(analysis, analysis.graph, *words)
    seen = _observed(analysis) if args.live else None
    live = [live_links(chain, seen) if seen is not None else None for chain in found]
    if args.format == "json":
        both = zip(found, live, strict=True)
        data = {"schema": SCHEMA, "chains": [_chain_json(chain, links, analysis) for chain, links in both]}
        print_json(with_paths(data, args, [workspace_of(analysis.root)]))
    else:
        blocks = [
            [chain.verdict, *_lines(chain.links, analysis), *_live_lines(links, analysis)]
            for chain, links in zip(found, live, strict=True)
        ]
        _print([line for block in blocks for line in (*block, "")][:-1])
    broken = any(chain.broken for chain in found) or any(first_broken(links) for links in live if links is not None)
    return FOUND if broken else CLEAN


def _observed(analysis: Analysis) -> Observation:
    watched = observer(analysis.tree.generation, analysis.environment)
    try:
        return settled(watched, timeout=_LIVE_SECONDS, settle=_SETTLE_SECONDS)
    except CannotObserveError as error:
        raise CannotDoError(str(error)) from None
    finally:
        watched.close()


def _live_lines(links: Sequence[Link] | None, analysis: Analysis) -> Iterator[str]:
    if links is None:
        return
    broken = first_broken(links)
    yield f"running system: {'no broken link' if broken is None else broken.text}"
    yield from _lines(links, analysis)


def _lines(links: Sequence[Link], analysis: Analysis) -> Iterator[str]:
    for link in links:
        word, colour = _MARKS[link.state]
        mark = f"{word:<6}"
        where = f" [{place(link.location, analysis.all_documents, os.getcwd())}]" if link.location is not None else ""
        painted = f"\x1b[{colour}m{mark}\x1b[0m" if colours() else mark
        yield f"  {painted}  {printable(link.text)}{printable(where)}"
        yield from (f"          fix: {printable(fix.title)}" for fix in link.fixes)


def _print(lines: Sequence[str]) -> None:
    print_text("".join(f"{line}\n" for line in lines), painted=colours())


def _chain_json(chain: Chain, live: Sequence[Link] | None, analysis: Analysis) -> dict[str, Any]:
    return {
        **({"live": [_link_json(link, analysis) for link in live]} if live is not None else {}),
        "kind": chain.noun,
        "channel": chain.channel,
        "provider": chain.provider,
        "consumer": chain.consumer,
        "connected": None if chain.broken is None and chain.unknown else chain.broken is None,
        "links": [_link_json(link, analysis) for link in chain.links],
    }


def _start_json(start: Start, analysis: Analysis) -> dict[str, Any]:
    return {
        "node": start.node,
        "started": start.broken is None,
        "arguments": dict(start.wanted),
        "links": [_link_json(link, analysis) for link in start.links],
    }


def _link_json(link: Link, analysis: Analysis) -> dict[str, Any]:
    where = place_json(link.location, analysis.all_documents) if link.location is not None else {}
    fixes = [fix.title for fix in link.fixes]
    return {"about": link.about, "state": link.state, "text": link.text, **where, **({"fixes": fixes} if fixes else {})}
