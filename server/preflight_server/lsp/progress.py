"""Work-done progress of one batch of runs, in the client's own progress display."""

from __future__ import annotations

import asyncio
import logging
import uuid
from typing import TYPE_CHECKING

from lsprotocol import types

from preflight_server.lsp.status import State

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer

_log = logging.getLogger(__name__)


class Progress:
    """Shows itself as soon as the client has accepted the token; a client that never answers sees nothing."""

    def __init__(self, server: PreflightServer, title: str, state: State, total: int = 0) -> None:
        self.token = str(uuid.uuid4())  # pygls never frees tokens, and clients may refuse one that they know
        self._state = state
        self._server = server
        self._title = title
        self._message: str | None = None
        self._percentage = 0
        self._shown = False
        self._ended = False
        server.status.working(self.token, state, 0, total)
        window = server.client_capabilities.window
        if window is not None and window.work_done_progress:
            server.spawn(self._begin())

    async def _begin(self) -> None:
        try:
            await self._server.window_work_done_progress_create_async(types.WorkDoneProgressCreateParams(self.token))
        except (Exception, asyncio.CancelledError) as error:
            _log.info("the client shows no progress: %s", error)
            return
        if not self._ended:
            self._shown = True
            self._send(
                types.WorkDoneProgressBegin(
                    self._title, cancellable=True, message=self._message, percentage=self._percentage
                )
            )

    def report(self, done: int, total: int, what: str) -> None:
        """How much is done, and what was the last or is the next."""
        if self._ended:
            return
        self._message, self._percentage = f"{done} of {total}: {what}", min(100 * done // max(total, 1), 100)
        self._server.status.working(self.token, self._state, done, total)
        if self._shown:
            self._send(
                types.WorkDoneProgressReport(message=self._message, percentage=self._percentage, cancellable=True)
            )

    def end(self, message: str) -> None:
        """Nothing more comes."""
        if self._shown and not self._ended:
            self._send(types.WorkDoneProgressEnd(message=message))
        self._ended = True
        self._server.status.ended(self.token)

    def _send(
        self, value: types.WorkDoneProgressBegin | types.WorkDoneProgressReport | types.WorkDoneProgressEnd
    ) -> None:
        self._server.protocol.notify(types.PROGRESS, types.ProgressParams(self.token, value))
