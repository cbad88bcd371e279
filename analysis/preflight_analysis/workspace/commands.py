"""The results of commands that the trees of a workspace are made with."""

from __future__ import annotations

import threading
from collections.abc import Callable, Hashable, Mapping, Sequence
from typing import TYPE_CHECKING

from preflight_analysis.evaluation.commands import CommandResult, Commands, KnownResults, Reader
from preflight_analysis.evaluation.ros2.python_runs import MARK, answered_questions
from preflight_analysis.evaluation.tree import LaunchTree

if TYPE_CHECKING:
    from preflight_analysis.tracing.commands import CommandRunner

MOST_TOGETHER = 24
"""Calls of a Python launch file that one run answers: it has the time of one."""
MAX_LAUNCH_FILES = 1_000
"""How many runs of Python launch files are remembered, the latest."""


class CommandResults:
    """Implements `evaluation.commands.Commands`. Thread-safe.

    `why_not_run` tells why commands are not run; None where they are, and those without a result have yet to be.
    """

    reader: Reader | None = None

    def __init__(self, why_not_run: Callable[[], str | None], placeholder: str | None = None) -> None:
        self.placeholder = placeholder
        self._why_not_run = why_not_run
        self._results: Mapping[str, CommandResult] = {}
        self._answering: Mapping[str, tuple[str, ...]] = {}
        self._updates = 0

    @property
    def edition(self) -> Hashable:
        """Another one where any of the results may be another one."""
        return self._updates, self._why_not_run()

    def result(self, line: str) -> CommandResult | None:
        """The result of a command line, or why it has none."""
        return self._results.get(line) or self._otherwise

    def answering(self, question: str) -> tuple[str, ...]:
        """The lines of the runs of Python launch files that answer a question, the latest last."""
        return self._answering.get(question, ())

    def snapshot(self) -> Commands:
        """The results as they are now."""
        return KnownResults(self.placeholder, self._results, self._answering, self._otherwise)

    @property
    def _otherwise(self) -> CommandResult | None:
        why = self._why_not_run()
        return CommandResult("not-run", reason=why) if why is not None else None

    def update(self, results: Mapping[str, CommandResult]) -> None:
        """Take over results."""
        merged = {**self._results, **results}
        runs = [line for line in merged if line.startswith(MARK)]
        for line in runs[:-MAX_LAUNCH_FILES]:  # each text that was typed is another
            del merged[line]
        self._results = merged
        self._updates += 1
        questions = {line: answered_questions(line, found) for line, found in results.items() if line in merged}
        answering = {
            question: [line for line in lines if line in merged and question in questions.get(line, (question,))]
            for question, lines in self._answering.items()
        }
        for line, answered in questions.items():
            for question in answered:
                if line not in answering.setdefault(question, []):
                    answering[question].append(line)
        self._answering = {question: tuple(lines) for question, lines in answering.items() if lines}

    def clear(self) -> None:
        """Forget all results."""
        self._results, self._answering = {}, {}
        self._updates += 1


def command_lines(tree: LaunchTree) -> tuple[str, ...]:
    """Its command lines, each once."""
    return tuple(dict.fromkeys(command.line for command in tree.commands))


def run_commands(runner: CommandRunner, lines: Sequence[str], cancel: threading.Event) -> dict[str, CommandResult]:
    """The results of command lines, from the cache or a run, as many at a time as there are processors; of those that
    were cancelled none."""
    # Who has no command to run starts faster without.
    from preflight_analysis.tracing.commands import alike  # noqa: PLC0415
    from preflight_analysis.tracing.schedule import processors, run_all  # noqa: PLC0415

    results: dict[str, CommandResult] = {}
    groups = alike(lines, MOST_TOGETHER)

    def done(index: int, found: Sequence[CommandResult]) -> None:
        for line, result in zip(groups[index], found, strict=True):
            if result.status != "not-run" or not cancel.is_set():
                results[line] = result

    workers = max(2, processors())
    run_all(lambda group: runner.run_together(group, cancel), groups, workers=workers, on_done=done)
    return results
