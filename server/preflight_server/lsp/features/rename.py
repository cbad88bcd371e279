"""`textDocument/prepareRename` and `textDocument/rename`."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, TypeVar

from lsprotocol import types
from preflight_analysis.queries.query_context import QueryContext
from preflight_analysis.queries.rename import RenameRefusedError, prepare, rename

from preflight_server.lsp.protocol import RefusedError
from preflight_server.lsp.query_contexts import converter_for, query_context

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer

_T = TypeVar("_T")


def _answered(work: Callable[[], _T]) -> _T:
    """The answer, or the error that tells the user why there is none."""
    try:
        return work()
    except RenameRefusedError as refusal:
        raise RefusedError(str(refusal)) from refusal


def register(server: PreflightServer) -> None:
    """Register the handlers."""

    @server.feature(types.TEXT_DOCUMENT_PREPARE_RENAME)
    async def prepare_rename(
        ls: PreflightServer, params: types.PrepareRenameParams
    ) -> types.PrepareRenamePlaceholder | None:
        view = await ls.view_of(params.text_document.uri, python=True)
        if view is None:
            return None
        positions = view.converter.positions(view.path)
        offset, context = positions.offset(params.position), await query_context(view)
        found = await view.session.in_pool(lambda: _answered(lambda: prepare(context, offset)))
        return types.PrepareRenamePlaceholder(positions.range(found.span), found.name) if found else None

    @server.feature(types.TEXT_DOCUMENT_RENAME, types.RenameOptions(prepare_provider=True))
    async def rename_symbol(ls: PreflightServer, params: types.RenameParams) -> types.WorkspaceEdit | None:
        view = await ls.view_of(params.text_document.uri, python=True)
        if view is None:
            return None
        offset, context = view.converter.positions(view.path).offset(params.position), await query_context(view)

        def work() -> types.WorkspaceEdit:
            edits = rename(context, offset, params.new_name)
            if any(_typed_on(ls, context, path) for path in {edit.location.file for edit in edits}):
                raise RefusedError("The text changed meanwhile", types.LSPErrorCodes.ContentModified)
            converter = converter_for(ls, context, (edit.location for edit in edits))
            return converter.workspace_edit(edits, versioned=_versioned(ls.client_capabilities))

        return await view.session.in_pool(lambda: _answered(work))


def _typed_on(ls: PreflightServer, context: QueryContext, path: str) -> bool:
    opened, known = ls.texts.by_path(path), context.document(path)
    return opened is not None and (known is None or known.text != opened.text)


def _versioned(capabilities: types.ClientCapabilities) -> bool:
    edit = capabilities.workspace.workspace_edit if capabilities.workspace else None
    return bool(edit and edit.document_changes)
