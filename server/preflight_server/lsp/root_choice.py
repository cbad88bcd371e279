"""Which roots are analysed for the files that are open, and which of them a file is shown in."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING

from preflight_analysis.workspace.handed_over import roots_naming
from preflight_analysis.workspace.index import Root, WorkspaceIndex
from preflight_analysis.workspace.workspace import Workspace

from preflight_server.lsp.launch_documents import is_handed_over, may_be_parameter_file

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer
    from preflight_server.lsp.session import Session

MAX_ROOTS = 8
"""How many of the roots that reach a file are analysed while it is open, the one that it is shown in first."""


class RootChoice:
    """Of one session; use it on the event loop."""

    def __init__(self, server: PreflightServer, session: Session) -> None:
        self._server = server
        self._session = session
        self.open: list[str] = []
        """Paths of open launch files, and of what these may hand over, the one that was last opened or edited
        first."""
        self.selected: dict[str, Root] = {}
        """The root that the user chose for a file to be shown in."""
        self._naming: dict[str, tuple[WorkspaceIndex, tuple[Root, ...]]] = {}
        """Of files that no analysed launch is known to hand over: the roots that seem to, by an index."""

    def to_front(self, path: str) -> None:
        """A file was opened or edited."""
        self.open = [path, *(p for p in self.open if p != path)]

    def leave(self, path: str) -> None:
        """A file is not open any more, or none that is shown."""
        self.open = [p for p in self.open if p != path]
        self._naming.pop(path, None)

    def of(self, path: str) -> list[Root]:
        """The roots that reach a launch file, or to which another file is handed over, the one that it is shown in
        first. None reads a file that is something else."""
        chosen = [self.selected[path]] if path in self.selected else []
        document, index = self._server.texts.by_path(path), self._session.indexing.index
        if self.is_handed_over(path):
            found = self._analysed(path) or (*index.roots_reading(path), *self._naming.get(path, (index, ()))[1])
        else:
            is_read_only = document is not None and may_be_parameter_file(document)
            found = index.roots_reading(path) if is_read_only else index.roots_of(path)
        return [*dict.fromkeys((*chosen, *found))]

    def is_handed_over(self, path: str) -> bool:
        """Whether an open file is one that launches hand over: it is never launched itself."""
        document = self._server.texts.by_path(path)
        return document is not None and is_handed_over(document)

    def _analysed(self, path: str) -> tuple[Root, ...]:
        """The roots that are analysed and to which the file is handed over."""
        analyses = self._session.analyses.all.items()
        return tuple(root for root, each in analyses if path not in each.tree.files and each.document(path) is not None)

    def find_readers(self, workspace: Workspace) -> None:
        """Look in the background for roots of the open files that no analysed launch reads."""
        index = self._session.indexing.index
        for path in self.open if index.complete else ():
            known = self._naming.get(path)
            if (known is None or known[0] is not index) and self.is_handed_over(path) and not self._analysed(path):
                self._naming[path] = (index, known[1] if known is not None else ())
                self._server.spawn(self._find(workspace, index, path))

    async def _find(self, workspace: Workspace, index: WorkspaceIndex, path: str) -> None:
        sources, environment = workspace.sources, workspace.environment
        found = await self._session.in_pool(partial(roots_naming, index, sources, environment, path))
        known = self._naming.get(path)
        if known is not None and known[0] is index and known[1] != found:
            self._naming[path] = (index, found)
            self._session.analyses.ask_again()

    def shown(self) -> Iterator[tuple[str, Root]]:
        """The open files, each with the root that it is shown in."""
        for path in self.open:
            root = next(iter(self.of(path)), None)
            if root is not None:
                yield path, root

    def others(self) -> list[Root]:
        """All roots that reach open files, as many of each as are analysed."""
        return list(dict.fromkeys(root for path in self.open for root in self.of(path)[:MAX_ROOTS]))
