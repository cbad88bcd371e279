"""Our own requests about the root in whose context a file is shown.

- `rosPreflight/roots`, `{"uri"}` → `{"shown": Root | null, "roots": [Root]}`: the roots that reach a file. A root is
  `{"uri", "args": {name: value}, "declared": [{"name", "default", "doc", "required"}]}`.
- `rosPreflight/selectRoot`, `{"uri", "root": {"uri", "args"} | null}` → `{"shown": Root, "message": string | null}`:
  show the file, and all that the root reaches, in another context; null goes back to the usual one. `message` says why
  that could not be done.

The command `rosPreflight.askForRoot`, with a URI, lets the user choose among the roots in any editor: by
`window/showMessageRequest`.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from lsprotocol import types
from preflight_analysis.queries.places import shown_path
from preflight_analysis.workspace.index import Root

from preflight_server.lsp.session import Session
from preflight_server.lsp.settings import as_mapping
from preflight_server.lsp.text_store import to_path, to_uri

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer

ROOTS = "rosPreflight/roots"
SELECT_ROOT = "rosPreflight/selectRoot"
ASK_FOR_ROOT = "rosPreflight.askForRoot"
_USUAL = "Default"


def _to_json(session: Session, root: Root) -> dict[str, Any]:
    facts = session.indexing.index.files.get(root.path)
    declared = [
        {"name": a.name, "default": a.default, "doc": a.doc, "required": a.required}
        for a in (facts.args if facts else ())
        if a.value is None
    ]
    return {"uri": to_uri(root.path), "args": dict(root.args), "declared": declared}


def _from_json(given: Any) -> Root | None:
    root = as_mapping(given)
    path = to_path(str(root.get("uri", "")))
    args = {str(name): str(value) for name, value in as_mapping(root.get("args")).items()}
    return Root.of(path, args) if path is not None else None


def register(server: PreflightServer) -> None:
    """Register the handlers."""

    @server.feature(ROOTS)
    async def roots(ls: PreflightServer, params: Any) -> dict[str, Any]:
        uri = str(as_mapping(params).get("uri", ""))
        path, session = to_path(uri), ls.session_of(uri)
        if session is None or path is None:
            return {"shown": None, "roots": []}
        found = [_to_json(session, root) for root in session.choice.of(path)]
        return {"shown": next(iter(found), None), "roots": found}

    @server.feature(SELECT_ROOT)
    async def select_root(ls: PreflightServer, params: Any) -> dict[str, Any]:
        given = as_mapping(params)
        uri = str(given.get("uri", ""))
        path, session = to_path(uri), ls.session_of(uri)
        if session is None or path is None:
            return {"shown": None, "message": "the file does not exist"}
        wanted = given.get("root")
        root = _from_json(wanted)
        message = await session.select(path, root) if wanted is None or root else "the root is not a file"
        shown = next(iter(session.choice.of(path)), None)
        return {"shown": _to_json(session, shown) if shown is not None else None, "message": message}

    @server.command(ASK_FOR_ROOT)
    async def ask_for_root(uri: str) -> None:
        path, session = to_path(uri), server.session_of(uri)
        if path is None or session is None:
            return
        offered = {_title(session, root): root for root in (*session.choice.of(path), *_alone(session, path))}
        text = f"Analyse {os.path.basename(path)} as launched by"
        actions = [types.MessageActionItem(title) for title in (*offered, _USUAL)]
        request = types.ShowMessageRequestParams(types.MessageType.Info, text, actions)
        answer = await server.window_show_message_request_async(request)
        if answer is None:
            return
        message = await session.select(path, offered.get(answer.title))
        if message is not None:
            server.window_show_message(types.ShowMessageParams(types.MessageType.Warning, f"ros-preflight: {message}"))


def _alone(session: Session, path: str) -> Iterator[Root]:
    """The file itself, where it is a launch file: any can be launched alone."""
    if session.choice.is_launched(path):
        yield Root(path)


def _title(session: Session, root: Root) -> str:
    given = (f"{name}:={value}" for name, value in root.args)
    return " ".join((shown_path(root.path, session.folder), *given))
