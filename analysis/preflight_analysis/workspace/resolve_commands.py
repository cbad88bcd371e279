"""A launch file with the results of all that has to be run before it is known: commands, Python launch files.

What runs tell asks for further runs: an include for that of its file, an opaque function for that with its context.
"""

from __future__ import annotations

import threading
from collections.abc import Mapping

from preflight_analysis.tracing.commands import CommandRunner
from preflight_analysis.workspace.commands import CommandResults, command_lines, run_commands
from preflight_analysis.workspace.workspace import Analysis, Workspace

MAX_ROUNDS = 100
"""Of runs, one after another."""


def resolve_commands(
    workspace: Workspace,
    path: str,
    args: Mapping[str, str],
    results: CommandResults,
    runner: CommandRunner,
    cancel: threading.Event,
    *,
    only_launch_files: bool = False,
) -> Analysis:
    """The analysis once nothing is left to run. `results` are those that the workspace's trees are made with."""
    analysis = workspace.static(path, args)
    tried: set[str] = set()
    for _ in range(MAX_ROUNDS):
        wanted = {c.line for c in analysis.tree.commands if c.launch_file or not only_launch_files}
        lines = [line for line in command_lines(analysis.tree) if line in wanted and line not in tried]
        if not lines or cancel.is_set():
            break
        tried.update(lines)
        results.update(run_commands(runner, lines, cancel))
        analysis = workspace.static(path, args)
    return analysis
