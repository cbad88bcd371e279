"""Has the client ask again for what it shows above or beside the text, when that is no longer so."""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections.abc import Awaitable, Callable
from typing import TYPE_CHECKING

from preflight_analysis.dataclass import dataclass

from preflight_server.lsp.text_store import OpenDocument

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer

_log = logging.getLogger(__name__)
_TO_ASK = 1.0
"""Seconds that a client has to ask again. VS Code forgets to, where its editor loses the focus just then."""


@dataclass(frozen=True, slots=True)
class _Answered:
    document: OpenDocument
    answer: object
    ask: Callable[[], Awaitable[object]]


class Refresher:
    """After each analysis, as soon as the user pauses, what the client was told of each document is asked for once
    more, and `refresh` called when the answer is another one."""

    def __init__(
        self, server: PreflightServer, refresh: Callable[[], Awaitable[object]], supported: Callable[[], bool]
    ) -> None:
        self._server = server
        self._refresh = refresh
        self._supported = supported
        self._answered: dict[str, _Answered] = {}
        self._task: asyncio.Task[None] | None = None
        self._again = False
        self._told = asyncio.Event()
        self.looks = 0
        """How often the answers may have become others so far."""
        server.after_analysis.append(self.look)

    def answered(
        self, document: OpenDocument, answer: object, ask: Callable[[], Awaitable[object]], asked: int
    ) -> None:
        """What the client was told of a document, and how to ask for it again; `ask` gives None where it cannot.
        `asked` are the `looks` from before the answer was made: it may be out of date already."""
        self._answered[document.uri] = _Answered(document, answer, ask)
        self._told.set()
        if asked != self.looks:
            self._compare_soon()

    def look(self) -> None:
        """The answers may be others now."""
        self.looks += 1
        self._compare_soon()

    def _compare_soon(self) -> None:
        self._again = True
        if self._answered and (self._task is None or self._task.done()) and self._supported():
            self._task = self._server.spawn(self._compare())

    async def _compare(self) -> None:
        while self._again:
            for session in self._server.sessions:
                await session.analyses.quiet()
            self._again = False
            for uri, last in tuple(self._answered.items()):
                if self._server.texts.get(uri) is not last.document:
                    del self._answered[uri]  # closed, or edited: then the client asks by itself
                    continue
                now = await last.ask()
                if now is not None and now != last.answer and self._answered.get(uri) is last:
                    self._answered.clear()
                    await self._ask()
                    break

    async def _ask(self) -> None:
        for _ in range(2):
            self._told.clear()
            try:
                await self._refresh()
            except Exception as error:
                _log.info("the client did not refresh: %s", error)
                return
            with contextlib.suppress(asyncio.TimeoutError):
                await asyncio.wait_for(self._told.wait(), _TO_ASK)
                return
