"""What a client shows beside the text is asked for again when it has become another, whenever that happens."""

from __future__ import annotations

import asyncio
from pathlib import Path

import pytest
from preflight_server.lsp import refresher as refresher_module
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


@pytest.mark.parametrize("asks", [True, False])
async def test_a_client_that_does_not_ask_is_told_once_more(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, asks: bool
) -> None:
    monkeypatch.setattr(refresher_module, "_TO_ASK", 0.05)
    server = PreflightServer()
    document = server.texts.open((tmp_path / "a.launch").as_uri(), "roslaunch", 1, "<launch/>")
    answer, refreshes = "running", 0

    async def ask() -> str:
        return answer

    async def refresh() -> None:
        nonlocal refreshes
        refreshes += 1
        if asks:
            refresher.answered(document, answer, ask, refresher.looks)

    refresher = Refresher(server, refresh, lambda: True)
    refresher.answered(document, answer, ask, refresher.looks)
    answer = "done"
    refresher.look()
    task = refresher._task
    assert task is not None
    await asyncio.wait_for(task, PATIENCE)
    assert refreshes == (1 if asks else 2)
