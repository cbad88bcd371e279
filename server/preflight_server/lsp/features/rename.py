"""`textDocument/prepareRename` and `textDocument/rename`."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, TypeVar

from lsprotocol import types
from preflight_analysis.queries.rename import RenameRefusedError, prepare, rename

from preflight_server.lsp.convert import Converter, TextChangedError
from preflight_server.lsp.edits import edits_of
from preflight_server.lsp.protocol import RefusedError
from preflight_server.lsp.query_contexts import converter_for, query_context
from preflight_server.lsp.session import View

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
        async def answer(view: View) -> tuple[types.WorkspaceEdit, Converter]:
            context = await query_context(view)
            offset = view.converter.positions(view.path).offset(params.position)

            def work() -> tuple[types.WorkspaceEdit, Converter]:
                if outdated := context.outdated():
                    raise TextChangedError(outdated)
                edits = rename(context, offset, params.new_name)
                converter = converter_for(ls, context, (edit.location for edit in edits))
                return converter.workspace_edit(edits), converter

            return await view.session.in_pool(lambda: _answered(work))

        return await edits_of(ls, params.text_document.uri, answer)
