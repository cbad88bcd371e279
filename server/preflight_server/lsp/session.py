"""What the server knows of a workspace folder: what it is told, what it is asked, and the parts that work for it.

All state belongs to the event loop. The analysis itself runs in threads of our own (pygls' pool also reads standard
input), and what comes back is dropped if the text has changed in the meantime.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any, TypeVar

from lsprotocol.types import Position
from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.python_text import is_python
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.environment.detect import detect, workspace_of
from preflight_analysis.findings.finding import Finding
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.queries.places import nodes_around
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.similar import SimilarTraces
from preflight_analysis.workspace.index import Root, WorkspaceIndex
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Analysis, Workspace

from preflight_server.lsp.analyses import Analyses
from preflight_server.lsp.buffers import Buffers
from preflight_server.lsp.convert import Converter
from preflight_server.lsp.indexing import Indexing
from preflight_server.lsp.launch_documents import (
    is_build_file,
    is_handed_over,
    is_launch_file,
    is_python_launch_file,
    is_served,
    is_xml,
)
from preflight_server.lsp.root_choice import RootChoice
from preflight_server.lsp.runs import Runs
from preflight_server.lsp.settings import Settings, as_mapping
from preflight_server.lsp.text_store import OpenDocument, to_path

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer

_T = TypeVar("_T")

PAUSE_AFTER_TYPING = 0.5
"""Seconds without an edit before anything is done but to analyse the root in whose context the file is shown: half a
word is no argument to run a node with."""


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

    def text(self, path: str) -> str | None:
        """The text of any file, as one of the analyses has it; None where it is not known."""
        return next((text for each in self.analyses if (text := each.text(path)) is not None), None)

    def nodes_at(self, position: Any) -> tuple[str, ...]:
        """The full names of the nodes that start at a position of LSP, as JSON has it."""
        where = as_mapping(position)
        line, character = where.get("line"), where.get("character")
        if not isinstance(line, int) or not isinstance(character, int):
            return ()
        offset = self.converter.positions(self.path).offset(Position(line, character))
        return tuple(node.name for node in nodes_around(self.analysis.tree, self.path, offset))


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
        self._beside: tuple[str, ...] = ()
        self.settings = settings
        self._sources = Sources()
        self._buffers = Buffers(server, self._sources)
        for document in server.texts:
            self.takes(document)
        self._pool = ThreadPoolExecutor(3, thread_name_prefix="analysis")
        self._workspace: Workspace | None = None
        self._detecting: asyncio.Task[None] | None = None
        self.is_closed = False
        self.choice = RootChoice(server, self)
        self.analyses = Analyses(server, self)
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
        if is_handed_over(document):
            self.runs.commands.typed(stop=quiet > 0)
        if not own:
            self._touch(document.path, None, quiet=quiet)
            return
        if is_served(document):
            self.choice.to_front(document.path)
        elif self.shows(document.path) or not is_xml(document) or self.depends_on(document.path):
            self.choice.leave(document.path)
        else:
            return  # XML that has nothing to do with any launch
        if self.folder is None and (is_launch_file(document) or is_handed_over(document) or is_build_file(document)):
            # An editor that opened a file and no folder: the workspace is the one around the file.
            self.folder = workspace_of(document.path)
            self._forget_workspace()
            self.indexing.changed(None)
        self._touch(document.path, document.path, quiet=quiet)

    def closed(self, path: str) -> None:
        """A document that this folder depends on was closed."""
        self.choice.leave(path)
        self.runs.commands.typed(stop=False)
        self.runs.closed()
        self._touch(path, None, quiet=0)

    def released(self, path: str) -> None:
        """An open file belongs to another folder now."""
        if self.shows(path):
            self.closed(path)

    def shows(self, path: str) -> bool:
        """Whether a file is open and belongs to this folder."""
        return path in self.choice.open

    def depends_on(self, path: str) -> bool:
        """Whether some launch of this folder reads the file."""
        analyses = self.analyses.all.values()
        analysed = any(path in each.tree.inputs or each.document(path) is not None for each in analyses)
        return analysed or any(path in entry.inputs for entry in self.indexing.index.entries.values())

    def files_changed(self, paths: Iterable[str]) -> None:
        """Files changed on disk: launch files, parameter files or sources of nodes."""
        self.runs.forget_requests()
        self._buffers.look()
        self.analyses.ask_again()
        self.indexing.changed(paths)

    async def changed_on_disk(self, paths: Iterable[str]) -> bool:
        """Whether some of the files, which are not open, are other ones than what was read: not every change has been
        reported by the time that somebody asks. They are known then: ask anew."""
        closed = [path for path in paths if self._server.texts.by_path(path) is None]
        if not closed or not await self.in_pool(lambda: self._sources.look(closed)):
            return False
        await self.noticed(closed)
        return True

    async def noticed(self, paths: Iterable[str]) -> None:
        """Somebody found other texts than those that were analysed, of open files those typed a moment ago. Returns
        when the index has the new ones."""
        closed = [path for path in paths if self._server.texts.by_path(path) is None]
        if closed:
            self.files_changed(closed)
        await self.indexing.settled()

    def environment_changed(self) -> None:
        """Packages came or went, or settings that say where they are changed."""
        self._forget_workspace()
        self.runs.forget_requests()
        self.analyses.ask_again()
        self.indexing.changed(None)

    def configure(self, settings: Settings) -> None:
        """New settings."""
        if settings != self.settings:
            self.settings = settings
            self.environment_changed()

    def set_beside(self, folders: tuple[str, ...]) -> None:
        """The folders that are open besides: their files may be read."""
        if folders != self._beside:
            self._beside = folders
            if self._workspace is not None:
                self.environment_changed()

    def set_trusted(self, trusted: bool) -> None:
        """Whether the user trusts the workspace, so that its nodes may be run in the sandbox."""
        changed = trusted != self.runs.trusted
        self.runs.set_trusted(trusted)
        if changed:  # it may read other files
            self.environment_changed()
        else:
            self.analyses.ask_again()

    def traces_cleared(self) -> None:
        """What earlier runs told is to be forgotten."""
        self.runs.clear()
        self.analyses.ask_again()

    async def select(self, path: str, root: Root | None) -> str | None:
        """Show a file, and all others that it reaches, in the context of this root; None for the one that counts where
        nobody chose any. Returns why not."""
        if root is None:
            await self.choice.unchoose(path)
            return None
        reached = self.choice.known_to_reach(root, path)
        if not reached:
            workspace = await self.workspace()
            analysis = await self.in_pool(lambda: workspace.evaluated(root.path, dict(root.args)))
            reached = analysis.reached
        if path not in reached:
            return f"{root.label} does not include {path}"
        await self.choice.choose(root, reached)
        return None

    async def interrupt(self) -> None:
        """Have what is under way begin again: something else comes first now."""
        await self.in_pool(self._sources.db.interrupt)

    def close(self) -> None:
        """Leave nothing running. Returns when the threads have ended; may be called from any thread, and twice."""
        self.is_closed = True
        self.runs.close()
        self.indexing.close()
        self._buffers.close()
        self._pool.shutdown(wait=True, cancel_futures=True)

    def _touch(self, path: str, edited: str | None, *, quiet: float) -> None:
        """Another text of a file counts. All but what is shown waits `quiet` seconds more."""
        self.analyses.hold(quiet)
        self.runs.hold(quiet)
        self.indexing.changed([path])
        self.analyses.ask_again(edited)

    # What the handlers ask

    async def view(self, uri: str, *, python: bool = False) -> View | None:
        """The file as it is now, analysed; None if it is no open launch file or parameter file of one, or could not be
        analysed. Of Python files only those ask that say what no Python language server does: `python`."""
        await self.analyses.settled()
        document = self._server.texts.get(uri)
        if document is None or document.path is None or not self.shows(document.path):
            return None
        if is_python_launch_file(document) and not python:
            return None
        analyses = tuple(self.analyses.of(document.path))
        parsed = analyses[0].document(document.path) if analyses else None
        if parsed is None or parsed.text != document.text:
            return None
        findings = self.analyses.findings.get(document.path, ())
        pages, edits = self._server.shown_pages, self._server.edit_support
        converter = Converter(self._server.texts, analyses[0].documents, pages=pages, edits=edits)
        index = self.indexing.index
        return View(self, document, document.path, analyses[0], analyses, index, findings, converter)

    async def latest(self, uri: str, *, python: bool = False) -> tuple[LaunchFile, Analysis] | None:
        """The file as it is now, and the newest analysis that there is, which may be one of an earlier text: for what
        cannot wait while somebody types. None if it is no open launch file or parameter file of one, or was never
        analysed. Those who ask for `python` get the text of such a file, without what can be read from it."""
        document = self._server.texts.get(uri)
        path = document.path if document is not None and document.path in self.choice.open else None
        if document is None or path is None or (is_python_launch_file(document) and not python):
            return None
        if next(self.analyses.of(path), None) is None:
            await self.analyses.settled()
        analysis = next(self.analyses.of(path), None)
        launch_file = await self.in_pool(lambda: self._newest(path))
        if analysis is None or isinstance(launch_file, Unreadable) or launch_file.document.text != document.text:
            return None
        return launch_file, analysis

    def _newest(self, path: str) -> LaunchFile | Unreadable:
        text = self._sources.text(path)
        if isinstance(text, Unreadable) or not is_python(path, text.text):
            return self._sources.launch_file(path)
        return LaunchFile(path, 2, None, text, partial=True)

    def looked_at(self, uri: str) -> None:
        """The user looks at an open file: what it needs is run first."""
        path = to_path(uri)
        if path is not None and self.shows(path) and self.focus != path:
            self.choice.to_front(path)
            self.runs.look_again()

    @property
    def focus(self) -> str | None:
        """The open file that was last opened or edited."""
        return next(iter(self.choice.open), None)

    # What the parts ask

    async def written(self) -> None:
        """Wait until whoever reads files finds what was typed so far."""
        await self._buffers.written()

    async def in_pool(self, work: Callable[[], _T]) -> _T:
        """Run `work` in a thread, where it finds what was typed so far."""
        await self.written()
        if self.is_closed:
            raise asyncio.CancelledError
        return await asyncio.get_running_loop().run_in_executor(self._pool, work)

    async def workspace(self) -> Workspace:
        """The workspace, whose environment is detected first if need be."""
        while self._workspace is None:
            if self._detecting is None:
                self._detecting = self._server.spawn(self._detect())
            await asyncio.shield(self._detecting)
        return self._workspace

    def uses(self, workspace: Workspace) -> bool:
        """Whether it is still that of the folder."""
        return workspace is self._workspace

    def _forget_workspace(self) -> None:
        if self._workspace is not None:
            self._workspace.close()
        self._workspace = None

    @property
    def _detected_from(self) -> tuple[str | None, tuple[str, ...] | None, tuple[str, ...], bool]:
        return self.folder, self.settings.package_path, self._beside, self.runs.trusted

    async def _detect(self) -> None:
        given = folder, package_path, beside, trusted = self._detected_from

        def work() -> tuple[Workspace, Mapping[Root, frozenset[str]]]:
            environment = detect(folder, package_path, self._variables, beside=beside, outside=trusted)
            similar = SimilarTraces(TraceCache(), environment, self._sources)
            workspace = Workspace(environment, self._sources, commands=self.runs.commands.results, similar=similar)
            return workspace, self.choice.load(folder)

        try:
            workspace, chosen = await self.in_pool(work)
        finally:
            self._detecting = None
        if given == self._detected_from:
            self._workspace = workspace
            self.choice.take(folder, chosen)
            self.runs.set_workspace(workspace)
