"""`textDocument/hover`."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from lsprotocol import types
from preflight_analysis.queries.hover import hover as query

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer

_LINK = re.compile(r"\[([^\]]*)\]\([^)]*\)")
_MARKS = re.compile(r"\*\*|`")


def _content(ls: PreflightServer, markdown: str) -> types.MarkupContent:
    """In the first format of the client's that we have; links mean nothing in plain text."""
    document = ls.client_capabilities.text_document
    formats = (document.hover.content_format if document and document.hover else None) or [types.MarkupKind.Markdown]
    if formats[0] == types.MarkupKind.PlainText:
        return types.MarkupContent(types.MarkupKind.PlainText, _MARKS.sub("", _LINK.sub(r"\1", markdown)))
    return types.MarkupContent(types.MarkupKind.Markdown, markdown)


def register(server: PreflightServer) -> None:
    """Register the handler."""

    @server.feature(types.TEXT_DOCUMENT_HOVER)
    async def hover(ls: PreflightServer, params: types.HoverParams) -> types.Hover | None:
        view = await ls.session.view(params.text_document.uri) if ls.session else None
        if ls.session is None or view is None:
            return None
        positions = view.converter.positions(view.path)
        offset = positions.offset(params.position)
        found = await ls.session.in_pool(lambda: query(view.analysis, view.path, offset))
        return types.Hover(_content(ls, found.markdown), positions.range(found.span)) if found else None
