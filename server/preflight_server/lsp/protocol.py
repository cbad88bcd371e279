"""pygls' protocol without its own copy of the documents: ours are in `TextStore`, which counts lines as LSP does."""

from __future__ import annotations

import logging
from collections.abc import Generator
from typing import Any

from lsprotocol import types
from pygls.exceptions import JsonRpcException
from pygls.protocol import LanguageServerProtocol
from pygls.protocol.language_server import lsp_method


class RefusedError(JsonRpcException):
    """What the user asked for cannot be done, and why: an answer, not a failure of ours."""

    CODE = types.LSPErrorCodes.RequestFailed


def is_failure(record: logging.LogRecord) -> bool:
    """A filter for pygls' log, which takes each error that is answered for a failure."""
    return not (record.exc_info and isinstance(record.exc_info[1], RefusedError))


def pulls_diagnostics(capabilities: types.ClientCapabilities) -> bool:
    """Whether the client fetches the diagnostics of open files itself, and again when it is asked to."""
    document, workspace = capabilities.text_document, capabilities.workspace
    refresh = workspace.diagnostics if workspace else None
    return bool(document and document.diagnostic and refresh and refresh.refresh_support)


class PreflightProtocol(LanguageServerProtocol):
    """Hands document and progress messages to our own handlers alone."""

    @property
    def was_shut_down(self) -> bool:
        """Whether the client sent `shutdown`, as it should before `exit`."""
        return self._shutdown

    @lsp_method(types.INITIALIZE)
    def lsp_initialize(self, params: types.InitializeParams) -> Generator[Any, Any, types.InitializeResult]:
        """`initialize`. A client that gets its diagnostics published is not offered to pull them as well."""
        result: types.InitializeResult = yield from super().lsp_initialize(params)
        if not pulls_diagnostics(params.capabilities):
            result.capabilities.diagnostic_provider = None
        return result

    def _pass_on(self, method: str, params: Any) -> Generator[Any, Any, None]:
        if (handler := self.fm.features.get(method)) is not None:
            yield handler, (params,), None

    @lsp_method(types.TEXT_DOCUMENT_DID_OPEN)
    def lsp_text_document__did_open(self, params: types.DidOpenTextDocumentParams) -> Generator[Any, Any, None]:
        """`textDocument/didOpen`."""
        yield from self._pass_on(types.TEXT_DOCUMENT_DID_OPEN, params)

    @lsp_method(types.TEXT_DOCUMENT_DID_CHANGE)
    def lsp_text_document__did_change(self, params: types.DidChangeTextDocumentParams) -> Generator[Any, Any, None]:
        """`textDocument/didChange`."""
        yield from self._pass_on(types.TEXT_DOCUMENT_DID_CHANGE, params)

    @lsp_method(types.TEXT_DOCUMENT_DID_CLOSE)
    def lsp_text_document__did_close(self, params: types.DidCloseTextDocumentParams) -> Generator[Any, Any, None]:
        """`textDocument/didClose`."""
        yield from self._pass_on(types.TEXT_DOCUMENT_DID_CLOSE, params)

    @lsp_method(types.WINDOW_WORK_DONE_PROGRESS_CANCEL)
    def lsp_work_done_progress_cancel(self, params: types.WorkDoneProgressCancelParams) -> Generator[Any, Any, None]:
        """`window/workDoneProgress/cancel`."""
        yield from self._pass_on(types.WINDOW_WORK_DONE_PROGRESS_CANCEL, params)
