"""`textDocument/semanticTokens/full` and `/range`: the substitutions inside of values."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from lsprotocol import types
from preflight_analysis.documents.span import Span
from preflight_analysis.queries.tokens import KINDS, Token
from preflight_analysis.queries.tokens import tokens as query

from preflight_server.lsp.positions import Positions

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer


def _encoded(tokens: Iterable[Token], positions: Positions) -> types.SemanticTokens:
    """Five numbers a token: lines and columns from the one before, length, type, modifiers."""
    data: list[int] = []
    line = column = 0
    for token in tokens:
        at = positions.range(token.span)
        down = at.start.line - line
        right = at.start.character - (0 if down else column)
        data += (down, right, at.end.character - at.start.character, KINDS.index(token.kind), 0)
        line, column = at.start.line, at.start.character
    return types.SemanticTokens(data)


async def _tokens(ls: PreflightServer, uri: str, range_: types.Range | None) -> types.SemanticTokens | None:
    view = await ls.view_of(uri)
    launch_file = view.analysis.launch_files.get(view.path) if view else None
    if view is None or launch_file is None:
        return None
    positions = view.converter.positions(view.path)
    within = Span(positions.offset(range_.start), positions.offset(range_.end)) if range_ is not None else None
    return await view.session.in_pool(lambda: _encoded(query(launch_file, within), positions))


def register(server: PreflightServer) -> None:
    """Register the handlers."""
    legend = types.SemanticTokensLegend(list(KINDS), [])

    @server.feature(types.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL, legend)
    async def full(ls: PreflightServer, params: types.SemanticTokensParams) -> types.SemanticTokens | None:
        return await _tokens(ls, params.text_document.uri, None)

    @server.feature(types.TEXT_DOCUMENT_SEMANTIC_TOKENS_RANGE, legend)
    async def range_(ls: PreflightServer, params: types.SemanticTokensRangeParams) -> types.SemanticTokens | None:
        return await _tokens(ls, params.text_document.uri, params.range)
