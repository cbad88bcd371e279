"""`textDocument/documentSymbol`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lsprotocol import types
from preflight_analysis.queries.symbols import symbols as query

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer


def register(server: PreflightServer) -> None:
    """Register the handler."""

    @server.feature(types.TEXT_DOCUMENT_DOCUMENT_SYMBOL)
    async def document_symbol(
        ls: PreflightServer, params: types.DocumentSymbolParams
    ) -> list[types.DocumentSymbol] | list[types.SymbolInformation] | None:
        ls.looked_at(params.text_document.uri)
        view = await ls.view_of(params.text_document.uri, python=True)
        launch_file = view.analysis.launch_files.get(view.path) if view else None
        if view is None or launch_file is None:
            return None
        found = [view.converter.symbol(symbol, view.path) for symbol in query(launch_file)]
        document = ls.client_capabilities.text_document
        options = document.document_symbol if document else None
        if options is not None and options.hierarchical_document_symbol_support:
            return found
        return list(_flat(found, view.document.uri, None))


def _flat(symbols: list[types.DocumentSymbol], uri: str, container: str | None) -> list[types.SymbolInformation]:
    """The same for clients that know no nesting."""
    out: list[types.SymbolInformation] = []
    for symbol in symbols:
        location = types.Location(uri, symbol.range)
        out.append(types.SymbolInformation(location, symbol.name, symbol.kind, container_name=container))
        out += _flat(list(symbol.children or ()), uri, symbol.name)
    return out
