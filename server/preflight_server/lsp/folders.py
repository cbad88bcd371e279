"""The sessions of a client: one for each workspace folder, since each has its own environment and index.

A file belongs to the innermost folder that holds it, and to the first where none does. What changes is passed on to
each session that depends on it.
"""

from __future__ import annotations

import asyncio
import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import TYPE_CHECKING

from preflight_server.lsp.launch_documents import is_build_file, is_served
from preflight_server.lsp.session import PAUSE_AFTER_TYPING, Session
from preflight_server.lsp.settings import Settings
from preflight_server.lsp.text_store import OpenDocument

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer


class Folders:
    """Use it on the event loop. There is always a session: one of no folder where none is open."""

    def __init__(
        self,
        server: PreflightServer,
        folders: Iterable[str],
        settings: Settings,
        *,
        trusted: bool,
        environments: Mapping[str, Mapping[str, str]],
    ) -> None:
        self._server = server
        self._environments = environments
        self._settings = settings
        self._trusted = trusted
        self._sessions: dict[str | None, Session] = {}
        self._closing: list[Session] = []
        self._make(folders)

    def __iter__(self) -> Iterator[Session]:
        """The sessions in the order of their folders."""
        return iter(tuple(self._sessions.values()))

    def of(self, path: str | None) -> Session:
        """The session that a file belongs to."""
        holding = [folder for folder in self._sessions if folder and path and _holds(folder, path)]
        return self._sessions[max(holding, key=len)] if holding else next(iter(self))

    def _make(self, folders: Iterable[str]) -> list[Session]:
        new = [folder for folder in dict.fromkeys(folders) if folder not in self._sessions]
        keys: list[str | None] = [*new] if new or self._sessions else [None]
        made = [self._session(key) for key in keys]
        self._sessions.update(zip(keys, made, strict=True))
        for session in self:
            session.set_beside(tuple(folder for folder in self._sessions if folder not in (None, session.folder)))
        return made

    def _session(self, folder: str | None) -> Session:
        variables = self._environments.get(folder) if folder is not None else None
        return Session(self._server, folder, self._settings, trusted=self._trusted, variables=variables)

    def change(self, added: Iterable[str], removed: Iterable[str]) -> list[Session]:
        """The user opened folders and closed others. Returns the new sessions."""
        left: list[str | None] = [*removed]
        added = list(added)
        if added:
            left.append(None)
        gone = [self._sessions.pop(folder) for folder in left if folder in self._sessions]
        made = self._make(added)
        for document in self._server.texts:
            if document.path is not None and is_served(document):
                owner = self.of(document.path)
                for session in self:
                    if session is not owner:
                        session.released(document.path)
                    elif not session.shows(document.path):
                        session.text_changed(document, own=True, quiet=0)
        for session in gone:
            self._server.publisher.forget(session)
            self._server.live.forget(session)
            self._closing.append(session)
            self._server.spawn(self._close(session))
        return made

    async def _close(self, session: Session) -> None:
        await asyncio.get_running_loop().run_in_executor(None, session.close)
        self._closing.remove(session)

    def close(self) -> None:
        """Leave nothing running; may be called from any thread."""
        self._server.live.close()
        for session in (*self, *self._closing):
            session.close()

    # What the client tells

    def opened(self, document: OpenDocument) -> None:
        """A document was opened, or its text taken over anew."""
        self._take_over(document, quiet=0)

    def changed(self, document: OpenDocument) -> None:
        """Its text changed."""
        self._take_over(document, quiet=PAUSE_AFTER_TYPING)

    def _take_over(self, document: OpenDocument, quiet: float) -> None:
        if document.path is None:
            return
        owner = self.of(document.path)
        for session in self:
            session.takes(document)
            if session is owner or session.depends_on(document.path):
                session.text_changed(document, own=session is owner, quiet=quiet)

    def closed(self, document: OpenDocument) -> None:
        """The file on disk counts again."""
        path = document.path
        if path is None or self._server.texts.by_path(path) is not None:
            return
        for session in self:
            session.leaves(path)
            if session.shows(path) or session.depends_on(path) or is_build_file(document):
                session.closed(path)

    def configure(self, settings: Settings, of_folder: Mapping[Session, Settings] | None = None) -> None:
        """New settings, and those that a folder has for itself."""
        self._settings = settings
        for session in self:
            session.configure((of_folder or {}).get(session, settings))

    def set_trusted(self, trusted: bool) -> None:
        """Whether the user trusts the workspace, so that its nodes may be run in the sandbox."""
        self._trusted = trusted
        if not trusted:
            self._server.live.stop("the workspace is no longer trusted")
        self.each(lambda session: session.set_trusted(trusted))

    def each(self, call: Callable[[Session], object]) -> None:
        """Pass something on to every session."""
        for session in self:
            call(session)


def _holds(folder: str, path: str) -> bool:
    return path == folder or path.startswith(folder.rstrip(os.sep) + os.sep)
