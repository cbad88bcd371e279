"""The server object: what the client can do, the open texts and the session; handlers are in `features/`."""

from __future__ import annotations

import asyncio
import gc
import importlib
import logging
import os
import pkgutil
import sys
from collections.abc import Callable
from typing import Any

from lsprotocol import types
from preflight_analysis import __version__
from pygls.lsp.server import LanguageServer

from preflight_server.lsp import features
from preflight_server.lsp.protocol import PreflightProtocol, RefusedError, is_failure
from preflight_server.lsp.session import Session
from preflight_server.lsp.settings import Settings, as_mapping
from preflight_server.lsp.status import Status
from preflight_server.lsp.text_store import TextStore, to_path

_log = logging.getLogger(__name__)


class PreflightServer(LanguageServer):
    """One client's server. `session` is there once the client has initialised it."""

    protocol: PreflightProtocol

    def __init__(self) -> None:
        super().__init__(
            "ros-preflight",
            __version__,
            text_document_sync_kind=types.TextDocumentSyncKind.Incremental,
            protocol_cls=PreflightProtocol,
        )
        self.texts = TextStore()
        self.session: Session | None = None
        self.after_analysis: list[Callable[[], None]] = []
        """Called on the event loop whenever analyses were replaced by newer ones."""
        self.status = Status(self)
        self.client_commands: frozenset[str] = frozenset()
        """Our commands that the client carries out itself."""
        self._background: set[asyncio.Task[Any]] = set()
        for module in pkgutil.iter_modules(features.__path__):
            importlib.import_module(f"{features.__name__}.{module.name}").register(self)

    def initialise(self, params: types.InitializeParams) -> None:
        """Take over what the client says of itself and of the workspace."""
        options = as_mapping(params.initialization_options)
        self.texts.encoding = self.workspace.position_encoding or types.PositionEncodingKind.Utf16
        commands = options.get("clientCommands")
        self.client_commands = frozenset(map(str, commands)) if isinstance(commands, list) else frozenset()
        self.status.wanted = options.get("status") is True
        folders = [f.uri for f in params.workspace_folders or ()] or [params.root_uri or ""]
        folder = next((path for uri in folders if (path := to_path(uri)) is not None), None)
        self.session = Session(self, folder, Settings.read(options), trusted=options.get("workspaceTrusted") is True)

    def report_server_error(self, error: Exception, source: Any) -> None:
        """A handler broke: that belongs in the log, not in a message box for each keystroke."""
        if not isinstance(error, RefusedError):
            _log.error("%s: %s", getattr(source, "__name__", source), error)

    def spawn(self, coroutine: Any) -> asyncio.Task[Any]:
        """Run a coroutine beside the handlers; what it raises goes to the log."""
        task = asyncio.get_running_loop().create_task(coroutine)
        self._background.add(task)
        task.add_done_callback(self._finished)
        return task

    def _finished(self, task: asyncio.Task[Any]) -> None:
        self._background.discard(task)
        if not task.cancelled() and (error := task.exception()) is not None:
            _log.error("a background task broke", exc_info=error)


def serve() -> int:
    """Serve standard input and output until the client leaves. The exit code is LSP's: 1 without `shutdown` first.

    Messages go to a descriptor of their own and standard output becomes standard error, so that neither a stray
    `print` nor an inherited PYTHONUNBUFFERED can break the stream.
    """
    # Documents and trees are large, short-lived and without cycles: at the usual thresholds a third of the time after
    # a keystroke would go into looking for garbage that is not there.
    gc.set_threshold(100_000, 20, 100)
    logging.basicConfig(level=logging.WARNING, stream=sys.stderr, format="%(levelname)s %(name)s: %(message)s")
    # At INFO pygls logs whole documents.
    logging.getLogger("pygls").setLevel(logging.ERROR)
    logging.getLogger("pygls.protocol.json_rpc").addFilter(is_failure)
    server = PreflightServer()
    with open(os.dup(1), "wb") as out:
        os.dup2(2, 1)
        try:
            server.start_io(stdout=out)
        finally:
            if server.session is not None:
                server.session.close()
    return 0 if server.protocol.was_shut_down else 1
