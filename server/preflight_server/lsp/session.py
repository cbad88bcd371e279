"""What the server knows of a workspace folder: environment, index, findings, analyses of the roots of open files.

All state belongs to the event loop. The analysis itself runs in threads of our own (pygls' pool also reads standard
input), and what comes back is dropped if the text has changed in the meantime.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
import threading
import time
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, TypeVar

from lsprotocol import types
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.environment.detect import detect, workspace_of
from preflight_analysis.findings.finding import Finding
from preflight_analysis.findings.lack import Missing
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.read import PYTHON_SUFFIX
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.similar import SimilarTraces
from preflight_analysis.workspace.branches import Branches
from preflight_analysis.workspace.index import Root, WorkspaceIndex
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Analysis, Workspace

from preflight_server.lsp.buffers import Buffers
from preflight_server.lsp.convert import Converter
from preflight_server.lsp.indexing import Indexing
from preflight_server.lsp.launch_documents import is_launch_file, is_python_launch_file, may_be_parameter_file
from preflight_server.lsp.root_choice import RootChoice
from preflight_server.lsp.rounds import Round, Snapshot, branches_of
from preflight_server.lsp.runs import Runs
from preflight_server.lsp.settings import Settings
from preflight_server.lsp.text_store import OpenDocument

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer

_log = logging.getLogger(__name__)
_T = TypeVar("_T")

PAUSE_AFTER_TYPING = 0.5
"""Seconds without an edit before anything is done but to analyse the root in whose context the file is shown: half a
word is no argument to run a node with."""


PAUSE_BEFORE_BRANCHES = 3.0
"""Seconds more before it is looked into what conditions leave out: an edit waits until that has noticed it."""


@dataclass(frozen=True, slots=True)
class View:
    """An open launch file as one request sees it: its text, the analysis of the root in whose context it is shown,
    those of all roots that reach it (the shown one first), its findings, and the index of the workspace."""

    session: Session
    document: OpenDocument
    path: str
    analysis: Analysis
    analyses: tuple[Analysis, ...]
    index: WorkspaceIndex
    findings: tuple[Finding, ...]
    converter: Converter


class Session:
    """One workspace folder of one client, or what is open without a folder. Create and change it on the event loop."""

    def __init__(
        self,
        server: PreflightServer,
        folder: str | None,
        settings: Settings,
        *,
        trusted: bool,
        variables: Mapping[str, str] | None = None,
    ) -> None:
        self._server = server
        self._variables = variables
        """The environment that the client gives the folder, None for the server's own."""
        self.folder = folder
        self.settings = settings
        self._sources = Sources()
        self._buffers = Buffers(server, self._sources)
        for document in server.texts:
            self.takes(document)
        self._pool = ThreadPoolExecutor(3, thread_name_prefix="analysis")
        self._workspace: Workspace | None = None
        self._last: Round | None = None
        """What was published last."""
        self._choice = RootChoice(server, self)
        self._quiet_at = 0.0
        """When the user will have stopped typing, by `time.monotonic`."""
        self._branching: asyncio.Task[None] | None = None
        self._detecting: asyncio.Task[None] | None = None
        self._closed = False
        self._edited: str | None = None
        """The file whose edit leads to what is published next; None where something else does."""
        self._refreshing: asyncio.Task[None] | None = None
        self._news = asyncio.Event()
        """Whether what was asked for may have another answer by now."""
        self._settled = asyncio.Event()
        self.calm = threading.Event()
        """Whether all that is shown is up to date: what runs in the background waits for that, thread or not."""
        self._settle()
        self.runs = Runs(server, self, trusted=trusted)
        self.indexing = Indexing(server, self)

    # What the handlers report

    def takes(self, document: OpenDocument) -> None:
        """The text of a document counts in place of the file, whichever folder that belongs to."""
        if document.path is not None:
            self._buffers.put(document.path, document.text)

    def leaves(self, path: str) -> None:
        """The file on disk counts again."""
        self._buffers.put(path, None)

    def text_changed(self, document: OpenDocument, *, own: bool, quiet: float) -> None:
        """A document was opened or its text changed, which `takes` was told, and the user will not type for `quiet`
        seconds. `own`: it belongs to this folder, and is shown in the context of its roots."""
        if document.path is None:
            return
        if not own:
            self._touch(document.path, None, quiet=quiet)
            return
        if is_launch_file(document) or may_be_parameter_file(document):
            self._choice.to_front(document.path)
            if self.folder is None and is_launch_file(document):
                # An editor that opened a file and no folder: the workspace is the one around the file.
                self.folder, self._workspace = workspace_of(document.path), None
                self.indexing.changed(None)
        else:
            self._choice.leave(document.path)
        self._touch(document.path, document.path, quiet=quiet)

    def closed(self, path: str) -> None:
        """A document that this folder depends on was closed."""
        self._choice.leave(path)
        self._touch(path, None, quiet=0)

    def released(self, path: str) -> None:
        """An open file belongs to another folder now."""
        if self.shows(path):
            self.closed(path)

    def shows(self, path: str) -> bool:
        """Whether a file is open and belongs to this folder."""
        return path in self._choice.open

    def depends_on(self, path: str) -> bool:
        """Whether some launch of this folder reads the file."""
        analysed = any(path in analysis.tree.inputs for analysis in self._known.values())
        return analysed or any(path in entry.inputs for entry in self.indexing.index.entries.values())

    def files_changed(self, paths: Iterable[str]) -> None:
        """Files changed on disk: launch files, parameter files or sources of nodes."""
        self.runs.forget_requests()
        self._buffers.look()
        self._start()
        self.indexing.changed(paths)

    def environment_changed(self) -> None:
        """Packages came or went, or settings that say where they are changed."""
        if self._workspace is not None:
            self._workspace.close()
        self._workspace = None
        self.runs.forget_requests()
        self._start()
        self.indexing.changed(None)

    def configure(self, settings: Settings) -> None:
        """New settings."""
        if settings != self.settings:
            self.settings = settings
            self.environment_changed()

    def set_trusted(self, trusted: bool) -> None:
        """Whether the user trusts the workspace, so that its nodes may be run in the sandbox."""
        self.runs.set_trusted(trusted)
        self._start()

    def traces_cleared(self) -> None:
        """What earlier runs told is to be forgotten."""
        self.runs.clear()
        self._start()

    async def select(self, path: str, root: Root | None) -> str | None:
        """Show a file in the context of this root; None for the one that the index puts first. Returns why not."""
        if root is None:
            self._choice.selected.pop(path, None)
        else:
            workspace = await self.workspace()
            analysis = await self.in_pool(lambda: workspace.evaluated(root.path, dict(root.args)))
            if path not in analysis.tree.inputs:
                return f"{root.label} does not include {path}"
            self._choice.selected[path] = root
        self.index_changed()
        return None

    def results_changed(self) -> None:
        """Runs told something new; no text changed."""
        self._start()

    def index_changed(self) -> None:
        """Other roots may reach the open files now."""
        self._start()

    def close(self) -> None:
        """Leave nothing running. Returns when the threads have ended; may be called from any thread, and twice."""
        self._closed = True
        self.runs.close()
        self.indexing.close()
        self._buffers.close()
        self._pool.shutdown(wait=True, cancel_futures=True)

    # What the handlers ask

    async def view(self, uri: str, *, python: bool = False) -> View | None:
        """The file as it is now, analysed; None if it is no open launch file or parameter file of one, or could not be
        analysed. Of Python files only those ask that say what no Python language server does: `python`."""
        await self.settled()
        document = self._server.texts.get(uri)
        if document is None or document.path is None or document.path not in self._choice.open:
            return None
        if is_python_launch_file(document) and not python:
            return None
        analyses = tuple(self._of(document.path))
        parsed = analyses[0].documents.get(document.path) if analyses else None
        if parsed is None or parsed.text != document.text:
            return None
        findings = self.findings.get(document.path, ())
        converter = Converter(self._server.texts, analyses[0].documents)
        index = self.indexing.index
        return View(self, document, document.path, analyses[0], analyses, index, findings, converter)

    async def latest(self, uri: str, *, python: bool = False) -> tuple[LaunchFile, Analysis] | None:
        """The file as it is now, and the newest analysis that there is, which may be one of an earlier text: for what
        cannot wait while somebody types. None if it is no open launch file or parameter file of one, or was never
        analysed. Those who ask for `python` get the text of such a file, without what can be read from it."""
        document = self._server.texts.get(uri)
        path = document.path if document is not None and document.path in self._choice.open else None
        if document is None or path is None or (is_python_launch_file(document) and not python):
            return None
        if next(self._of(path), None) is None:
            await self.settled()
        analysis = next(self._of(path), None)
        launch_file = await self.in_pool(lambda: self._newest(path))
        if analysis is None or isinstance(launch_file, Unreadable) or launch_file.document.text != document.text:
            return None
        return launch_file, analysis

    def _newest(self, path: str) -> LaunchFile | Unreadable:
        if not path.endswith(PYTHON_SUFFIX):
            return self._sources.launch_file(path)
        text = self._sources.text(path)
        return text if isinstance(text, Unreadable) else LaunchFile(path, 2, None, text, partial=True)

    async def written(self) -> None:
        """Wait until whoever reads files finds what was typed so far."""
        await self._buffers.written()

    async def settled(self) -> None:
        """Wait until what was typed so far is analysed, in the context in which it is shown."""
        await self._settled.wait()

    async def quiet(self) -> None:
        """Wait until the user has not typed for a moment."""
        while (pause := self.quiet_for) > 0:  # noqa: ASYNC110
            await asyncio.sleep(pause)

    @property
    def quiet_for(self) -> float:
        """In how many seconds the user will have paused, if no further edit comes; in any thread."""
        return self._quiet_at - time.monotonic()

    def roots(self) -> list[Analysis]:
        """The analyses of the roots that reach open files, those that files are shown in first."""
        return [self._known[root] for root in self._wanted() if root in self._known]

    def is_current(self, analysis: Analysis) -> bool:
        """Whether an analysis is of the texts as they were when something was published last."""
        return self._last is not None and analysis.launch not in self._last.outdated

    @property
    def _known(self) -> Mapping[Root, Analysis]:
        return self._last.analyses if self._last is not None else {}

    @property
    def findings(self) -> Mapping[str, tuple[Finding, ...]]:
        """What the user is shown of each file."""
        return self._last.findings if self._last is not None else {}

    @property
    def missing(self) -> tuple[Missing, ...]:
        """What of all that open files are launched with this machine does not have."""
        return self._last.missing if self._last is not None else ()

    @property
    def focus(self) -> str | None:
        """The open file that was last opened or edited."""
        return next(iter(self._choice.open), None)

    def roots_of(self, path: str) -> list[Root]:
        """The roots that reach a launch file or read a parameter file, the one that it is shown in first."""
        return self._choice.of(path)

    async def in_pool(self, work: Callable[[], _T]) -> _T:
        """Run `work` in a thread, where it finds what was typed so far."""
        await self.written()
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
        folder, package_path = self.folder, self.settings.package_path

        def work() -> Workspace:
            environment = detect(folder, package_path=package_path, variables=self._variables)
            similar = SimilarTraces(TraceCache(), environment, self._sources)
            return Workspace(environment, self._sources, commands=self.runs.commands.results, similar=similar)

        try:
            workspace = await self.in_pool(work)
        finally:
            self._detecting = None
        if (folder, package_path) == (self.folder, self.settings.package_path):
            self._workspace = workspace
            self.runs.set_workspace(workspace)

    # Which roots are analysed

    def _wanted(self) -> list[Root]:
        """The roots to be analysed: for each open file the one that it is shown in, then the others."""
        return list(dict.fromkeys((*self._shown(), *self._choice.others())))

    def _shown(self) -> list[Root]:
        """The roots that open files are shown in. A file that its root does not reach any more is shown by itself."""
        shown: dict[Root, None] = {}
        for path, root in self._choice.shown():
            shown[root] = None
            analysis = self._known.get(root)
            if analysis is not None and self.is_current(analysis) and path not in analysis.tree.inputs:
                shown[Root(path)] = None
        return list(shown)

    def _of(self, path: str) -> Iterator[Analysis]:
        """The analyses that reach a file, the one that it is shown in first."""
        for root in dict.fromkeys((*self.roots_of(path), Root(path), *self._known)):
            analysis = self._known.get(root)
            if analysis is not None and path in analysis.documents:
                yield analysis

    # How an edit becomes findings

    def _touch(self, path: str, edited: str | None, *, quiet: float) -> None:
        """Another text of a file counts. All but what is shown waits `quiet` seconds more."""
        self._quiet_at = time.monotonic() + quiet
        self.runs.hold(quiet)
        self.indexing.changed([path])
        self._start(edited)

    def _settle(self) -> None:
        self._settled.set()
        self.calm.set()

    def _start(self, edited: str | None = None) -> None:
        self._edited = edited
        self._settled.clear()
        self.calm.clear()
        self._news.set()
        if self._refreshing is None or self._refreshing.done():
            self._refreshing = self._server.spawn(self._refresh())

    async def _refresh(self) -> None:
        """Ask for what files are shown in at once, for the rest when the user pauses."""
        has_looked = False
        try:
            while True:
                self._news.clear()
                workspace = await self.workspace()
                shown = self._shown()
                if not await self._turn(workspace, shown) or shown != self._shown():
                    continue
                self._settle()
                if not await self._pauses() or not await self._turns(workspace, shown):
                    continue
                if has_looked:
                    break
                # Not every client tells of what changes on the disk, and none of all that launches depend on.
                has_looked = True
                if await self.in_pool(workspace.refresh):
                    self._start()
                elif not self._news.is_set():
                    break
        finally:
            self._settle()
        self.runs.wake()
        if self._branching is None or self._branching.done():
            self._branching = self._server.spawn(self._look_into_branches())

    async def _look_into_branches(self) -> None:
        """Evaluate what conditions leave out, while all that is shown is up to date: no edit waits for it, and the next
        one ends it."""
        workspace = self._workspace
        if workspace is None:
            return
        with contextlib.suppress(asyncio.CancelledError):
            if not await self._pauses(PAUSE_BEFORE_BRANCHES) or not self._settled.is_set():
                return  # they are looked into at the next pause
            for root in self._wanted():
                found = None
                while found is None:
                    try:
                        found = await self.in_pool(partial(branches_of, workspace, root, lambda: self._closed))
                    except Exception:
                        _log.exception("what %s leaves out could not be looked at", root)
                        found = Branches()
                    if not self._settled.is_set() or workspace is not self._workspace:
                        return  # likewise
                if await self.in_pool(partial(workspace.tell_branches, root, found)):
                    self._start()
                    return  # likewise

    async def _pauses(self, more: float = 0) -> bool:
        """Wait until the user has paused for some seconds `more`; whether nothing came before that."""
        while not self._news.is_set() and (pause := self.quiet_for + more) > 0:
            with contextlib.suppress(asyncio.TimeoutError):
                await asyncio.wait_for(self._news.wait(), pause)
        return not self._news.is_set()

    async def _turns(self, workspace: Workspace, shown: Collection[Root]) -> bool:
        """Ask for the roots that no file is shown in, one after another; whether nothing came before that."""
        for root in self._wanted():
            if root not in shown and not await self._turn(workspace, [root], only_news=True):
                return False
        return True

    async def _turn(self, workspace: Workspace, asked: Collection[Root], *, only_news: bool = False) -> bool:
        """Ask for some roots, and put the findings of all of them together; whether that is the last word."""
        snapshot = self._snapshot(asked, only_news)
        try:
            round_ = await self.in_pool(lambda: snapshot.round(workspace))
        except Exception:
            _log.exception("what was found in %s could not be put together", asked)
            return not self._news.is_set()
        if round_ is None or self._news.is_set() or self._closed:
            return False  # superseded by a newer text
        if round_ is not self._last:
            self._commit(round_)
        if round_.preliminary:
            self._settled.set()
        return not round_.preliminary

    def _snapshot(self, asked: Collection[Root], only_news: bool) -> Snapshot:
        return Snapshot(
            asked,
            list(dict.fromkeys((*self._wanted(), *asked))),
            {root: self.runs.results(root) for root in asked},
            frozenset((*self._choice.selected.values(), *self.indexing.named)),
            dict(self._choice.selected),
            self._last,
            only_news,
            self._server.texts,
            self._shows_related,
        )

    def _commit(self, round_: Round) -> None:
        self._last = round_
        current = [a.tree.inputs for root, a in round_.analyses.items() if root not in round_.outdated]
        clean = {
            path: list[types.Diagnostic]() for path in self._choice.open if any(path in inputs for inputs in current)
        }
        self._server.publisher.update(self, {**clean, **round_.diagnostics}, self._edited)
        for callback in self._server.after_analysis:
            callback()

    @property
    def _shows_related(self) -> bool:
        document = self._server.client_capabilities.text_document
        publish = document.publish_diagnostics if document else None
        pull = document.diagnostic if document else None
        return bool((publish and publish.related_information) or (pull and pull.related_information))
