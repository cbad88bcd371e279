"""What the client was told, file by file, and what it has to be told next.

A client gets the diagnostics of a file in one way only, since editors show both and would show them twice: files that
are open are left to a client that pulls (`textDocument/diagnostic`) and lets itself be asked to pull again
(`workspace/diagnostic/refresh`); everything else, included files that are not open for instance, is published.
"""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from lsprotocol import types
from preflight_analysis.dataclass import dataclass

from preflight_server.lsp.protocol import pulls_diagnostics
from preflight_server.lsp.text_store import to_uri

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer
    from preflight_server.lsp.session import Session

_log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class _Published:
    uri: str
    version: int | None
    diagnostics: Sequence[types.Diagnostic]


class Publisher:
    """Diagnostics by path. Call it on the event loop only."""

    def __init__(self, server: PreflightServer) -> None:
        self._server = server
        self._found: dict[Session, Mapping[str, list[types.Diagnostic]]] = {}
        """By folder."""
        self._current: dict[str, list[types.Diagnostic]] = {}
        self._published: dict[str, _Published] = {}
        self._pulled: dict[str, list[types.Diagnostic]] = {}

    @property
    def pulls(self) -> bool:
        """Whether the client fetches the diagnostics of open files itself."""
        return pulls_diagnostics(self._server.client_capabilities)

    def update(self, session: Session, found: Mapping[str, list[types.Diagnostic]], edited: str | None) -> None:
        """`found` are those of all files that have any in that folder, or that must be told that they have none.
        `edited` is the file whose edit led to them: its editor asks for them by itself."""
        self._found[session] = found
        self._publish_changed(edited)

    def forget(self, session: Session) -> None:
        """A folder was closed."""
        if self._found.pop(session, None) is not None:
            self._publish_changed(None)

    def _merged(self) -> dict[str, list[types.Diagnostic]]:
        """What is told of each file: what its own folder says of it, else what the others do."""
        merged: dict[str, list[types.Diagnostic]] = {}
        for found in self._found.values():
            for path, diagnostics in found.items():
                merged[path] = self._of_several(path) if path in merged else diagnostics
        return merged

    def _of_several(self, path: str) -> list[types.Diagnostic]:
        owner = self._server.session_of(to_uri(path))
        if owner is not None and path in self._found.get(owner, ()):
            return self._found[owner][path]
        merged: list[types.Diagnostic] = []
        for found in self._found.values():
            merged += [each for each in found.get(path, ()) if each not in merged]
        return merged

    def _publish_changed(self, edited: str | None) -> None:
        diagnostics = self._current = self._merged()
        stale = False
        for path in dict.fromkeys((*diagnostics, *self._published)):
            document = self._server.texts.by_path(path)
            if document is not None and self.pulls:
                self._publish(path, document.uri, None, [], must=False)
                stale |= path != edited and self._pulled.get(path, []) != diagnostics.get(path, [])
            else:
                uri, version = (document.uri, document.version) if document else (to_uri(path), None)
                self._publish(path, uri, version, diagnostics.get(path, []), must=document is not None)
        if stale:
            self.refresh()

    def pull(self, path: str) -> list[types.Diagnostic]:
        """The diagnostics of an open file, for a client that asks."""
        found = self._pulled[path] = self._current.get(path, [])
        return found

    def refresh(self) -> None:
        """Ask a client that pulls to do so again."""
        if self.pulls:
            self._server.spawn(self._refresh())

    async def _refresh(self) -> None:
        try:
            await self._server.workspace_diagnostic_refresh_async(None)
        except Exception as error:
            _log.info("the client did not refresh: %s", error)

    def _publish(self, path: str, uri: str, version: int | None, found: list[types.Diagnostic], must: bool) -> None:
        last, new = self._published.get(path), _Published(uri, version, found)
        if last == new or (last is None and not found and not must):
            return
        if last is not None and last.uri != uri and last.diagnostics:
            self._send(_Published(last.uri, None, []))
        if found or must:
            self._published[path] = new
        else:
            self._published.pop(path, None)
        self._send(new)

    def _send(self, last: _Published) -> None:
        self._server.text_document_publish_diagnostics(
            types.PublishDiagnosticsParams(last.uri, last.diagnostics, last.version)
        )
