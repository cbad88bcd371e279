"""`textDocument/inlayHint`, and the request to ask again when values changed because of another file."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from lsprotocol import types
from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Span
from preflight_analysis.findings.markdown import code, escaped
from preflight_analysis.queries.hints import Hint
from preflight_analysis.queries.hints import hints as query

from preflight_server.lsp.positions import Positions
from preflight_server.lsp.refresher import Refresher
from preflight_server.lsp.text_store import OpenDocument

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer


@dataclass(frozen=True, slots=True)
class _Hints:
    """What a client was told of a part of a document."""

    document: OpenDocument
    within: Span
    hints: tuple[Hint, ...]


async def _hints(ls: PreflightServer, uri: str, within: Span | types.Range) -> tuple[_Hints, Positions] | None:
    view = await ls.view_of(uri, python=True)
    if view is None:
        return None
    span = within if isinstance(within, Span) else view.converter.span(view.path, within)
    shown = view.session.settings.inlay_hints
    found = await view.session.in_pool(lambda: query(view.analyses, view.path, span)) if shown else ()
    return _Hints(view.document, span, found), view.converter.positions(view.path)


def _converted(hints: Iterable[Hint], positions: Positions) -> list[types.InlayHint]:
    def tooltip(hint: Hint) -> types.MarkupContent | None:
        if hint.note:
            return types.MarkupContent(types.MarkupKind.Markdown, escaped(hint.note))
        if hint.label == f"= {hint.values[0]}":
            return None
        lines = [f"- {code(value)}" for value in hint.values] if len(hint.values) > 1 else [code(hint.values[0])]
        return types.MarkupContent(types.MarkupKind.Markdown, "\n".join(lines))

    return [
        types.InlayHint(positions.position(hint.offset), hint.label, tooltip=tooltip(hint), padding_left=True)
        for hint in hints
    ]


def register(server: PreflightServer) -> None:
    """Register the handler."""

    def supported() -> bool:
        workspace = server.client_capabilities.workspace
        return bool(workspace and workspace.inlay_hint and workspace.inlay_hint.refresh_support)

    refresher = Refresher(server, lambda: server.workspace_inlay_hint_refresh_async(None), supported)

    @server.feature(types.TEXT_DOCUMENT_INLAY_HINT)
    async def inlay_hint(ls: PreflightServer, params: types.InlayHintParams) -> list[types.InlayHint] | None:
        asked = refresher.looks
        found = await _hints(ls, params.text_document.uri, params.range)
        if found is None:
            return None
        hints, positions = found
        uri, within = params.text_document.uri, hints.within

        async def again() -> object:
            now = await _hints(ls, uri, within)
            return now[0].hints if now else None

        refresher.answered(hints.document, hints.hints, again, asked)
        return _converted(hints.hints, positions)
