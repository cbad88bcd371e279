"""`textDocument/inlayHint`, and the request to ask again when values changed because of another file."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from lsprotocol import types
from preflight_analysis.documents.span import Span
from preflight_analysis.queries.hints import Hint
from preflight_analysis.queries.hints import hints as query

from preflight_server.lsp.positions import Positions
from preflight_server.lsp.text_store import OpenDocument

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer

_log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class _Told:
    """What the client shows of a document since it last asked."""

    document: OpenDocument
    within: Span
    hints: tuple[Hint, ...]


async def _hints(ls: PreflightServer, uri: str, within: Span | types.Range) -> tuple[_Told, Positions] | None:
    view = await ls.session.view(uri) if ls.session else None
    if ls.session is None or view is None:
        return None
    span = within if isinstance(within, Span) else view.converter.span(view.path, within)
    shown = ls.session.settings.inlay_hints
    found = await ls.session.in_pool(lambda: query(view.analyses, view.path, span)) if shown else ()
    return _Told(view.document, span, found), view.converter.positions(view.path)


def _converted(hints: Iterable[Hint], positions: Positions) -> list[types.InlayHint]:
    def tooltip(hint: Hint) -> types.MarkupContent | None:
        if hint.label == f"= {hint.values[0]}":
            return None
        lines = [f"- `{value}`" for value in hint.values] if len(hint.values) > 1 else [f"`{hint.values[0]}`"]
        return types.MarkupContent(types.MarkupKind.Markdown, "\n".join(lines))

    return [
        types.InlayHint(positions.position(hint.offset), hint.label, tooltip=tooltip(hint), padding_left=True)
        for hint in hints
    ]


class _Refresher:
    """Has the client ask again when what it shows is no longer so, as soon as the user pauses."""

    def __init__(self, server: PreflightServer) -> None:
        self._server = server
        self._told: dict[str, _Told] = {}
        self._task: asyncio.Task[None] | None = None
        self._again = False

    def told(self, uri: str, what: _Told) -> None:
        self._told[uri] = what

    def look(self) -> None:
        workspace = self._server.client_capabilities.workspace
        if workspace is None or workspace.inlay_hint is None or not workspace.inlay_hint.refresh_support:
            return
        self._again = True
        if self._told and (self._task is None or self._task.done()):
            self._task = self._server.spawn(self._compare())

    async def _compare(self) -> None:
        while self._again and self._server.session is not None:
            await self._server.session.quiet()
            self._again = False
            for uri, told in tuple(self._told.items()):
                if self._server.texts.get(uri) is not told.document:
                    del self._told[uri]  # closed, or edited: then the client asks by itself
                    continue
                now = await _hints(self._server, uri, told.within)
                if now is not None and self._told.get(uri) is told and now[0].hints != told.hints:
                    self._told.clear()
                    await self._refresh()
                    break

    async def _refresh(self) -> None:
        try:
            await self._server.workspace_inlay_hint_refresh_async(None)
        except Exception as error:
            _log.info("the client did not refresh its hints: %s", error)


def register(server: PreflightServer) -> None:
    """Register the handler."""
    refresher = _Refresher(server)
    server.after_analysis.append(refresher.look)

    @server.feature(types.TEXT_DOCUMENT_INLAY_HINT)
    async def inlay_hint(ls: PreflightServer, params: types.InlayHintParams) -> list[types.InlayHint] | None:
        found = await _hints(ls, params.text_document.uri, params.range)
        if found is None:
            return None
        told, positions = found
        refresher.told(params.text_document.uri, told)
        return _converted(told.hints, positions)
