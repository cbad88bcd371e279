"""What a session does when the analysis itself breaks, which no launch file should bring about."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

import pytest
from lsprotocol import types
from preflight_analysis.workspace.workspace import Workspace
from preflight_server.lsp.app import PreflightServer
from preflight_server.lsp.session import Session
from preflight_server.lsp.settings import Settings


async def test_a_broken_analysis_is_tried_once_an_edit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tried: list[str] = []

    def breaks(self: Workspace, path: str, args: Any = None) -> None:
        tried.append(path)
        raise RuntimeError("on purpose")

    monkeypatch.setattr(Workspace, "static", breaks)
    monkeypatch.setattr(PreflightServer, "client_capabilities", types.ClientCapabilities())
    server = PreflightServer()
    session = Session(server, str(tmp_path), Settings(), trusted=False)
    launch_file = tmp_path / "a.launch"
    try:
        for version in (1, 2):
            document = server.texts.open(launch_file.as_uri(), "roslaunch", version, "<launch/>")
            session.takes(document)
            session.text_changed(document, own=True, quiet=0)
            await asyncio.wait_for(session.settled(), 10)
            await asyncio.sleep(0.2)
            assert len(tried) <= 2 * version, "once for the edit, and once when the index came"
        assert await session.view(launch_file.as_uri()) is None
    finally:
        await asyncio.get_running_loop().run_in_executor(None, session.close)
