"""Our own request for the picture of who talks to whom, in the root in whose context a file is shown.

`rosPreflight/graph`, `{"uri", "builtin": bool, "known": digest | null}` → null for what is no launch file, else
`{"digest", "graph": View | null}`: null where it is what the client knows by that digest already. A View is the object
of `view/view_json.py`, with the picture in it; its lines and columns are counted from 1, columns in code points.
`builtin` adds what every node has by its client library. `rosPreflight/analysed` tells when to ask again.
"""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING, Any

from preflight_analysis.graph.build import build_graph
from preflight_analysis.tracing.interface import NOT_RUN
from preflight_analysis.view.layout import lay_out
from preflight_analysis.view.model import GraphView, graph_view
from preflight_analysis.view.view_json import view_json
from preflight_analysis.workspace.workspace import Analysis

from preflight_server.lsp.settings import as_mapping

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer

GRAPH = "rosPreflight/graph"


def _view(analysis: Analysis, *, builtin: bool) -> GraphView:
    # Before anything is known of the nodes, they are shown all the same.
    graph = analysis.graph or build_graph(analysis.tree, [NOT_RUN] * len(analysis.tree.nodes_and_simulated))
    view = graph_view(graph, analysis.findings, analysis.context)
    return view if builtin else view.without_builtin()


def register(server: PreflightServer) -> None:
    """Register the handler."""

    @server.feature(GRAPH)
    async def graph(ls: PreflightServer, params: Any) -> dict[str, Any] | None:
        given = as_mapping(params)
        view = await ls.view_of(str(given.get("uri", "")), python=True)
        if view is None:
            return None
        analysis, folder = view.analysis, view.session.folder

        def work() -> dict[str, Any]:
            shown = _view(analysis, builtin=given.get("builtin") is True)
            digest = hashlib.sha256(repr(shown).encode("utf-8", "surrogatepass")).hexdigest()
            is_known = digest == given.get("known")
            return {"digest": digest, "graph": None if is_known else view_json(shown, lay_out(shown), folder)}

        return await view.session.in_pool(work)
