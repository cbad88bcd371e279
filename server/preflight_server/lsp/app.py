"""The server object: what the client can do, the open texts and the sessions; handlers are in `features/`."""

from __future__ import annotations

import asyncio
import gc
import importlib
import logging
import os
import pkgutil
import sys
from collections.abc import Callable, Mapping
from typing import Any, BinaryIO, cast

from lsprotocol import types
from preflight_analysis import __version__
from preflight_analysis.findings.failure import Failure, error_line
from pygls.exceptions import JsonRpcException, JsonRpcInvalidRequest, JsonRpcParseError
from pygls.lsp.server import LanguageServer

from preflight_server.lsp import features
from preflight_server.lsp.convert import EditSupport
from preflight_server.lsp.folders import Folders
from preflight_server.lsp.frames import BadFrameError, Frames
from preflight_server.lsp.live import LiveWatch
from preflight_server.lsp.protocol import PreflightProtocol, RefusedError, is_failure
from preflight_server.lsp.publisher import Publisher
from preflight_server.lsp.rule_pages import RulePages
from preflight_server.lsp.session import Session, View
from preflight_server.lsp.settings import Settings, as_mapping
from preflight_server.lsp.status import Status
from preflight_server.lsp.text_store import TextStore, to_path

_log = logging.getLogger(__name__)
FAILED = 2
_SWITCH = 0.001
"""Seconds after which a thread lets go of the interpreter where another wants it: each answer takes several turns, of
which it waits for so long while something is analysed."""


class PreflightServer(LanguageServer):
    """One client's server. `folders` are there once the client has initialised it."""

    protocol: PreflightProtocol

    def __init__(self) -> None:
        super().__init__(
            "ros-preflight",
            __version__,
            text_document_sync_kind=types.TextDocumentSyncKind.Incremental,
            protocol_cls=PreflightProtocol,
        )
        self.texts = TextStore()
        self.folders: Folders | None = None
        self.after_analysis: list[Callable[[], None]] = []
        """Called on the event loop whenever analyses were replaced by newer ones."""
        self.when_runs_change: list[Callable[[], None]] = []
        """Called on the event loop when nodes start to run, and when all of them have ended."""
        self.status = Status(self)
        self.publisher = Publisher(self)
        self.live = LiveWatch(self)
        self.rule_pages = RulePages()
        self.turn_to_run = asyncio.Lock()
        """Held while the nodes of one folder are run: the machine has no more cores for several folders."""
        self.client_commands: frozenset[str] = frozenset()
        """Our commands that the client carries out itself."""
        self._reported_failures: set[str] = set()
        """What the user knows to have failed."""
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
        paths = [path for uri in folders if (path := to_path(uri)) is not None]
        self.folders = Folders(
            self,
            paths,
            Settings.read(options),
            trusted=options.get("workspaceTrusted") is True,
            environments=_environments(options),
        )

    @property
    def shown_pages(self) -> RulePages | None:
        """The pages of rules, for a client that follows the code of a diagnostic; None for any other."""
        document = self.client_capabilities.text_document
        ways = (document.publish_diagnostics, document.diagnostic) if document is not None else ()
        return self.rule_pages if any(way is not None and way.code_description_support for way in ways) else None

    @property
    def edit_support(self) -> EditSupport:
        """What the client knows of edits."""
        return EditSupport.of(self.client_capabilities)

    @property
    def sessions(self) -> tuple[Session, ...]:
        """Those of all workspace folders; none before the client has initialised the server."""
        return tuple(self.folders or ())

    def session_of(self, uri: str) -> Session | None:
        """The session that a document belongs to."""
        return self.folders.of(to_path(uri)) if self.folders is not None else None

    async def view_of(self, uri: str, *, python: bool = False) -> View | None:
        """An open launch file as it is now: see `Session.view`."""
        session = self.session_of(uri)
        return await session.view(uri, python=python) if session is not None else None

    def looked_at(self, uri: str) -> None:
        """The user looks at a document: no client says so, but each asks for some things of that one alone."""
        if (session := self.session_of(uri)) is not None:
            session.looked_at(uri)

    def refuse_frame(self, why: str) -> None:
        """Answer a message that cannot be read, from whichever thread reads."""
        _log.warning("a message of the client: %s", why)
        self.protocol.refuse_message(None, JsonRpcParseError(why))

    def report_server_error(self, error: Exception, source: Any) -> None:
        """A handler broke: that belongs in the log, not in a message box for each keystroke."""
        if source is JsonRpcException and not isinstance(error, JsonRpcException):
            is_json = not isinstance(error, ValueError | RecursionError)
            answer = JsonRpcInvalidRequest("not a message") if is_json else JsonRpcParseError(f"not JSON: {error}")
            self.protocol.refuse_message(None, answer)
        if not isinstance(error, RefusedError):
            _log.error("%s: %s", getattr(source, "__name__", source), error)

    def report_failure(self, failure: Failure) -> None:
        """An error of ours costs findings: say so once for each rule, whatever the file. Call it on the event loop."""
        self._report_once(failure.rule or "analysis", failure.message(failure.file))

    def report_internal_error(self, what: str, error: BaseException) -> None:
        """Something else of ours failed, which the user would not see otherwise: say so once. On the event loop."""
        self._report_once(what, f"{what}: {error_line(error)}. Please report this.")

    def _report_once(self, what: str, message: str) -> None:
        if what not in self._reported_failures:
            self._reported_failures.add(what)
            text = f"ros-preflight: {message} The log has the traceback."
            self.window_show_message(types.ShowMessageParams(types.MessageType.Warning, text))

    def spawn(self, coroutine: Any) -> asyncio.Task[Any]:
        """Run a coroutine beside the handlers; what it raises goes to the log."""
        task = asyncio.get_running_loop().create_task(coroutine)
        self._background.add(task)
        task.add_done_callback(self._finished)
        return task

    def _finished(self, task: asyncio.Task[Any]) -> None:
        self._background.discard(task)
        if not task.cancelled() and (error := task.exception()) is not None:
            _log.error("a background task failed", exc_info=error)
            if isinstance(error, Exception):
                self.report_internal_error("a background task failed", error)


def _environments(options: Mapping[str, Any]) -> dict[str, Mapping[str, str]]:
    """`environments` of the initialisation options, `{folder URI: {name: value}}`: what a client sourced for a folder,
    in place of the server's own environment."""
    given = as_mapping(options.get("environments"))
    return {
        path: {str(name): str(value) for name, value in as_mapping(variables).items()}
        for uri, variables in given.items()
        if (path := to_path(uri)) is not None
    }


def serve() -> int:
    """Serve standard input and output until the client leaves. The exit code is LSP's: 1 without `shutdown` first, and
    2 where the client's messages cannot be read any further.

    Messages go to a descriptor of their own and standard output becomes standard error, so that neither a stray
    `print` nor an inherited PYTHONUNBUFFERED can break the stream.
    """
    # Documents and trees are large, short-lived and without cycles: at the usual thresholds a third of the time after
    # a keystroke would go into looking for garbage that is not there. All threads stand still meanwhile, so the two
    # generations that are looked at often are small: 20 ms for both.
    gc.set_threshold(10_000, 2, 10_000)
    sys.setswitchinterval(_SWITCH)
    logging.basicConfig(level=logging.WARNING, stream=sys.stderr, format="%(levelname)s %(name)s: %(message)s")
    # At INFO pygls logs whole documents.
    logging.getLogger("pygls").setLevel(logging.ERROR)
    logging.getLogger("pygls.protocol.json_rpc").addFilter(is_failure)
    server = PreflightServer()
    with open(os.dup(1), "wb") as out:
        os.dup2(2, 1)
        try:
            server.start_io(cast("BinaryIO", Frames(sys.stdin.buffer, server.refuse_frame)), out)
        except BadFrameError as error:
            _log.error("the language server ends: %s", error)
            return FAILED
        finally:
            if server.folders is not None:
                server.folders.close()
    gc.freeze()  # or the last collections look through all of it for seconds: it goes with the process anyway
    return 0 if server.protocol.was_shut_down else 1
