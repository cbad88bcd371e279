"""`textDocument/hover`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lsprotocol import types
from preflight_analysis.queries.hover import hover as query

from preflight_server.lsp.markup import markup
from preflight_server.lsp.query_contexts import query_context

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer


def _content(ls: PreflightServer, markdown: str) -> types.MarkupContent:
    document = ls.client_capabilities.text_document
    return markup(markdown, document.hover.content_format if document and document.hover else None)


def register(server: PreflightServer) -> None:
    """Register the handler."""

    @server.feature(types.TEXT_DOCUMENT_HOVER)
    async def hover(ls: PreflightServer, params: types.HoverParams) -> types.Hover | None:
        view = await ls.view_of(params.text_document.uri, python=True)
        if view is None:
            return None
        positions = view.converter.positions(view.path)
        offset = positions.offset(params.position)
        context = await query_context(view)
        unseen = max(0, len(view.session.choice.of(view.path)) - len(view.analyses))
        found = await view.session.in_pool(lambda: query(context.analyses, view.path, offset, unseen, context))
        return types.Hover(_content(ls, found.markdown), positions.range(found.span)) if found else None
