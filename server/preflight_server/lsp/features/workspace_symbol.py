"""`workspace/symbol`: nodes, launch files, executables and topics by name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lsprotocol import types
from preflight_analysis.queries.workspace_symbols import executables
from preflight_analysis.queries.workspace_symbols import workspace_symbols as query

from preflight_server.lsp.query_contexts import converter_for, workspace_query_context

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer
    from preflight_server.lsp.session import Session

_KINDS = {
    "node": types.SymbolKind.Class,
    "launch": types.SymbolKind.File,
    "topic": types.SymbolKind.Event,
    "executable": types.SymbolKind.Function,
}


def register(server: PreflightServer) -> None:
    """Register the handler."""

    @server.feature(types.WORKSPACE_SYMBOL)
    async def workspace_symbol(
        ls: PreflightServer, params: types.WorkspaceSymbolParams
    ) -> list[types.SymbolInformation] | None:
        symbols = [symbol for session in ls.sessions for symbol in await of_folder(ls, session, params.query)]
        known: set[tuple[str, types.SymbolKind, str, int]] = set()
        first = []
        for symbol in symbols:  # a folder within another one has its symbols once
            where = symbol.location
            key = (symbol.name, symbol.kind, where.uri, where.range.start.line)
            if key not in known:
                known.add(key)
                first.append(symbol)
        return first

    async def of_folder(ls: PreflightServer, session: Session, query_: str) -> list[types.SymbolInformation]:
        context = await workspace_query_context(session)

        def work() -> list[types.SymbolInformation]:
            found = query(context.current, context.analyses, session.folder, query_, executables(context))
            converter = converter_for(ls, context, (symbol.location for symbol in found))
            return [
                types.SymbolInformation(
                    converter.location(symbol.location),
                    symbol.name,
                    _KINDS[symbol.kind],
                    container_name=symbol.container or None,
                )
                for symbol in found
            ]

        return await session.in_pool(work)
