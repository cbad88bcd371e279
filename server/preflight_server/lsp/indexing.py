"""The workspace index, made in the background and kept up to date."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import os
import threading
import time
from collections.abc import Collection, Iterable
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING

from preflight_analysis.workspace.index import Root, WorkspaceIndex
from preflight_analysis.workspace.index_store import IndexStore, build_from_kept
from preflight_analysis.workspace.indexing import Earlier, Watch, build_index
from preflight_analysis.workspace.project_settings import ProjectSettings, read_project_settings
from preflight_analysis.workspace.workspace import Workspace

from preflight_server.lsp.markup import counted
from preflight_server.lsp.progress import Progress

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer
    from preflight_server.lsp.session import Session

_log = logging.getLogger(__name__)

_REPORT_EVERY = 0.1
"""Seconds between two reports of the progress."""
_AT_MOST = 2.0
"""Seconds that the index gives way to one analysis: it must come to an end while the user types without a pause."""


class Indexing:
    """Everything but the making itself happens on the event loop. `index` is a snapshot, replaced as a whole."""

    def __init__(self, server: PreflightServer, session: Session) -> None:
        self._server = server
        self._session = session
        self.index = WorkspaceIndex()
        self.made = False
        """Whether it was made once, as far as that succeeded."""
        self._project = ProjectSettings()
        self._changed: set[str] = set()
        self._everything = False
        self._task: asyncio.Task[None] | None = None
        self._cancel = threading.Event()
        self._pool = ThreadPoolExecutor(1, thread_name_prefix="index")
        self._store = IndexStore()
        self._to_keep: tuple[Workspace, WorkspaceIndex] | None = None
        """An index that was brought up to date since the store had it, and whose it is."""

    @property
    def named(self) -> tuple[Root, ...]:
        """The roots that the project's settings name."""
        return self._project.roots

    def changed(self, paths: Iterable[str] | None) -> None:
        """These files changed, in the editor or on the disk; None: look at everything anew."""
        if paths is None:
            self._everything = True
        else:
            self._changed.update(paths)
        if self._task is None or self._task.done():
            self._task = self._server.spawn(self._rounds())

    async def settled(self) -> None:
        """Wait until all that changed so far is in the index."""
        if self._task is not None and not self._task.done():
            await asyncio.shield(self._task)

    def close(self) -> None:
        """Stop, wait for the end, and keep the index for the next start."""
        self._cancel.set()
        self._pool.shutdown(wait=True, cancel_futures=True)
        if self._to_keep is not None and self._session.folder is not None:
            workspace, index = self._to_keep
            self._to_keep = None
            self._store.save(workspace, self._session.folder, index)

    async def _rounds(self) -> None:
        while (self._changed or self._everything) and not self._cancel.is_set():
            workspace = await self._session.workspace()
            if self.index.complete:
                await self._session.analyses.settled()
                await self._session.analyses.quiet()
            changed = None if self._everything or not self.index.complete else frozenset(self._changed)
            self._changed, self._everything = set(), False
            await self._session.written()
            if changed is None:
                await self._read_settings()
            if self._cancel.is_set():
                break
            index = await self._make(workspace, changed)
            if index is None and not self._cancel.is_set() and not self.made:
                self.made = True
                self._session.analyses.ask_again()
            if index is not None:
                self.index, self.made = index, True
                self._to_keep = (workspace, index) if changed is not None else None
                self._session.analyses.ask_again()

    async def _make(self, workspace: Workspace, changed: Collection[str] | None) -> WorkspaceIndex | None:
        progress = Progress(self._server, "Indexing launch files", "indexing") if changed is None else None
        loop = asyncio.get_running_loop()
        reported = 0.0

        def report(done: int, total: int, path: str) -> None:
            nonlocal reported
            if progress is not None and time.monotonic() - reported > _REPORT_EVERY:
                reported = time.monotonic()
                with contextlib.suppress(RuntimeError):  # the loop has ended
                    loop.call_soon_threadsafe(progress.report, done, total, os.path.basename(path))

        def work() -> WorkspaceIndex | None:
            folder, named = self._session.folder, self.named
            if folder is None or changed is not None:
                earlier = Earlier(self.index, changed) if changed is not None else None
                watch = Watch(report, self._gives_way_to_edits)
                return build_index(workspace, folder, named, earlier=earlier, watch=watch)
            return build_from_kept(self._store, workspace, folder, named, report=report, cancelled=self._gives_way)

        index = None
        try:
            index = await loop.run_in_executor(self._pool, work)
        except Exception as error:
            _log.exception("indexing failed; the index is unchanged")
            self._server.report_internal_error("indexing failed", error)
        finally:
            if progress is not None:
                progress.end(counted(len(index.files), "launch file") if index is not None else "")
        return index

    def _gives_way(self) -> bool:
        """Wait while something is analysed that the user looks at. Whether to stop altogether."""
        self._session.analyses.calm.wait(_AT_MOST)
        return self._cancel.is_set()

    def _gives_way_to_edits(self) -> bool:
        """As `_gives_way`, and wait until the user pauses: what an edit interrupts begins again, and takes its turns at
        the interpreter while the edit is analysed."""
        analyses, until = self._session.analyses, time.monotonic() + _AT_MOST
        while (pause := min(until - time.monotonic(), analyses.quiet_for)) > 0 and not self._cancel.wait(pause):
            pass
        return self._gives_way()

    async def _read_settings(self) -> None:
        if (folder := self._session.folder) is None:
            return
        # What is wrong with them is a finding.
        self._project = await self._session.in_pool(lambda: read_project_settings(folder))
