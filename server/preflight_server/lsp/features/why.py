"""Our own request for the reasons why two nodes are connected or not, or why one is started, in the root in whose
context a file is shown; the command line has them as `ros-preflight why`.

`rosPreflight/why`, `{"uri", "position"?, "nodes": [full name, ...], "channel"?}` → null for what is no launch file,
else `{"all": [full name], "at": full name | null, "chains": [{"title", "links": [Link]}], "message": string | null}`.
`all` are the nodes that may be asked for, `at` the one at the position. With two nodes there is a chain for each topic,
service or action that they share, with one node a chain from the launch file to it, without nodes none. A Link is
`{"state": "ok" | "broken" | "unknown", "text", "location": Location | null, "fixes": [title]}`. `message` says why
there is no answer.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from preflight_analysis.evaluation.inversion import Assignment
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.queries.why import Link, NoSuchNodeError, chains
from preflight_analysis.queries.why_started import why_started
from preflight_analysis.workspace.workspace import Workspace

from preflight_server.lsp.convert import Converter
from preflight_server.lsp.session import View
from preflight_server.lsp.settings import as_mapping

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer

WHY = "rosPreflight/why"


def register(server: PreflightServer) -> None:
    """Register the handler."""

    @server.feature(WHY)
    async def why(ls: PreflightServer, params: Any) -> dict[str, Any] | None:
        given = as_mapping(params)
        view = await ls.view_of(str(given.get("uri", "")), python=True)
        if view is None:
            return None
        workspace = await view.session.workspace()
        return await view.session.in_pool(lambda: _answer(view, workspace, given))


def _answer(view: View, workspace: Workspace, given: Mapping[str, Any]) -> dict[str, Any]:
    analysis = view.analysis
    nodes = analysis.graph.tree.nodes if analysis.graph is not None else analysis.tree.nodes
    names = given.get("nodes")
    asked = [str(name) for name in names] if isinstance(names, Sequence) and not isinstance(names, str) else []
    channel = given.get("channel")
    found: list[dict[str, Any]] = []
    message = None
    try:
        found = [*_chains(view, workspace, asked, channel if isinstance(channel, str) else None)]
    except NoSuchNodeError as error:
        message = f"no node '{error.name}' in this launch"
    return {
        "all": [node.name for node in nodes],
        "at": next(iter(view.nodes_at(given.get("position"))), None),
        "chains": found,
        "message": message,
    }


def _chains(view: View, workspace: Workspace, asked: Sequence[str], channel: str | None) -> Iterator[dict[str, Any]]:
    analysis = view.analysis
    if len(asked) == 1:

        def evaluate(wanted: Assignment) -> LaunchTree:
            return workspace.evaluated(analysis.root, wanted).tree

        start = why_started(analysis, asked[0], evaluate)
        yield _chain(start.verdict, start.links, view.converter)
    elif asked and analysis.graph is not None:
        for chain in chains(analysis, analysis.graph, asked[0], asked[1], channel):
            yield _chain(chain.verdict, chain.links, view.converter)


def _chain(title: str, links: Iterable[Link], converter: Converter) -> dict[str, Any]:
    return {
        "title": title,
        "links": [
            {
                "state": link.state,
                "text": link.text,
                "location": converter.location(link.location) if link.location is not None else None,
                "fixes": [fix.title for fix in link.fixes],
            }
            for link in links
        ],
    }
