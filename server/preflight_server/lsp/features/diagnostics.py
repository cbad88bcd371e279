"""`textDocument/diagnostic`, for clients that pull: see `publisher` for who gets what."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lsprotocol import types

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer


def register(server: PreflightServer) -> None:
    """Register the handler."""

    @server.feature(
        types.TEXT_DOCUMENT_DIAGNOSTIC,
        types.DiagnosticOptions(inter_file_dependencies=True, workspace_diagnostics=False, identifier="ros-preflight"),
    )
    async def diagnostic(
        ls: PreflightServer, params: types.DocumentDiagnosticParams
    ) -> types.RelatedFullDocumentDiagnosticReport:
        found: list[types.Diagnostic] = []
        document = ls.texts.get(params.text_document.uri)
        session = ls.session_of(params.text_document.uri)
        if session is not None and document is not None and document.path is not None:
            await session.analyses.published()
            found = ls.publisher.pull(document.path)
        return types.RelatedFullDocumentDiagnosticReport(found)
