"""`textDocument/didOpen`, `didChange`, `didSave`, `didClose`: the texts go to the store, the news to the sessions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lsprotocol import types

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer


def register(server: PreflightServer) -> None:
    """Register the handlers. They do not wait: the order of the messages is the order of the edits."""

    @server.feature(types.TEXT_DOCUMENT_DID_OPEN)
    def did_open(ls: PreflightServer, params: types.DidOpenTextDocumentParams) -> None:
        item = params.text_document
        document = ls.texts.open(item.uri, str(item.language_id), item.version, item.text)
        if ls.folders is not None:
            ls.folders.opened(document)

    @server.feature(types.TEXT_DOCUMENT_DID_CHANGE)
    def did_change(ls: PreflightServer, params: types.DidChangeTextDocumentParams) -> None:
        item = params.text_document
        document = ls.texts.change(item.uri, item.version, params.content_changes)
        if document is not None and ls.folders is not None:
            ls.folders.changed(document)

    @server.feature(types.TEXT_DOCUMENT_DID_SAVE)
    def did_save(ls: PreflightServer, params: types.DidSaveTextDocumentParams) -> None:
        document = ls.texts.get(params.text_document.uri)
        if document is not None and document.path is not None and ls.folders is not None:
            path = document.path
            ls.folders.each(lambda session: session.files_changed([path]))

    @server.feature(types.TEXT_DOCUMENT_DID_CLOSE)
    def did_close(ls: PreflightServer, params: types.DidCloseTextDocumentParams) -> None:
        document = ls.texts.close(params.text_document.uri)
        if document is not None and ls.folders is not None:
            ls.folders.closed(document)
