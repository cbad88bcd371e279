"""`ros-preflight watch`: the running system beside what the launch file should have started."""

from __future__ import annotations

import argparse
import os
import sys
import time
from collections.abc import Mapping
from dataclasses import field
from typing import Any

from preflight_analysis.dataclass import dataclass
from preflight_analysis.environment.detect import workspace_of
from preflight_analysis.live.expected import expected_of
from preflight_analysis.live.model import Expected, Issue
from preflight_analysis.live.report import event_json, line, summary
from preflight_analysis.live.watcher import LOOK_SECONDS, Attached, Event, Observer, State, Waiting, Watcher, observer

from preflight_server.cli import options
from preflight_server.cli.errors import CLEAN, FAILED, FOUND, CannotDoError
from preflight_server.cli.output import print_json, print_text, say
from preflight_server.cli.paths import with_paths
from preflight_server.cli.project import open_project, run_nodes, say_errors

DESCRIPTION = """Compare the running ROS 1 master (ROS_MASTER_URI) or ROS 2 domain (ROS_DOMAIN_ID) with a launch file.
Report nodes, topics, services and actions that are missing, extra or of another type, until interrupted; with --once
until the system is as expected. The expected graph is that of `graph`: the command runs the nodes in a sandbox;
--no-run executes nothing. Exit codes: 0 as expected, 1 different, 2 no system found."""
_POLL_SECONDS = 0.5


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's own options."""
    options.add_running(parser, ("text", "json"))
    options.add_file(parser)
    parser.add_argument(
        "--once",
        action="store_true",
        help="wait until the system is as expected, or for --timeout; then report the differences and exit: 0 none, "
        "1 differences, 2 no system found",
    )
    parser.add_argument(
        "--timeout",
        type=float,
        default=30.0,
        metavar="S",
        help="wait this many seconds with --once (default: %(default)s)",
    )
    parser.add_argument(
        "--settle",
        type=float,
        default=2.0,
        metavar="S",
        help="without --once: report a difference after this many seconds (default: %(default)s)",
    )
    parser.add_argument("--allow-extra", action="store_true", help="ignore nodes that the launch file does not start")


def run(args: argparse.Namespace) -> int:
    """Watch until interrupted, or once."""
    project = open_project(args)
    analysis = run_nodes(project, args)
    if analysis.graph is None:
        raise CannotDoError("the launch file has no graph")
    say_errors(analysis)
    expected = expected_of(analysis.graph, analysis.documents)
    watched = observer(analysis.tree.generation, analysis.environment)
    try:
        return (_once if args.once else _follow)(watched, expected, args)
    finally:
        watched.close()


def _json(event: Event, args: argparse.Namespace) -> Mapping[str, Any]:
    return with_paths(event_json(event), args, [workspace_of(options.launch_file(args))])


def _once(watched: Observer, expected: Expected, args: argparse.Namespace) -> int:
    watcher = Watcher(watched, lambda: expected, allow_extra=args.allow_extra)
    give_up = time.monotonic() + args.timeout
    last: Event | None = None
    while True:
        last = next(reversed(watcher.look(max(give_up - time.monotonic(), LOOK_SECONDS))), last)
        if isinstance(last, State) and last.comparison.same:
            break
        if time.monotonic() >= give_up or (isinstance(last, Waiting) and last.final):
            break
        time.sleep(_POLL_SECONDS)
    assert last is not None
    if args.format == "json":
        print_json(_json(last, args), indent=None)
    if not isinstance(last, State):
        raise CannotDoError(last.reason if isinstance(last, Waiting) else f"{watched.place} does not answer")
    found = last.comparison
    if args.format == "text":
        print_text("".join(f"{line(issue, os.getcwd())}\n" for issue in found.issues) + f"{summary(found)}\n")
    return CLEAN if found.same else FOUND


def _follow(watched: Observer, expected: Expected, args: argparse.Namespace) -> int:
    """Until it is interrupted, which is its usual end; the exit code is that of the last state."""
    watcher = Watcher(watched, lambda: expected, settle=args.settle, allow_extra=args.allow_extra)
    text = _Text()
    code = FAILED
    try:
        while True:
            for event in watcher.look():
                # Before it is told: whoever reads it may interrupt at once.
                if isinstance(event, Waiting):
                    code = FAILED
                elif isinstance(event, State):
                    code = CLEAN if event.comparison.same else FOUND
                if args.format == "json":
                    print_json(_json(event, args), indent=None)
                else:
                    text.write(event)
                sys.stdout.flush()
                if isinstance(event, Waiting) and event.final:
                    say(f"ros-preflight: {event.reason}")
                    return code
            time.sleep(_POLL_SECONDS)
    except KeyboardInterrupt:
        return code


@dataclass(slots=True)
class _Text:
    """The events for people: each difference when it comes and when it goes, and how many nodes are as expected."""

    shown: dict[Issue, None] = field(default_factory=dict)
    last_summary: str | None = None

    def write(self, event: Event) -> None:
        """Print what is new."""
        stamp = time.strftime("%H:%M:%S")
        if isinstance(event, Waiting):
            print_text(f"{stamp} waiting: {event.reason}\n")
        elif isinstance(event, Attached):
            self.shown, self.last_summary = {}, None
            print_text(f"{stamp} {'attached to a new run of' if event.again else 'attached to'} {event.place}\n")
        else:
            found = event.comparison
            if self.last_summary is None and found.same and found.nodes and "present" not in found.nodes.values():
                return  # what is not there has not lasted yet: this would be no news, and not true for long
            issues = dict.fromkeys(found.issues)
            lines = [f"{stamp} - {line(issue, os.getcwd())}\n" for issue in self.shown if issue not in issues]
            lines += [f"{stamp} + {line(issue, os.getcwd())}\n" for issue in issues if issue not in self.shown]
            if summary(found) != self.last_summary or lines:
                lines.append(f"{stamp} {summary(found)}\n")
            self.shown, self.last_summary = issues, summary(found)
            print_text("".join(lines))
