"""Our own requests that look after the runs of nodes and what they told.

- `rosPreflight/trace`, `{"uri", "node": full name, "position"}` → `{"nodes": [name], "message": string | null}`: run
  nodes of the shown root anew: the one of that name, or the one at the position, or all where neither is given.
  `message` says why nothing is run.
- `rosPreflight/clearCache`, `{}` → `{"entries", "bytes"}`: forget what runs told, on the disk as well.
- `rosPreflight/doctor`, `{}` → `{"text"}`: what launch files and nodes are looked at with, as `ros-preflight doctor`,
  for each workspace folder.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from preflight_analysis.tracing import sandbox
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.commands import CommandCache

from preflight_server.doctor import page
from preflight_server.lsp.session import View
from preflight_server.lsp.settings import as_mapping

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer

TRACE = "rosPreflight/trace"
CLEAR_CACHE = "rosPreflight/clearCache"
DOCTOR = "rosPreflight/doctor"


def _named(view: View, given: Mapping[str, Any]) -> frozenset[str] | None:
    """The nodes that a request speaks of, None for all."""
    if isinstance(name := given.get("node"), str):
        return frozenset({name})
    return frozenset(view.nodes_at(given["position"])) if given.get("position") is not None else None


def register(server: PreflightServer) -> None:
    """Register the handlers."""

    @server.feature(TRACE)
    async def trace(ls: PreflightServer, params: Any) -> dict[str, Any]:
        given = as_mapping(params)
        view = await ls.view_of(str(given.get("uri", "")), python=True)
        if view is None:
            return {"nodes": [], "message": "not a launch file, or unreadable"}
        names = _named(view, given)
        if names is not None and not names.intersection(node.name for node in view.analysis.tree.nodes):
            return {"nodes": [], "message": "no node starts on this line"}
        nodes = view.session.runs.again(view.analysis, names)
        ls.status.send()
        return {"nodes": nodes, "message": view.session.runs.why_not_run}

    @server.feature(CLEAR_CACHE)
    async def clear_cache(ls: PreflightServer, params: Any) -> dict[str, Any]:
        if ls.folders is None:
            return {"entries": 0, "bytes": 0}
        cleared = await ls.sessions[0].in_pool(lambda: [store.clear() for store in (TraceCache(), CommandCache())])
        ls.folders.each(lambda session: session.traces_cleared())
        return {"entries": sum(entries for entries, _ in cleared), "bytes": sum(freed for _, freed in cleared)}

    @server.feature(DOCTOR)
    async def doctor(ls: PreflightServer, params: Any) -> dict[str, Any]:
        pages = []
        for session in ls.sessions:
            environment = (await session.workspace()).environment
            # An empty command is run, nothing of the workspace's.
            pages.append(page(environment, await session.in_pool(sandbox.probe), session.analyses.missing))
        return {"text": "\n".join(pages)}
