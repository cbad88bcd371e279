"""What pygls keeps of messages, and that we do not let it."""

from __future__ import annotations

import asyncio
from collections.abc import Generator
from typing import Any

import pytest
from lsprotocol import types
from preflight_server.lsp.app import PreflightServer

DOCUMENT = types.TextDocumentItem("file:///a.launch", "roslaunch", 1, "<launch/>")
CHANGE = types.DidChangeTextDocumentParams(types.VersionedTextDocumentIdentifier(2, DOCUMENT.uri), [])


@pytest.mark.parametrize(
    ("method", "params"),
    [
        (types.TEXT_DOCUMENT_DID_OPEN, types.DidOpenTextDocumentParams(DOCUMENT)),
        (types.TEXT_DOCUMENT_DID_CHANGE, CHANGE),
        (types.WORKSPACE_DID_CHANGE_WATCHED_FILES, types.DidChangeWatchedFilesParams([])),
    ],
)
def test_nothing_is_kept_of_a_notification(method: str, params: Any) -> None:
    protocol = PreflightServer().protocol
    for _ in range(3):
        protocol._handle_notification(method, params)
    assert not protocol._request_futures


def test_requests_that_end_as_the_server_is_shut_down_are_forgotten() -> None:
    protocol = PreflightServer().protocol
    ended: list[bool] = []

    async def never() -> None:
        await asyncio.Event().wait()

    def handler() -> Generator[Any, Any, None]:
        yield never, (), None

    async def shut_down() -> None:
        for number in range(3):
            protocol._execute_handler(number, handler, lambda future: ended.append(future.cancelled()))
        for _ in protocol.lsp_shutdown():
            pass

    asyncio.run(shut_down())
    assert ended == [True] * 3
    assert not protocol._request_futures
