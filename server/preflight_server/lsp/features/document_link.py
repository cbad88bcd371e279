"""`textDocument/documentLink`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lsprotocol import types
from preflight_analysis.queries.links import links as query

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer


def register(server: PreflightServer) -> None:
    """Register the handler."""

    @server.feature(types.TEXT_DOCUMENT_DOCUMENT_LINK)
    async def document_link(ls: PreflightServer, params: types.DocumentLinkParams) -> list[types.DocumentLink] | None:
        view = await ls.view_of(params.text_document.uri, python=True)
        if view is None:
            return None
        found = await view.session.in_pool(lambda: query(view.analysis, view.path))
        positions = view.converter.positions(view.path)
        return [
            types.DocumentLink(positions.range(link.span), target=view.converter.uri(link.path), tooltip=link.path)
            for link in found
        ]
