"""The texts of an editor, and looks at the disk, on their way into the database, by a thread of their own.

A write cancels readers and waits until they have left, which takes as long as what they are at between two questions:
the parse of a large file. Nothing on the event loop waits for that.
"""

from __future__ import annotations

import asyncio
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING

from preflight_analysis.workspace.sources import Sources

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer


class Buffers:
    """Use it on the event loop. What comes while others are written is written at once thereafter, of each file the
    newest text alone."""

    def __init__(self, server: PreflightServer, sources: Sources) -> None:
        self._server = server
        self._sources = sources
        self._pending: dict[str, str | None] = {}
        self._look = False
        self._writing: asyncio.Task[None] | None = None
        self._closed = False
        self._pool = ThreadPoolExecutor(1, thread_name_prefix="buffers")

    def put(self, path: str, text: str | None) -> None:
        """The text counts in place of the file; None: the file on the disk does."""
        self._pending[path] = text
        self._start()

    def look(self) -> None:
        """Files changed on the disk."""
        self._look = True
        self._start()

    def _start(self) -> None:
        if self._writing is None or self._writing.done():
            self._writing = self._server.spawn(self._write())

    async def written(self) -> None:
        """Wait until all that was put so far is what a reader finds."""
        if self._writing is not None and not self._writing.done():
            await asyncio.shield(self._writing)

    def close(self) -> None:
        """Write no more. Returns when the thread has ended; may be called from any thread, and twice."""
        self._closed = True
        self._pool.shutdown(wait=True, cancel_futures=True)

    async def _write(self) -> None:
        loop = asyncio.get_running_loop()
        while (self._pending or self._look) and not self._closed:
            texts, self._pending = self._pending, {}
            look, self._look = self._look, False
            if texts:
                await loop.run_in_executor(self._pool, self._sources.take, texts)
            if look:
                await loop.run_in_executor(self._pool, self._sources.look)
