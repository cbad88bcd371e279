"""Which roots are analysed for the files that are open, and which of them a file is shown in."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from preflight_analysis.workspace.index import Root

from preflight_server.lsp.launch_documents import may_be_parameter_file

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
        """Paths of open launch files, and of what may be a parameter file, the one that was last opened or edited
        first."""
        self.selected: dict[str, Root] = {}
        """The root that the user chose for a file to be shown in."""

    def to_front(self, path: str) -> None:
        """A file was opened or edited."""
        self.open = [path, *(p for p in self.open if p != path)]

    def leave(self, path: str) -> None:
        """A file is not open any more, or none that is shown."""
        self.open = [p for p in self.open if p != path]

    def of(self, path: str) -> list[Root]:
        """The roots that reach a launch file or read a parameter file, the one that it is shown in first. None reads a
        YAML file that is something else."""
        chosen = [self.selected[path]] if path in self.selected else []
        document, index = self._server.texts.by_path(path), self._session.indexing.index
        is_read_only = document is not None and may_be_parameter_file(document)
        found = index.roots_reading(path) if is_read_only else index.roots_of(path)
        return [*dict.fromkeys((*chosen, *found))]

    def shown(self) -> Iterator[tuple[str, Root]]:
        """The open files, each with the root that it is shown in."""
        for path in self.open:
            root = next(iter(self.of(path)), None)
            if root is not None:
                yield path, root

    def others(self) -> list[Root]:
        """All roots that reach open files, as many of each as are analysed."""
        return list(dict.fromkeys(root for path in self.open for root in self.of(path)[:MAX_ROOTS]))
