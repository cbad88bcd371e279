"""Our own request for the tree of what a launch starts, in the root in whose context a file is shown.

`rosPreflight/tree`, `{"uri"}` → null for what is no launch file, else `{"root": {"uri", "args"}, "files": [URI],
"nodes": how many, "items": [Item]}`. An item is `{"kind", "label", "detail", "name", "location", "file", "note",
"severity", "findings", "children"}`: see `queries/node_tree.py`. `file` counts in `files`; `severity` is LSP's.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from preflight_analysis.queries.node_tree import Item, node_tree

from preflight_server.lsp.convert import SEVERITIES, Converter
from preflight_server.lsp.settings import as_mapping
from preflight_server.lsp.text_store import to_uri

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer

TREE = "rosPreflight/tree"


def register(server: PreflightServer) -> None:
    """Register the handler."""

    @server.feature(TREE)
    async def tree(ls: PreflightServer, params: Any) -> dict[str, Any] | None:
        view = await ls.view_of(str(as_mapping(params).get("uri", "")), python=True)
        if view is None:
            return None
        analysis, findings = view.analysis, view.session.analyses.findings

        def work() -> dict[str, Any]:
            found = node_tree(analysis, findings)
            files = {path: index for index, path in enumerate(found.files)}
            return {
                "root": {"uri": to_uri(analysis.root), "args": dict(analysis.args)},
                "files": [view.converter.uri(path) for path in found.files],
                "nodes": found.nodes,
                "items": [_json(item, files, view.converter) for item in found.items],
            }

        return await view.session.in_pool(work)


def _json(item: Item, files: Mapping[str, int], converter: Converter) -> dict[str, Any]:
    return {
        "kind": item.kind,
        "label": item.label,
        "detail": item.detail,
        "name": item.name,
        "location": converter.location(item.location) if item.location is not None else None,
        "file": files.get(item.file) if item.file is not None else None,
        "note": item.note,
        "severity": SEVERITIES[item.worst].value if item.worst is not None else None,
        "findings": item.findings,
        "children": [_json(child, files, converter) for child in item.children],
    }
