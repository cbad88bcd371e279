"""The context of queries that look across files, and the conversion of the places that they answer with."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from preflight_analysis.documents.span import Location
from preflight_analysis.queries.query_context import QueryContext

from preflight_server.lsp.convert import Converter
from preflight_server.lsp.session import Session, View

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer


async def query_context(view: View) -> QueryContext:
    """The context of an open launch file. What was not analysed since the last edit is left out: its places are
    gone."""
    session, workspace = view.session, await view.session.workspace()
    others = filter(session.analyses.is_current, view.analyses[1:])
    return QueryContext(view.path, (view.analysis, *others), view.index, workspace)


async def workspace_query_context(session: Session, path: str = "") -> QueryContext:
    """The context of any launch file of a folder, open or not, or of none: with the analyses of all that is open."""
    await session.analyses.settled()
    workspace, current = await session.workspace(), filter(session.analyses.is_current, session.analyses.of_roots())
    return QueryContext(path, tuple(current), session.indexing.index, workspace)


def converter_for(ls: PreflightServer, context: QueryContext, places: Iterable[Location]) -> Converter:
    """Conversion by the very texts that the places were found in. Reads files: use it off the event loop."""
    documents = {path: context.document(path) for path in {place.file for place in places}}
    known = {path: document for path, document in documents.items() if document is not None}
    return Converter(ls.texts, known, edits=ls.edit_support)
