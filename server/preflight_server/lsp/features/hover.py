"""`textDocument/hover`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lsprotocol import types
from preflight_analysis.findings.markdown import code
from preflight_analysis.queries.hover import hover as query
from preflight_analysis.queries.query_context import QueryContext

from preflight_server.lsp.markup import markup
from preflight_server.lsp.query_contexts import query_context

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer


def _content(ls: PreflightServer, markdown: str) -> types.MarkupContent:
    document = ls.client_capabilities.text_document
    return markup(markdown, document.hover.content_format if document and document.hover else None)


def _title(context: QueryContext) -> str:
    root = context.analyses[0].launch
    return " ".join((context.shown(root.path), *(f"{name}:={value}" for name, value in root.args)))


def register(server: PreflightServer) -> None:
    """Register the handler."""

    @server.feature(types.TEXT_DOCUMENT_HOVER)
    async def hover(ls: PreflightServer, params: types.HoverParams) -> types.Hover | None:
        ls.looked_at(params.text_document.uri)
        view = await ls.view_of(params.text_document.uri, python=True)
        if view is None:
            return None
        positions = view.converter.positions(view.path)
        offset = positions.offset(params.position)
        context = await query_context(view)
        roots = len(view.session.choice.of(view.path))
        unseen = max(0, roots - len(view.analyses))
        found = await view.session.in_pool(lambda: query(context.analyses, view.path, offset, unseen, context))
        if found is None:
            return None
        # Where there are several it is said which one the names are of.
        of_root = f"\n\nLaunched by {code(_title(context))}, one of {roots} launches" if roots > 1 else ""
        return types.Hover(_content(ls, found.markdown + of_root), positions.range(found.span))
