"""A launch file with the results of all that has to be run before it is known: commands, Python launch files.

What runs tell asks for further runs: an include for that of its file, an opaque function for that with its context.
"""

from __future__ import annotations

import threading
from collections.abc import Mapping, Sequence
from dataclasses import field
from typing import TYPE_CHECKING

from preflight_analysis.dataclass import dataclass
from preflight_analysis.workspace.commands import CommandResults, run_commands
from preflight_analysis.workspace.index import Root
from preflight_analysis.workspace.workspace import Analysis, Workspace

if TYPE_CHECKING:
    from preflight_analysis.tracing.commands import CommandRunner

MAX_ROUNDS = 100
"""Of runs, one after another."""


@dataclass(frozen=True, slots=True)
class Resolving:
    """How what launches ask for is run: by which `runner`, until when, and whether launch files alone are. `results`
    are those that the workspace's trees are made with."""

    results: CommandResults
    runner: CommandRunner
    cancel: threading.Event = field(default_factory=threading.Event)
    only_launch_files: bool = False


def resolve_commands(workspace: Workspace, path: str, args: Mapping[str, str], by: Resolving) -> Analysis:
    """The analysis once nothing is left to run."""
    resolve_together(workspace, [Root.of(path, args)], by)
    return workspace.evaluated(path, args)


def resolve_together(
    workspace: Workspace, roots: Sequence[Root], by: Resolving, *, tried: set[str] | None = None
) -> None:
    """Run all that several roots ask for: what one has to wait for keeps no other one waiting. `tried` is what was run
    already, to which this adds."""
    tried = set() if tried is None else tried
    waiting = list(roots)
    for _ in range(MAX_ROUNDS):
        asked: dict[Root, set[str]] = {}
        wanted: dict[str, None] = {}
        for root in waiting:
            if by.cancel.is_set():
                return
            commands = workspace.evaluated(root.path, dict(root.args)).tree.commands
            lines = [c.line for c in commands if c.launch_file or not by.only_launch_files]
            asked[root] = {line for line in lines if line not in tried}
            wanted.update(dict.fromkeys(line for line in lines if line in asked[root]))
        if not wanted:
            return
        tried.update(wanted)
        by.results.update(run_commands(by.runner, list(wanted), by.cancel))
        waiting = [root for root, lines in asked.items() if lines]
