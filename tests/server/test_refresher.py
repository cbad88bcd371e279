"""What a client shows beside the text is asked for again when it has become another, whenever that happens."""

from __future__ import annotations

import asyncio
from pathlib import Path

import pytest
from preflight_server.lsp.app import PreflightServer
from preflight_server.lsp.refresher import Refresher
from support.waiting import PATIENCE


@pytest.mark.parametrize("changes", [True, False])
async def test_what_changed_while_it_was_answered_is_asked_for_again(tmp_path: Path, changes: bool) -> None:
    server = PreflightServer()
    document = server.texts.open((tmp_path / "a.launch").as_uri(), "roslaunch", 1, "<launch/>")
    asked_again, refreshed = asyncio.Event(), asyncio.Event()
    answer = "running"

    async def ask() -> str:
        asked_again.set()
        return answer

    async def refresh() -> None:
        refreshed.set()

    refresher = Refresher(server, refresh, lambda: True)
    asked, first = refresher.looks, answer
    if changes:
        answer = "done"
        refresher.look()  # nobody was told anything yet
    refresher.answered(document, first, ask, asked)
    if changes:
        await asyncio.wait_for(refreshed.wait(), PATIENCE)
    else:
        await asyncio.sleep(0)  # a comparison would begin with it
        assert not asked_again.is_set()
