"""`textDocument/references`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lsprotocol import types
from preflight_analysis.queries.references import references as query

from preflight_server.lsp.query_contexts import converter_for, query_context

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer


def register(server: PreflightServer) -> None:
    """Register the handler."""

    @server.feature(types.TEXT_DOCUMENT_REFERENCES)
    async def references(ls: PreflightServer, params: types.ReferenceParams) -> list[types.Location] | None:
        view = await ls.view_of(params.text_document.uri, python=True)
        if view is None:
            return None
        offset = view.converter.positions(view.path).offset(params.position)
        context = await query_context(view)

        def work() -> list[types.Location]:
            found = [r.location for r in query(context, offset) if params.context.include_declaration or not r.declares]
            converter = converter_for(ls, context, found)
            return [converter.location(place) for place in found]

        return await view.session.in_pool(work)
