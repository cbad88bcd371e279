"""`textDocument/codeLens`: above `<launch>` who includes the file, how many nodes it starts, in whose context, why it
is not evaluated where that is so, and which nodes run in the sandbox at the moment.

A lens can be clicked where the client has our commands: those that it names as `clientCommands` in the initialisation
options. `rosPreflight.showReferences` gets a URI, a position and locations, `rosPreflight.selectRoot` a URI; in the
place of that the server has `rosPreflight.askForRoot` for any client.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from lsprotocol import types
from preflight_analysis.queries.lenses import Lenses, lenses
from preflight_analysis.queries.query_context import QueryContext

from preflight_server.lsp.features.roots import ASK_FOR_ROOT
from preflight_server.lsp.markup import counted
from preflight_server.lsp.query_contexts import converter_for, query_context
from preflight_server.lsp.refresher import Refresher

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer

SHOW_REFERENCES = "rosPreflight.showReferences"
SELECT_ROOT = "rosPreflight.selectRoot"


_SHOWN_RUNS = 3


def _running(names: Sequence[str]) -> str:
    """Which nodes the answers of the next findings wait for."""
    more = f" and {len(names) - _SHOWN_RUNS} more" if len(names) > _SHOWN_RUNS else ""
    return f"running in the sandbox: {', '.join(names[:_SHOWN_RUNS])}{more}"


def _titles(found: Lenses, context: QueryContext) -> tuple[str, str, str]:
    nodes = counted(found.nodes, "node")
    if found.own != found.nodes:
        nodes = f"{found.own} of {nodes}"
    given = " ".join(f"{name}:={value}" for name, value in found.root.args)
    path = "this file" if found.root.path == context.path else context.shown(found.root.path)
    if found.root.path != context.path and os.path.dirname(path) == os.path.dirname(context.shown(context.path)):
        path = os.path.basename(path)
    includers = len(found.includers)
    included = f"included by {counted(includers, 'file')}" if includers else "not included by any file"
    return included, nodes, f"launched by {' '.join(filter(None, (path, given)))}"


def register(server: PreflightServer) -> None:
    """Register the handler."""

    def command(title: str, name: str, *arguments: Any) -> types.Command:
        return types.Command(title, name if name in server.client_commands else "", arguments=list(arguments))

    async def answer(uri: str) -> list[types.CodeLens] | None:
        view = await server.view_of(uri, python=True)
        if view is None:
            return None
        context, running = await query_context(view), view.session.runs.running(view.analysis.launch)

        def work() -> list[types.CodeLens] | None:
            found = lenses(context)
            if found is None:
                return None
            converter = converter_for(server, context, found.includers)
            range_ = view.converter.positions(view.path).range(found.head)
            places = [converter.location(place) for place in found.includers]
            includers, nodes, root = _titles(found, context)
            select = SELECT_ROOT if SELECT_ROOT in server.client_commands else ASK_FOR_ROOT
            shown = [types.CodeLens(range_, types.Command(root, select, arguments=[uri]))]
            if found.is_launched:
                shown[:0] = [
                    types.CodeLens(range_, command(includers, SHOW_REFERENCES, uri, range_.start, places)),
                    types.CodeLens(range_, command(nodes, "")),
                ]
            if found.reason:
                shown.insert(0, types.CodeLens(range_, command(f"not evaluated: {found.reason}", "")))
            if running:
                shown.append(types.CodeLens(range_, command(_running(running), "")))
            return shown

        return await view.session.in_pool(work)

    def supported() -> bool:
        workspace = server.client_capabilities.workspace
        return bool(workspace and workspace.code_lens and workspace.code_lens.refresh_support)

    refresher = Refresher(server, lambda: server.workspace_code_lens_refresh_async(None), supported)
    server.when_runs_change.append(refresher.look)

    @server.feature(types.TEXT_DOCUMENT_CODE_LENS)
    async def code_lens(ls: PreflightServer, params: types.CodeLensParams) -> list[types.CodeLens] | None:
        uri, asked = params.text_document.uri, refresher.looks
        found = await answer(uri)
        document = ls.texts.get(uri)
        if document is not None:
            refresher.answered(document, found, lambda: answer(uri), asked)
        return found
