"""Runs of the commands of parameters: before the nodes of a root, which may read what they print."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Callable, Collection, Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import TYPE_CHECKING

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.evaluation.commands import CommandResult
from preflight_analysis.tracing.commands import CommandCache, CommandRunner, differs
from preflight_analysis.workspace.broken import Broken
from preflight_analysis.workspace.commands import CommandResults, command_lines, run_commands
from preflight_analysis.workspace.workspace import Analysis, Workspace

from preflight_server.lsp.launch_documents import is_handed_over
from preflight_server.lsp.markup import counted
from preflight_server.lsp.progress import Progress

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer
    from preflight_server.lsp.session import Session


@dataclass(frozen=True, slots=True)
class _Batch:
    lines: frozenset[str]
    progress: Progress
    cancel: threading.Event


class CommandRuns:
    """The commands of one session; `results` is what its trees are made with. Call it on the event loop.

    A result is kept while its command is run again, so that what depends on it does not come and go.
    """

    def __init__(self, server: PreflightServer, session: Session, why_not_run: Callable[[], str | None]) -> None:
        self.results = CommandResults(why_not_run)
        self._why_not_run = why_not_run
        self._server = server
        self._session = session
        self._runner: CommandRunner | None = None
        self._current: set[str] = set()
        """Command lines whose result is up to date."""
        self._edition = 0
        """How often files changed: what was found before says nothing of what is there now."""
        self._last_good: Mapping[str, str] = {}
        """The last text of each open file that was well-formed XML."""
        self._batch: _Batch | None = None

    def set_workspace(self, workspace: Workspace) -> None:
        """Where and with what environment commands are run."""
        self._runner = CommandRunner(workspace.environment, workspace.cwd, CommandCache(), workspace.sources)
        self.forget()

    def forget(self) -> None:
        """Files changed: look every result up again, but keep it until then."""
        self._current.clear()
        self._edition += 1

    def typed(self, *, stop: bool) -> None:
        """The user edits a file that commands may read, or has opened or closed one; what runs with the text before an
        edit is to `stop`."""
        self.forget()
        if stop:
            self.stop()

    def clear(self) -> None:
        """Take every result back."""
        self.forget()
        self.results.clear()

    def stop(self) -> None:
        """Kill what runs."""
        if self._batch is not None:
            self._batch.cancel.set()

    def cancel(self, token: int | str) -> bool:
        """Kill what runs if this is its progress; whether it is."""
        ours = self._batch is not None and self._batch.progress.token == token
        if ours:
            self.stop()
        return ours

    def reconsider(self, analyses: Iterable[Analysis]) -> None:
        """Kill what runs if no launch file asks for it any more."""
        asked = {line for analysis in analyses for line in command_lines(analysis.tree)}
        if self._batch is not None and asked.isdisjoint(self._batch.lines):
            self.stop()

    async def round(self, analysis: Analysis, pool: ThreadPoolExecutor, broken: Broken) -> bool:
        """Look up, then run, the commands of one root but those that are being typed. Whether the root is to be
        analysed again before its nodes."""
        whole = (command.line for command in analysis.tree.commands if not broken.touches(command.origin))
        has_all = await self._bring(whole, pool)
        changed = any(self.results.result(command.line) != command.result for command in analysis.tree.commands)
        if changed:
            self._session.analyses.ask_again()
        return changed or not has_all

    async def more(self, lines: Collection[str], pool: ThreadPoolExecutor) -> bool:
        """Look up, then run, what no root itself asks for. Whether to ask again what lines there are: there is news, or
        something ended the runs before they did."""
        before = [self.results.result(line) for line in lines]
        has_all = await self._bring(lines, pool)
        return not has_all or before != [self.results.result(line) for line in lines]

    async def _bring(self, lines: Iterable[str], pool: ThreadPoolExecutor) -> bool:
        """Look up, then run, those whose result is not up to date. Whether all are now."""
        runner, edition = self._runner, self._edition
        old = [line for line in dict.fromkeys(lines) if line not in self._current]
        if runner is not None and old:
            runner = await self._session.in_pool(partial(self._with_texts, runner, self._open()))
            found = await self._session.in_pool(lambda: {line: runner.lookup(line) for line in old})
            self._take({line: hit for line, hit in found.items() if hit is not None}, edition)
            missing = [line for line, hit in found.items() if hit is None]
            if missing and self._why_not_run() is None:  # trust may have been withdrawn meanwhile
                self._take(await self._run(runner, missing, pool), edition)
        return self._current.issuperset(old)

    def _open(self) -> dict[str, str]:
        """The texts that the editor has of files that commands may read."""
        return {each.path: each.text for each in self._server.texts if each.path and is_handed_over(each)}

    def _with_texts(self, runner: CommandRunner, texts: Mapping[str, str]) -> CommandRunner:
        """The runner for these texts. Of one that is no XML while it is being typed, the last that was counts, else the
        file, which counts in any case once it is saved so. Call it in a thread."""
        good: dict[str, str] = {}
        for path, text in texts.items():
            if not parse_xml(path, text).problems:
                good[path] = text
            elif path in self._last_good and differs(path, text):
                good[path] = self._last_good[path]
        self._last_good = good
        return runner.over(good)

    def _take(self, results: Mapping[str, CommandResult], edition: int) -> None:
        if edition == self._edition:
            self.results.update(results)
            self._current.update(results)

    async def _run(self, runner: CommandRunner, lines: list[str], pool: ThreadPoolExecutor) -> dict[str, CommandResult]:
        loop = asyncio.get_running_loop()
        progress = Progress(self._server, "Running parameter commands in the sandbox", "tracing", len(lines))
        batch = self._batch = _Batch(frozenset(lines), progress, threading.Event())
        try:
            return await loop.run_in_executor(pool, lambda: run_commands(runner, lines, batch.cancel))
        except asyncio.CancelledError:  # the loop ends; the thread would go on
            batch.cancel.set()
            raise
        finally:
            self._batch = None
            progress.end("cancelled" if batch.cancel.is_set() else counted(len(lines), "command"))
