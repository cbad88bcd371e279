"""An editor in miniature: a client of the real server process, with capabilities of its own choice."""

from __future__ import annotations

import asyncio
import contextlib
import os
from collections.abc import AsyncIterator, Awaitable, Callable, Sequence
from pathlib import Path
from typing import Any, TypeVar, Union
from urllib.parse import unquote

from cattrs import Converter
from lsprotocol import types
from pygls.protocol import default_converter
from pytest_lsp import LanguageClient
from pytest_lsp.client import DEFAULT_CLIENT_FEATURES, register_lsp_features

from support.editor_harness import Harness
from support.waiting import PATIENCE, answered

ENCODINGS = ("utf-8", "utf-16", "utf-32")
T = TypeVar("T")


def capabilities(
    *,
    encoding: str | None = "utf-16",
    pull: bool = False,
    refresh: bool = True,
    dynamic: bool = True,
    snippets: bool = True,
    creates: bool = True,
    annotates: bool = False,
) -> types.ClientCapabilities:
    """What an editor of today can do; `pull` and `refresh` are the two halves of pulled diagnostics."""
    return types.ClientCapabilities(
        general=types.GeneralClientCapabilities(position_encodings=[encoding] if encoding else None),
        window=types.WindowClientCapabilities(
            work_done_progress=True, show_document=types.ShowDocumentClientCapabilities(support=True)
        ),
        workspace=types.WorkspaceClientCapabilities(
            apply_edit=True,
            workspace_edit=types.WorkspaceEditClientCapabilities(
                document_changes=True,
                resource_operations=[types.ResourceOperationKind.Create] if creates else [],
                change_annotation_support=types.ChangeAnnotationsSupportOptions() if annotates else None,
            ),
            configuration=True,
            did_change_configuration=types.DidChangeConfigurationClientCapabilities(dynamic_registration=dynamic),
            did_change_watched_files=types.DidChangeWatchedFilesClientCapabilities(dynamic_registration=dynamic),
            diagnostics=types.DiagnosticWorkspaceClientCapabilities(refresh_support=refresh),
            code_lens=types.CodeLensWorkspaceClientCapabilities(refresh_support=refresh),
            inlay_hint=types.InlayHintWorkspaceClientCapabilities(refresh_support=refresh),
        ),
        text_document=types.TextDocumentClientCapabilities(
            synchronization=types.TextDocumentSyncClientCapabilities(did_save=True),
            publish_diagnostics=types.PublishDiagnosticsClientCapabilities(
                related_information=True, version_support=True, code_description_support=True
            ),
            diagnostic=types.DiagnosticClientCapabilities() if pull else None,
            hover=types.HoverClientCapabilities(content_format=[types.MarkupKind.Markdown]),
            definition=types.DefinitionClientCapabilities(link_support=True),
            completion=types.CompletionClientCapabilities(
                completion_item=types.ClientCompletionItemOptions(
                    snippet_support=snippets, documentation_format=[types.MarkupKind.Markdown]
                ),
                context_support=True,
            ),
            signature_help=types.SignatureHelpClientCapabilities(
                signature_information=types.ClientSignatureInformationOptions(
                    documentation_format=[types.MarkupKind.Markdown],
                    parameter_information=types.ClientSignatureParameterInformationOptions(label_offset_support=True),
                    active_parameter_support=True,
                )
            ),
            document_link=types.DocumentLinkClientCapabilities(tooltip_support=True),
            folding_range=types.FoldingRangeClientCapabilities(line_folding_only=True),
            inlay_hint=types.InlayHintClientCapabilities(),
            document_symbol=types.DocumentSymbolClientCapabilities(hierarchical_document_symbol_support=True),
            code_action=types.CodeActionClientCapabilities(
                is_preferred_support=True,
                code_action_literal_support=types.ClientCodeActionLiteralOptions(
                    types.ClientCodeActionKindOptions([types.CodeActionKind.QuickFix, types.CodeActionKind.Refactor])
                ),
            ),
        ),
    )


def _converter() -> Converter:
    """lsprotocol's takes an action that has a command for a command."""
    converter = default_converter()

    def action(given: Any, _: Any) -> types.Command | types.CodeAction:
        kind = types.Command if isinstance(given.get("command"), str) else types.CodeAction
        return converter.structure(given, kind)

    converter.register_structure_hook(Union[types.Command, types.CodeAction], action)  # noqa: UP007 - as it is there
    return converter


class Editor:
    """Open documents and what the server said of them."""

    def __init__(self) -> None:
        self.client = LanguageClient(converter_factory=_converter)
        self.published: dict[str, types.PublishDiagnosticsParams] = {}
        self.history: list[types.PublishDiagnosticsParams] = []
        self.registered: list[str] = []
        self.refreshes = 0
        self.lens_refreshes = 0
        self.hint_refreshes = 0
        self.statuses: list[Any] = []
        """What `rosPreflight/status` told, for an editor with `"status": True` in its settings."""
        self.analysed = 0
        self.live: list[Any] = []
        """What `rosPreflight/live` told."""
        self.shown: list[str] = []
        """The documents that the server showed."""
        self.messages: list[str] = []
        """What the server told in a message."""
        self.progress: dict[types.ProgressToken, list[Any]] = {}
        self.on_progress: Callable[[types.ProgressToken, Any], None] = lambda token, value: None
        self.texts: dict[Path, str] = {}
        self.versions: dict[Path, int] = {}
        self.encoding = ""
        self.result: types.InitializeResult | None = None
        self._news = asyncio.Event()
        features = dict(DEFAULT_CLIENT_FEATURES)
        features[types.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS] = self._published()
        features[types.CLIENT_REGISTER_CAPABILITY] = self._registered()
        features[types.WORKSPACE_DIAGNOSTIC_REFRESH] = self._refreshed()
        features[types.WORKSPACE_INLAY_HINT_REFRESH] = self._hints_refreshed()
        features[types.WORKSPACE_CODE_LENS_REFRESH] = self._lenses_refreshed()
        features[types.WINDOW_SHOW_DOCUMENT] = self._showed()
        features[types.WINDOW_SHOW_MESSAGE] = self._messaged()
        features[types.PROGRESS] = self._progressed()
        features[types.WINDOW_WORK_DONE_PROGRESS_CREATE] = self._created()
        register_lsp_features(self.client, features)
        self.client.feature("rosPreflight/status")(self._told_status())
        self.client.feature("rosPreflight/analysed")(self._told_analysed())
        self.client.feature("rosPreflight/live")(self._told_live())

    # pygls takes no bound methods as handlers.
    def _published(self) -> Callable[..., None]:
        def handler(ls: LanguageClient, params: types.PublishDiagnosticsParams) -> None:
            self.published[params.uri] = params
            self.history.append(params)
            self._news.set()

        return handler

    def _registered(self) -> Callable[..., None]:
        def handler(ls: LanguageClient, params: types.RegistrationParams) -> None:
            self.registered += [registration.method for registration in params.registrations]
            self._news.set()

        return handler

    def _refreshed(self) -> Callable[..., None]:
        def handler(ls: LanguageClient, params: None) -> None:
            self.refreshes += 1
            self._news.set()

        return handler

    def _hints_refreshed(self) -> Callable[..., None]:
        def handler(ls: LanguageClient, params: None) -> None:
            self.hint_refreshes += 1
            self._news.set()

        return handler

    def _lenses_refreshed(self) -> Callable[..., None]:
        def handler(ls: LanguageClient, params: None) -> None:
            self.lens_refreshes += 1
            self._news.set()

        return handler

    def _told_status(self) -> Callable[..., None]:
        def handler(ls: LanguageClient, params: Any) -> None:
            self.statuses.append(params)
            self._news.set()

        return handler

    def _told_analysed(self) -> Callable[..., None]:
        def handler(ls: LanguageClient, params: Any) -> None:
            self.analysed += 1
            self._news.set()

        return handler

    def _told_live(self) -> Callable[..., None]:
        def handler(ls: LanguageClient, params: Any) -> None:
            self.live.append(params)
            self._news.set()

        return handler

    def _created(self) -> Callable[..., None]:
        def handler(ls: LanguageClient, params: types.WorkDoneProgressCreateParams) -> None:
            assert params.token not in self.progress, "a progress token was used twice"
            self.progress[params.token] = []

        return handler

    def _showed(self) -> Callable[..., types.ShowDocumentResult]:
        def handler(ls: LanguageClient, params: types.ShowDocumentParams) -> types.ShowDocumentResult:
            self.shown.append(params.uri)
            return types.ShowDocumentResult(success=True)

        return handler

    def _messaged(self) -> Callable[..., None]:
        def handler(ls: LanguageClient, params: types.ShowMessageParams) -> None:
            self.messages.append(params.message)
            self._news.set()

        return handler

    def _progressed(self) -> Callable[..., None]:
        def handler(ls: LanguageClient, params: types.ProgressParams) -> None:
            self.progress[params.token].append(params.value)
            self.on_progress(params.token, params.value)
            self._news.set()

        return handler

    def progress_of(self, title: str) -> dict[types.ProgressToken, list[Any]]:
        """The progress reports that have begun under a title."""
        return {t: values for t, values in self.progress.items() if values and values[0].get("title") == title}

    @property
    def runs(self) -> dict[types.ProgressToken, list[Any]]:
        """The progress of runs of nodes."""
        return self.progress_of("Running nodes in the sandbox")

    @property
    def pid(self) -> int:
        process = self.client._server
        assert process is not None
        return process.pid

    async def until(self, what: Callable[[], T | None], seconds: float = PATIENCE) -> T:
        """Wait until `what()` is something true; it is asked again at each message of the server."""
        deadline = asyncio.get_running_loop().time() + seconds
        while not (found := what()):
            left = deadline - asyncio.get_running_loop().time()
            if left <= 0:
                raise AssertionError(f"waited {seconds} s; last published: {self.summary()}")
            self._news.clear()
            with contextlib.suppress(asyncio.TimeoutError):
                await asyncio.wait_for(self._news.wait(), min(left, 0.2))
        return found

    async def once(self, ask: Callable[[], Awaitable[T]], is_so: Callable[[T], bool], seconds: float = PATIENCE) -> T:
        """Ask again and again until the answer is as expected."""
        return await answered(ask, is_so, seconds)

    def summary(self) -> dict[str, list[str]]:
        return {uri: [f"{d.code} {d.message}" for d in p.diagnostics] for uri, p in self.published.items()}

    def diagnostics(self, path: Path) -> list[types.Diagnostic] | None:
        """The published diagnostics of a file; None while they are of another version than the editor's."""
        found = self.published.get(path.as_uri())
        if found is None or (path in self.versions and found.version != self.versions[path]):
            return None
        return list(found.diagnostics)

    def rules(self, path: Path) -> list[str] | None:
        found = self.diagnostics(path)
        return None if found is None else sorted(str(d.code) for d in found)

    async def having(self, path: Path, rule: str, seconds: float = PATIENCE, *, saying: str = "") -> types.Diagnostic:
        """The diagnostic of that rule that says this, as soon as it is there."""

        def found() -> types.Diagnostic | None:
            return next((d for d in self.diagnostics(path) or () if d.code == rule and saying in d.message), None)

        return await self.until(found, seconds)

    async def misspelling(self, path: Path) -> types.Diagnostic:
        """What is said of the misspelt topic of the demo once both of its nodes were run: while one still runs, there
        is but a hint that knows no other name."""
        return await self.having(path, "TOP001", saying="did you mean")

    async def without(self, path: Path, rule: str, seconds: float = PATIENCE) -> None:
        """Wait until the rule is silent on the file's present version."""
        await self.until(lambda: (found := self.rules(path)) is not None and rule not in found, seconds)

    def open(self, path: Path, text: str | None = None, language: str = "roslaunch") -> str:
        text = path.read_text() if text is None else text
        self.texts[path], self.versions[path] = text, 1
        item = types.TextDocumentItem(path.as_uri(), language, 1, text)
        self.client.text_document_did_open(types.DidOpenTextDocumentParams(item))
        return text

    def change(self, path: Path, text: str) -> None:
        """The whole text anew."""
        self._changed(path, text, types.TextDocumentContentChangeWholeDocument(text))

    def replace(self, path: Path, start: int, end: int, new: str) -> None:
        """Replace the code points from `start` to `end`, sent as an incremental change."""
        old = self.texts[path]
        range_ = types.Range(position(old, start, self.encoding), position(old, end, self.encoding))
        self._changed(path, old[:start] + new + old[end:], types.TextDocumentContentChangePartial(range_, new))

    def _changed(self, path: Path, text: str, change: types.TextDocumentContentChangeEvent) -> None:
        self.texts[path] = text
        self.versions[path] += 1
        item = types.VersionedTextDocumentIdentifier(self.versions[path], path.as_uri())
        self.client.text_document_did_change(types.DidChangeTextDocumentParams(item, [change]))

    def save(self, path: Path) -> None:
        path.write_text(self.texts[path])
        self.client.text_document_did_save(types.DidSaveTextDocumentParams(self.id(path)))

    def close(self, path: Path) -> None:
        del self.texts[path], self.versions[path]
        self.client.text_document_did_close(types.DidCloseTextDocumentParams(self.id(path)))

    def watched(self, *paths: Path, kind: types.FileChangeType = types.FileChangeType.Changed) -> None:
        events = [types.FileEvent(path.as_uri(), kind) for path in paths]
        self.client.workspace_did_change_watched_files(types.DidChangeWatchedFilesParams(events))

    def folders_changed(self, *, added: Sequence[Path] = (), removed: Sequence[Path] = ()) -> None:
        event = types.WorkspaceFoldersChangeEvent(_folders(added), _folders(removed))
        self.client.workspace_did_change_workspace_folders(types.DidChangeWorkspaceFoldersParams(event))

    def trust(self, trusted: bool = True) -> None:
        self.client.protocol.notify("rosPreflight/workspaceTrust", {"trusted": trusted})

    async def doctor(self) -> str:
        answer = await self.client.protocol.send_request_async("rosPreflight/doctor", {})
        return str(answer.text)

    def id(self, path: Path) -> types.TextDocumentIdentifier:
        return types.TextDocumentIdentifier(path.as_uri())

    def at(self, path: Path, needle: str, after: int = 0) -> types.Position:
        """The position of the `needle`'s first character plus `after`."""
        return position(self.texts[path], self.texts[path].index(needle) + after, self.encoding)

    def covered(self, path: Path, range_: types.Range) -> str:
        """The text that a range of the server's covers."""
        text = self.texts[path]
        return text[offset(text, range_.start, self.encoding) : offset(text, range_.end, self.encoding)]

    async def hover(self, path: Path, where: types.Position) -> types.Hover | None:
        return await self.client.text_document_hover_async(types.HoverParams(self.id(path), where))

    async def definition(self, path: Path, where: types.Position) -> list[types.LocationLink]:
        found = await self.client.text_document_definition_async(types.DefinitionParams(self.id(path), where))
        assert found is None or isinstance(found, Sequence)
        return [each for each in found or () if isinstance(each, types.LocationLink)]

    async def references(self, path: Path, where: types.Position, *, declaration: bool = True) -> list[types.Location]:
        context = types.ReferenceContext(declaration)
        params = types.ReferenceParams(context, self.id(path), where)
        return list(await self.client.text_document_references_async(params) or ())

    async def prepare_rename(self, path: Path, where: types.Position) -> types.PrepareRenamePlaceholder | None:
        params = types.PrepareRenameParams(self.id(path), where)
        found = await self.client.text_document_prepare_rename_async(params)
        assert found is None or isinstance(found, types.PrepareRenamePlaceholder)
        return found

    async def rename(self, path: Path, where: types.Position, new: str) -> types.WorkspaceEdit | None:
        return await self.client.text_document_rename_async(types.RenameParams(self.id(path), where, new))

    async def hierarchy(self, path: Path, where: types.Position) -> list[types.CallHierarchyItem]:
        params = types.CallHierarchyPrepareParams(self.id(path), where)
        return list(await self.client.text_document_prepare_call_hierarchy_async(params) or ())

    async def lenses(self, path: Path) -> list[types.CodeLens]:
        return list(await self.client.text_document_code_lens_async(types.CodeLensParams(self.id(path))) or ())

    async def symbols(self, path: Path) -> list[types.DocumentSymbol]:
        params = types.DocumentSymbolParams(self.id(path))
        found = await self.client.text_document_document_symbol_async(params)
        return [each for each in found or () if isinstance(each, types.DocumentSymbol)]

    async def actions(self, path: Path, range_: types.Range, only: Sequence[str] = ()) -> list[types.CodeAction]:
        here = [d for d in self.diagnostics(path) or () if d.range == range_]
        context = types.CodeActionContext(here, only=list(only) or None)
        params = types.CodeActionParams(self.id(path), range_, context)
        found = await self.client.text_document_code_action_async(params)
        return [each for each in found or () if isinstance(each, types.CodeAction)]

    async def fixes(self, path: Path, range_: types.Range) -> list[types.CodeAction]:
        """The quick fixes that edit the file itself or another source, without ways to suppress or explain."""
        found = await self.actions(path, range_, ["quickfix"])
        return [each for each in found if not each.title.startswith(("Suppress ", "Explain ", "Show ", "Fix all "))]

    async def execute(self, command: types.Command | None) -> Any:
        """Have the server execute a command of an action."""
        assert command is not None
        params = types.ExecuteCommandParams(command.command, command.arguments)
        return await self.client.workspace_execute_command_async(params)

    async def completion(
        self, path: Path, where: types.Position, trigger: str | None = None
    ) -> list[types.CompletionItem]:
        """The proposals; the server says that they are all."""
        kind = types.CompletionTriggerKind.TriggerCharacter if trigger else types.CompletionTriggerKind.Invoked
        context = types.CompletionContext(kind, trigger)
        params = types.CompletionParams(self.id(path), where, context)
        found = await self.client.text_document_completion_async(params)
        assert found is None or isinstance(found, types.CompletionList)
        assert found is None or not found.is_incomplete
        return list(found.items) if found else []

    def accept(self, path: Path, item: types.CompletionItem) -> str:
        """Insert a proposal as an editor does, tab stops as they are written, and return the line that it leads to."""
        edit = item.text_edit
        assert isinstance(edit, types.TextEdit)
        text = self.texts[path]
        start, end = (offset(text, where, self.encoding) for where in (edit.range.start, edit.range.end))
        self.replace(path, start, end, edit.new_text)
        return self.texts[path].split("\n")[edit.range.start.line]

    async def signature(self, path: Path, where: types.Position) -> types.SignatureHelp | None:
        return await self.client.text_document_signature_help_async(types.SignatureHelpParams(self.id(path), where))

    async def links(self, path: Path) -> list[types.DocumentLink]:
        return list(await self.client.text_document_document_link_async(types.DocumentLinkParams(self.id(path))) or ())

    async def folds(self, path: Path) -> list[types.FoldingRange]:
        params = types.FoldingRangeParams(self.id(path))
        return list(await self.client.text_document_folding_range_async(params) or ())

    async def hints(self, path: Path, range_: types.Range | None = None) -> list[types.InlayHint]:
        """Those of a range, or of the whole file."""
        end = position(self.texts[path], len(self.texts[path]), self.encoding)
        params = types.InlayHintParams(self.id(path), range_ or types.Range(types.Position(0, 0), end))
        return list(await self.client.text_document_inlay_hint_async(params) or ())

    async def tokens(self, path: Path, range_: types.Range | None = None) -> list[tuple[str, str]]:
        """Text and type of each semantic token of a range, or of the whole file."""
        assert self.result is not None
        options = self.result.capabilities.semantic_tokens_provider
        assert options is not None
        if range_ is None:
            params = types.SemanticTokensParams(self.id(path))
            found = await self.client.text_document_semantic_tokens_full_async(params)
        else:
            of_range = types.SemanticTokensRangeParams(self.id(path), range_)
            found = await self.client.text_document_semantic_tokens_range_async(of_range)
        data = list(found.data) if found else []
        assert len(data) % 5 == 0
        line = column = 0
        tokens: list[tuple[str, str]] = []
        for at in range(0, len(data), 5):
            down, right, length, kind, modifiers = data[at : at + 5]
            assert modifiers == 0
            line, column = line + down, right if down else column + right
            span = types.Range(types.Position(line, column), types.Position(line, column + length))
            tokens.append((self.covered(path, span), options.legend.token_types[kind]))
        return tokens

    async def pull(self, path: Path) -> list[types.Diagnostic]:
        params = types.DocumentDiagnosticParams(self.id(path))
        report = await self.client.text_document_diagnostic_async(params)
        assert isinstance(report, types.RelatedFullDocumentDiagnosticReport)
        return list(report.items)

    def apply(self, edit: types.WorkspaceEdit | None) -> None:
        """Apply an edit as an editor does: from the back, opening what is not open, and tell the server."""
        assert edit is not None
        changes: dict[str, list[types.TextEdit | types.AnnotatedTextEdit]] = {}
        changes.update({uri: list(edits) for uri, edits in (edit.changes or {}).items()})
        for change in edit.document_changes or ():
            if isinstance(change, types.CreateFile):
                from_uri(change.uri).touch(exist_ok=False)
                continue
            assert isinstance(change, types.TextDocumentEdit)
            path = from_uri(change.text_document.uri)
            assert change.text_document.version == self.versions.get(path)
            changes[change.text_document.uri] = [
                each for each in change.edits if isinstance(each, types.TextEdit | types.AnnotatedTextEdit)
            ]
        assert changes
        for uri, edits in changes.items():
            path = from_uri(uri)
            if path not in self.texts:
                self.open(path, language="yaml" if path.suffix in (".yaml", ".yml") else "roslaunch")
            for each in sorted(edits, key=lambda e: (e.range.start.line, e.range.start.character), reverse=True):
                text = self.texts[path]
                start = offset(text, each.range.start, self.encoding)
                end = offset(text, each.range.end, self.encoding)
                self.replace(path, start, end, each.new_text)

    async def everything(self, path: Path, where: types.Position) -> None:
        """All that can be asked of a place; any error of the server is one of the test."""
        await asyncio.gather(
            self.hover(path, where),
            self.definition(path, where),
            self.references(path, where),
            self.completion(path, where),
            self.signature(path, where),
            self.symbols(path),
            self.folds(path),
            self.links(path),
            self.hints(path),
            self.tokens(path),
            self.lenses(path),
            self.actions(path, types.Range(where, where)),
            self.hierarchy(path, where),
            self.client.workspace_symbol_async(types.WorkspaceSymbolParams("t")),
        )


@contextlib.asynccontextmanager
async def editing(
    harness: Harness,
    *,
    trusted: bool = False,
    client: types.ClientCapabilities | None = None,
    settings: dict[str, Any] | None = None,
    environment: dict[str, str] | None = None,
    folder: Path | None = None,
    folders: Sequence[Path] = (),
    without_folder: bool = False,
) -> AsyncIterator[Editor]:
    """The server, started as editors start it, on the workspace of the harness (or on no folder at all); shut down as
    editors do it at the end."""
    editor = Editor()
    client = client or capabilities()
    offered = (client.general.position_encodings if client.general else None) or ["utf-16"]
    editor.encoding = str(getattr(offered[0], "value", offered[0]))
    if settings is not None:
        editor.client.set_configuration({"rosPreflight": settings})
    await editor.client.start_io(
        str(harness.server), "lsp", "--stdio", env={**harness.environment, **(environment or {})}
    )
    opened = [] if without_folder else list(folders) or [folder or harness.workspace]
    try:
        editor.result = await editor.client.initialize_session(
            types.InitializeParams(
                capabilities=client,
                process_id=os.getpid(),
                root_uri=opened[0].as_uri() if opened else None,
                workspace_folders=_folders(opened) or None,
                initialization_options={"workspaceTrusted": trusted, **(settings or {})},
            )
        )
        yield editor
        await asyncio.wait_for(editor.client.shutdown_session(), PATIENCE)
    finally:
        server = editor.client._server
        if server is not None and server.returncode is None:
            server.kill()
        await editor.client.stop()


def _folders(paths: Sequence[Path]) -> list[types.WorkspaceFolder]:
    return [types.WorkspaceFolder(path.as_uri(), path.name) for path in paths]


def from_uri(uri: str) -> Path:
    return Path(unquote(uri.removeprefix("file://")))


# The editor's side of positions, written independently of the server's: on encoded bytes.


def position(text: str, at: int, encoding: str) -> types.Position:
    lines = _lines(text[:at])
    # A cursor between \r and \n is not reachable in an editor; the callers never ask for it.
    return types.Position(len(lines) - 1, _length(lines[-1], encoding))


def offset(text: str, where: types.Position, encoding: str) -> int:
    lines = _lines(text)
    start = 0
    for line in lines[: where.line]:
        start += len(line)
    line = lines[where.line]
    return start + next(n for n in range(len(line) + 1) if _length(line[:n], encoding) == where.character)


def _lines(text: str) -> list[str]:
    lines, line = [], ""
    for index, char in enumerate(text):
        line += char
        if char == "\n" or (char == "\r" and text[index + 1 : index + 2] != "\n"):
            lines.append(line)
            line = ""
    return [*lines, line]


def _length(text: str, encoding: str) -> int:
    codec, unit = {"utf-8": ("utf-8", 1), "utf-16": ("utf-16-le", 2), "utf-32": ("utf-32-le", 4)}[encoding]
    return len(text.encode(codec)) // unit
