"""What the server knows of the workspace: environment, analyses of the open roots, and their findings by file.

All state belongs to the event loop. The analysis itself runs in threads of our own (pygls' pool also reads standard
input), and what comes back is dropped if the text has changed in the meantime.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeVar

from lsprotocol import types
from preflight_analysis.environment.detect import detect, workspace_of
from preflight_analysis.findings.contexts import RootFindings, by_file, roots
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.registry import all_rules
from preflight_analysis.workspace.index import WorkspaceIndex
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Analysis, Workspace

from preflight_server.lsp.convert import Converter
from preflight_server.lsp.launch_documents import is_launch_file
from preflight_server.lsp.publisher import Publisher
from preflight_server.lsp.runs import Runs, with_known
from preflight_server.lsp.settings import Settings
from preflight_server.lsp.text_store import OpenDocument

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer

_log = logging.getLogger(__name__)
_T = TypeVar("_T")

PAUSE_AFTER_TYPING = 0.5
"""Seconds without an edit before nodes are run again: half a word is no argument to run a node with."""


@dataclass(frozen=True, slots=True)
class View:
    """An open launch file as one request sees it: its text, the analysis of the root in whose context it is shown,
    those of all roots that reach it (the shown one first), its findings, and the index of the workspace."""

    document: OpenDocument
    path: str
    analysis: Analysis
    analyses: tuple[Analysis, ...]
    index: WorkspaceIndex
    findings: tuple[Finding, ...]
    converter: Converter


@dataclass(frozen=True, slots=True)
class _Round:
    """What one more analysis led to, over all roots."""

    analyses: Mapping[str, Analysis]
    findings: Mapping[str, tuple[Finding, ...]]
    diagnostics: Mapping[str, list[types.Diagnostic]]


class Session:
    """One workspace of one client. Create, change and close it on the event loop."""

    def __init__(self, server: PreflightServer, folder: str | None, settings: Settings, *, trusted: bool) -> None:
        self._server = server
        self._folder = folder
        self.settings = settings
        self.publisher = Publisher(server)
        self._sources = Sources()
        self._pool = ThreadPoolExecutor(3, thread_name_prefix="analysis")
        self._workspace: Workspace | None = None
        self._analyses: dict[str, Analysis] = {}
        self._findings: Mapping[str, tuple[Finding, ...]] = {}
        self._index = WorkspaceIndex()
        self._focus: list[str] = []
        """Paths of open launch files, the one that was last opened or edited first."""
        self._dirty: dict[str, int] = {}
        """Roots to analyse, and the edit that made it necessary."""
        self._edits = 0
        self._remerge = False
        self._detecting: asyncio.Task[None] | None = None
        self._closed = False
        self._edited: str | None = None
        self._refreshing: asyncio.Task[None] | None = None
        self._every_root = frozenset(rule.id for rule in all_rules() if rule.every_root)
        self.runs = Runs(server, self, trusted=trusted)

    # What the handlers report

    def opened(self, document: OpenDocument) -> None:
        """A document was opened, or its text taken over anew."""
        self._take_over(document, quiet=0)

    def changed(self, document: OpenDocument) -> None:
        """Its text changed."""
        self._take_over(document, quiet=PAUSE_AFTER_TYPING)

    def _take_over(self, document: OpenDocument, quiet: float) -> None:
        if document.path is None:
            return
        self._sources.open(document.path, document.text)
        if is_launch_file(document):
            self._focus = [document.path, *(p for p in self._focus if p != document.path)]
            if self._folder is None:
                # An editor that opened a file and no folder: the workspace is the one around the file.
                self._folder, self._workspace = workspace_of(document.path), None
        else:
            self._forget(document.path)
        self._touch([document.path], document.path, quiet=quiet)

    def closed(self, document: OpenDocument) -> None:
        """The file on disk counts again."""
        if document.path is None or self._server.texts.by_path(document.path) is not None:
            return
        self._sources.close(document.path)
        self._forget(document.path)
        self._touch([document.path], None, quiet=0)

    def files_changed(self, paths: Iterable[str] | None) -> None:
        """Files changed on disk, None for any of them: launch files, parameter files or sources of nodes."""
        self.runs.forget_requests()
        if self._workspace is not None:
            self._workspace.refresh()
        self._touch(paths, None, quiet=0)

    def environment_changed(self) -> None:
        """Packages came or went, or settings that say where they are changed."""
        self._workspace = None
        self.files_changed(None)

    def configure(self, settings: Settings) -> None:
        """New settings."""
        if settings != self.settings:
            self.settings = settings
            self.environment_changed()

    def set_trusted(self, trusted: bool) -> None:
        """Whether the user trusts the workspace, so that its nodes may be run in the sandbox."""
        self.runs.set_trusted(trusted)
        self._touch(None, None, quiet=0)

    def interfaces_changed(self, root: str) -> None:
        """Runs of nodes told something new; no text changed."""
        if root in self._analyses:
            self._edits += 1
            self._dirty[root] = self._edits
            self._edited = None
            self._start()

    def close(self) -> None:
        """Leave nothing running. Returns when the threads have ended; may be called from any thread, and twice."""
        self._closed = True
        self.runs.close()
        self._pool.shutdown(wait=True, cancel_futures=True)

    # What the handlers ask

    async def view(self, uri: str) -> View | None:
        """The file as it is now, analysed; None if it is no open launch file, or could not be analysed."""
        await self.settled()
        document = self._server.texts.get(uri)
        if document is None or document.path is None or not is_launch_file(document):
            return None
        analysis = self._of(document.path)
        parsed = analysis.documents.get(document.path) if analysis else None
        if analysis is None or parsed is None or parsed.text != document.text:
            return None
        converter = Converter(self._server.texts, analysis.documents)
        analyses = (analysis, *(a for a in self.roots() if a is not analysis and document.path in a.documents))
        findings = self._findings.get(document.path, ())
        return View(document, document.path, analysis, analyses, self._index, findings, converter)

    async def settled(self) -> None:
        """Wait until what was typed so far is analysed."""
        while self._refreshing is not None and not self._refreshing.done():
            await asyncio.wait([self._refreshing])

    def roots(self) -> list[Analysis]:
        """The analyses of what is open, the file that is looked at first."""
        order = [root for path in self._focus for root, a in self._analyses.items() if path in a.tree.files]
        return [self._analyses[root] for root in dict.fromkeys([*order, *self._analyses])]

    async def in_pool(self, work: Callable[[], _T]) -> _T:
        """Run `work` in a thread."""
        if self._closed:
            raise asyncio.CancelledError
        return await asyncio.get_running_loop().run_in_executor(self._pool, work)

    async def workspace(self) -> Workspace:
        """The workspace, whose environment is detected first if need be."""
        while self._workspace is None:
            if self._detecting is None:
                self._detecting = self._server.spawn(self._detect())
            await asyncio.shield(self._detecting)
        return self._workspace

    async def _detect(self) -> None:
        folder, package_path = self._folder, self.settings.package_path
        try:
            environment = await self.in_pool(lambda: detect(folder, package_path=package_path))
        finally:
            self._detecting = None
        if (folder, package_path) == (self._folder, self.settings.package_path):
            self._workspace = Workspace(environment, self._sources)
            self.runs.set_environment(environment)

    def _of(self, path: str) -> Analysis | None:
        """The analysis that a file is shown in: its own, or that of the first root that includes it."""
        if path in self._analyses:
            return self._analyses[path]
        return next((a for a in self.roots() if path in a.documents), None)

    # How an edit becomes findings

    def _touch(self, paths: Iterable[str] | None, edited: str | None, *, quiet: float) -> None:
        """Analyse again what depends on `paths` (None: all of it); runs of nodes wait `quiet` seconds more."""
        self._edits += 1
        self._edited = edited
        touched = None if paths is None else set(paths)
        for root, analysis in self._analyses.items():
            if touched is None or root in touched or not touched.isdisjoint(analysis.tree.inputs):
                self._dirty[root] = self._edits
        for path in self._focus:
            if path in self._dirty or self._of(path) is None:
                self._dirty[path] = self._edits
        self._remerge = True
        self.runs.hold(quiet)
        self._start()

    def _forget(self, path: str) -> None:
        self._focus = [p for p in self._focus if p != path]
        self._analyses.pop(path, None)
        self._dirty.pop(path, None)

    def _start(self) -> None:
        if self._refreshing is None or self._refreshing.done():
            self._refreshing = self._server.spawn(self._refresh())

    async def _refresh(self) -> None:
        """Analyse what is dirty, the file that is looked at first, until nothing is."""
        while self._dirty or self._remerge:
            workspace = await self.workspace()
            root = next((p for p in (*self._focus, *self._dirty) if p in self._dirty), None)
            asked = self._dirty.get(root) if root else None
            self._remerge = False
            round_ = await self._round(workspace, root)
            if self._workspace is not workspace or (root is not None and self._dirty.get(root) != asked):
                continue  # superseded by a newer text
            if root is not None:
                del self._dirty[root]
            if round_ is not None:
                self._commit(round_)
        self.runs.wake()

    async def _round(self, workspace: Workspace, root: str | None) -> _Round | None:
        analyses = dict(self._analyses)
        known, why = (self.runs.known(root), self.runs.why_not_run) if root is not None else ({}, None)

        def work() -> _Round:
            if root is not None:
                analyses[root] = with_known(workspace, workspace.static(root), known, why)
            return self._merge(analyses)

        try:
            return await self.in_pool(work)
        except Exception:
            _log.exception("the analysis of %s broke; its findings are left as they are", root)
            return None

    def _merge(self, analyses: Mapping[str, Analysis]) -> _Round:
        """The findings of all roots by file. Runs in a thread: files that are not open are read for their lines."""
        kept = {root: analyses[root] for root in roots({r: a.tree.files for r, a in analyses.items()})}
        findings = by_file(
            (RootFindings(r, frozenset((*a.tree.files, *a.tree.inputs)), a.findings) for r, a in kept.items()),
            self._every_root,
        )
        documents = {path: document for a in kept.values() for path, document in a.documents.items()}
        converter = Converter(self._server.texts, documents, related=self._shows_related)
        return _Round(kept, findings, {path: converter.diagnostics(found) for path, found in findings.items()})

    def _commit(self, round_: _Round) -> None:
        self._analyses = {root: a for root, a in round_.analyses.items() if root in self._focus}
        self._findings = round_.findings
        for path in self._focus:
            if self._of(path) is None:
                self._dirty.setdefault(path, self._edits)  # no root includes it any more
        clean = {path: list[types.Diagnostic]() for path in self._focus if path not in self._dirty}
        self.publisher.update({**clean, **round_.diagnostics}, self._edited)

    @property
    def _shows_related(self) -> bool:
        document = self._server.client_capabilities.text_document
        publish = document.publish_diagnostics if document else None
        pull = document.diagnostic if document else None
        return bool((publish and publish.related_information) or (pull and pull.related_information))
