"""`textDocument/definition`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lsprotocol import types
from preflight_analysis.queries.definition import definition as query

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer


def register(server: PreflightServer) -> None:
    """Register the handler."""

    @server.feature(types.TEXT_DOCUMENT_DEFINITION)
    async def definition(
        ls: PreflightServer, params: types.DefinitionParams
    ) -> list[types.LocationLink] | list[types.Location] | None:
        view = await ls.session.view(params.text_document.uri) if ls.session else None
        if ls.session is None or view is None:
            return None
        offset = view.converter.positions(view.path).offset(params.position)
        targets = await ls.session.in_pool(lambda: query(view.analysis, view.path, offset, view.findings))
        document = ls.client_capabilities.text_document
        if document is not None and document.definition is not None and document.definition.link_support:
            return await ls.session.in_pool(lambda: [view.converter.link(t.location, t.source) for t in targets])
        return await ls.session.in_pool(lambda: [view.converter.location(t.location) for t in targets])
