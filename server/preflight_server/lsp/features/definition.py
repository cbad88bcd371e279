"""`textDocument/definition`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lsprotocol import types
from preflight_analysis.queries.definition import definition as query

from preflight_server.lsp.query_contexts import converter_for, query_context

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer


def register(server: PreflightServer) -> None:
    """Register the handler."""

    @server.feature(types.TEXT_DOCUMENT_DEFINITION)
    async def definition(
        ls: PreflightServer, params: types.DefinitionParams
    ) -> list[types.LocationLink] | list[types.Location] | None:
        view = await ls.view_of(params.text_document.uri, python=True)
        if view is None:
            return None
        offset = view.converter.positions(view.path).offset(params.position)
        context = await query_context(view)
        document = ls.client_capabilities.text_document
        links = document is not None and document.definition is not None and document.definition.link_support

        def work() -> list[types.LocationLink] | list[types.Location]:
            found = query(context, offset, view.findings)
            converter = converter_for(ls, context, [place for t in found for place in (t.location, t.source)])
            if links:
                return [converter.link(t.location, t.source) for t in found]
            return [converter.location(t.location) for t in found]

        return await view.session.in_pool(work)
