"""`textDocument/foldingRange`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lsprotocol import types
from preflight_analysis.queries.folding import folds as query

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer

_KINDS = {"comment": types.FoldingRangeKind.Comment, "region": types.FoldingRangeKind.Region}


def register(server: PreflightServer) -> None:
    """Register the handler."""

    @server.feature(types.TEXT_DOCUMENT_FOLDING_RANGE)
    async def folding_range(ls: PreflightServer, params: types.FoldingRangeParams) -> list[types.FoldingRange] | None:
        view = await ls.view_of(params.text_document.uri)
        launch_file = view.analysis.launch_files.get(view.path) if view else None
        if view is None or launch_file is None:
            return None
        found = await view.session.in_pool(lambda: query(launch_file))
        return [types.FoldingRange(fold.start, fold.end, kind=_KINDS.get(fold.kind)) for fold in found]
