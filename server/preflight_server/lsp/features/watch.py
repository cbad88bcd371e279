"""Our own request to watch the running system; it and what is told then stand in `protocol.py`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from preflight_server.lsp.protocol import WATCH
from preflight_server.lsp.settings import as_mapping

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer

_NOT_TRUSTED = "the workspace is not trusted; trust it to watch the running system"


def register(server: PreflightServer) -> None:
    """Register the handler."""

    @server.feature(WATCH)
    async def watch(ls: PreflightServer, params: Any) -> dict[str, Any]:
        given = as_mapping(params)
        if given.get("watch") is not True:
            ls.live.stop(None)
            return {"watching": False, "message": None}
        view = await ls.view_of(str(given.get("uri", "")), python=True)
        if view is None:
            return {"watching": False, "message": "not a launch file, or unreadable"}
        if not view.session.runs.trusted:
            return {"watching": False, "message": _NOT_TRUSTED}
        analysis = view.analysis
        ls.live.start(view.session, analysis)
        await view.session.choice.choose(analysis.launch, analysis.reached)
        return {"watching": True, "message": None}
