"""`textDocument/prepareCallHierarchy` and the calls in both directions: launch files and their includes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from lsprotocol import types
from preflight_analysis.documents.span import Location
from preflight_analysis.queries.calls import Call, Item, incoming, items_at, outgoing
from preflight_analysis.queries.query_context import QueryContext

from preflight_server.lsp.convert import Converter
from preflight_server.lsp.query_contexts import converter_for, query_context, workspace_query_context
from preflight_server.lsp.text_store import to_path

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer


def _item(converter: Converter, item: Item) -> types.CallHierarchyItem:
    positions = converter.positions(item.path)
    return types.CallHierarchyItem(
        item.name,
        types.SymbolKind.File,
        converter.uri(item.path),
        positions.range(item.span),
        positions.range(item.head),
        detail=item.detail or None,
    )


async def _calls(
    ls: PreflightServer, uri: str, query: Callable[[QueryContext], Sequence[Call]]
) -> list[tuple[types.CallHierarchyItem, list[types.Range]]] | None:
    path, session = to_path(uri), ls.session_of(uri)
    if session is None or path is None:
        return None
    context = await workspace_query_context(session, path)

    def work() -> list[tuple[types.CallHierarchyItem, list[types.Range]]]:
        found = query(context)
        heads = (Location.of_file(call.item.path) for call in found)
        converter = converter_for(ls, context, (*heads, *(place for call in found for place in call.places)))
        return [(_item(converter, call.item), [converter.range(place) for place in call.places]) for call in found]

    return await session.in_pool(work)


def register(server: PreflightServer) -> None:
    """Register the handlers."""

    @server.feature(types.TEXT_DOCUMENT_PREPARE_CALL_HIERARCHY)
    async def prepare(
        ls: PreflightServer, params: types.CallHierarchyPrepareParams
    ) -> list[types.CallHierarchyItem] | None:
        view = await ls.view_of(params.text_document.uri)
        if view is None:
            return None
        offset, context = view.converter.positions(view.path).offset(params.position), await query_context(view)

        def work() -> list[types.CallHierarchyItem]:
            found = items_at(context, offset)
            converter = converter_for(ls, context, (Location.of_file(item.path) for item in found))
            return [_item(converter, item) for item in found]

        return await view.session.in_pool(work)

    @server.feature(types.CALL_HIERARCHY_INCOMING_CALLS)
    async def incoming_calls(
        ls: PreflightServer, params: types.CallHierarchyIncomingCallsParams
    ) -> list[types.CallHierarchyIncomingCall] | None:
        found = await _calls(ls, params.item.uri, incoming)
        return None if found is None else [types.CallHierarchyIncomingCall(item, ranges) for item, ranges in found]

    @server.feature(types.CALL_HIERARCHY_OUTGOING_CALLS)
    async def outgoing_calls(
        ls: PreflightServer, params: types.CallHierarchyOutgoingCallsParams
    ) -> list[types.CallHierarchyOutgoingCall] | None:
        found = await _calls(ls, params.item.uri, outgoing)
        return None if found is None else [types.CallHierarchyOutgoingCall(item, ranges) for item, ranges in found]
