"""pygls' protocol without its own copy of the documents: ours are in `TextStore`, which counts lines as LSP does."""

from __future__ import annotations

import logging
from collections.abc import Generator
from concurrent.futures import Future
from typing import TYPE_CHECKING, Any

from lsprotocol import types
from preflight_analysis.findings.printable import printable
from pygls.exceptions import JsonRpcException, JsonRpcInvalidRequest
from pygls.protocol import LanguageServerProtocol
from pygls.protocol.language_server import lsp_method

if TYPE_CHECKING:
    from pygls.protocol.json_rpc import MessageCallback, MessageHandler, MsgId

WATCH = "rosPreflight/watch"
"""Our own request to watch the running system, `{"uri", "watch": bool}` → `{"watching": bool, "message": string |
null}`: start or stop to compare the ROS 1 master or ROS 2 domain that the server's environment leads to with what the
root in whose context the file is shown should have started. One root is watched at a time. `message` says why it is
not: without trust it never is. What is found comes by `LIVE`, until the client stops it, trust is taken back, or the
system can never be asked."""

LIVE = "rosPreflight/live"
"""Our own notification about the running system while it is watched, `{"root": {"uri", "args"}, "event", ...}`:

- `"event": "waiting"`, `"reason"`: the system cannot be asked; it is waited for. States told before hold no longer.
- `"attached"`, or for another run of the same master `"restarted"`, `"to"`: what is watched, for people.
- `"state"`, whenever it changes: `"same": bool`, `"nodes"`, `"topics"`, `"services"` and `"actions"`, each
  `{full name: "present" | "missing" | "extra" | "dead" | "wrong-type" | "differs" |
  "inactive" | "unsure"}`, and `"issues"`: `[{"kind":
  "missing" | "extra" | "dead" | "twice" | "wrong-type" | "wrong-qos", "what": "node" | "publisher" | "subscriber" |
  "service" | "client" | "action_server" | "action_client", "node": full name, "name": that of the end | null,
  "expected", "actual", "similar": string | null, "counts": bool, "message": string, "location": Location | null,
  "source": Location | null}]`. What does not count is for information. `location` is the line of the launch file that
  should have made it, `source` that of the node's source. `unsure` is what is not there and need not be; a node
  is `wrong-type` where one of its ends is; it `differs` where it runs and an issue counts, and is `inactive` where it
  is a lifecycle node that nothing has activated. Full names are those of `rosPreflight/tree`, also of nodes that run
  under another one, as with anonymous names; `"node"` of an issue is the one that it runs under.
- `"stopped"`, `"reason": string | null`: nothing is watched any more.

The graph that is compared with is that of the newest analysis: an edit shows in the next state."""


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


_IN_ONE_LINE = frozenset({"title", "label", "detail", "name", "description"})
_IN_LINES = frozenset({"message", "documentation", "contents", "value", "tooltip"})
"""The keys of texts that a client shows. Others are edits, texts, URIs and what comes back with a request."""


def _shown(data: Any, key: str = "") -> Any:
    if isinstance(data, str):
        if key in _IN_ONE_LINE or key in _IN_LINES:
            return printable(data, lines=key in _IN_LINES)
        return data
    if isinstance(data, dict):
        return {name: _shown(value, name) for name, value in data.items()}
    if isinstance(data, (list, tuple)):
        return [_shown(each, key) for each in data]
    return data


class _Futures(dict[Any, Future[Any]]):
    """Those of messages that are being handled. pygls goes through them at `shutdown`, while they end one by one."""

    def items(self) -> Any:
        return tuple(super().items())


class PreflightProtocol(LanguageServerProtocol):
    """Hands messages about documents, folders and progress to our own handlers alone."""

    def __init__(self, *args: Any) -> None:
        super().__init__(*args)
        self._request_futures = _Futures()

    @property
    def was_shut_down(self) -> bool:
        """Whether the client sent `shutdown`, as it should before `exit`."""
        return self._shutdown

    def structure_message(self, data: dict[str, Any]) -> Any:
        """The message of a JSON object. An id is a number or a text: pygls looks requests up by whatever it is."""
        if "jsonrpc" in data and not isinstance(data.get("id"), str | int | None):
            error = JsonRpcInvalidRequest("an id is a number or a text")
            self.refuse_message(None, error)
            raise error
        try:
            return super().structure_message(data)
        except JsonRpcException as error:
            # pygls answers to what its handlers raise alone, and the client would wait for ever.
            if "method" in data and data.get("id") is not None:
                self.refuse_message(data["id"], error)
            raise

    def _serialize_message(self, data: Any) -> Any:
        """A message as plain data; what the client shows of it is harmless, wherever it comes from."""
        return _shown(super()._serialize_message(data))

    def refuse_message(self, msg_id: MsgId | None, error: JsonRpcException) -> None:
        """Answer a message that cannot be handled; None for one whose id is not known."""
        # pygls leaves out an id that is null.
        answer = {"code": error.code, "message": error.message}
        self._send_data({"jsonrpc": "2.0", "id": msg_id, "error": answer})

    def _execute_handler(
        self,
        msg_id: MsgId,
        handler: MessageHandler,
        callback: MessageCallback,
        args: tuple[Any, ...] | None = None,
        kwargs: dict[str, Any] | None = None,
    ) -> None:
        """Handle a message, and forget it: pygls keeps a future of each notification for ever."""

        def ended(future: Future[Any]) -> None:
            self._request_futures.pop(msg_id, None)
            callback(future)

        super()._execute_handler(msg_id, handler, ended, args, kwargs)

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

    @lsp_method(types.WORKSPACE_DID_CHANGE_WORKSPACE_FOLDERS)
    def lsp_workspace__did_change_workspace_folders(
        self, params: types.DidChangeWorkspaceFoldersParams
    ) -> Generator[Any, Any, None]:
        """`workspace/didChangeWorkspaceFolders`."""
        yield from self._pass_on(types.WORKSPACE_DID_CHANGE_WORKSPACE_FOLDERS, params)

    @lsp_method(types.WINDOW_WORK_DONE_PROGRESS_CANCEL)
    def lsp_work_done_progress_cancel(self, params: types.WorkDoneProgressCancelParams) -> Generator[Any, Any, None]:
        """`window/workDoneProgress/cancel`."""
        yield from self._pass_on(types.WINDOW_WORK_DONE_PROGRESS_CANCEL, params)
