"""What a session does when the analysis itself breaks, which no launch file should bring about."""

from __future__ import annotations

import asyncio
import threading
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from lsprotocol import types
from preflight_analysis.tracing import sandbox
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.trace import Tracer
from preflight_analysis.workspace.workspace import Analysis, Workspace
from preflight_server.lsp.app import PreflightServer
from preflight_server.lsp.rounds import LARGE
from preflight_server.lsp.runs import Runs
from preflight_server.lsp.session import Session
from preflight_server.lsp.settings import Settings
from support.waiting import PATIENCE, answered


@pytest.mark.breaks
async def test_a_broken_analysis_is_tried_once_an_edit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tried: list[str] = []

    def breaks(self: Workspace, path: str, args: Any = None) -> None:
        tried.append(path)
        raise RuntimeError("on purpose")

    monkeypatch.setattr(Workspace, "analysed", breaks)
    monkeypatch.setattr(PreflightServer, "client_capabilities", types.ClientCapabilities())
    server = PreflightServer()
    session = Session(server, str(tmp_path), Settings(), trusted=False)
    launch_file = tmp_path / "a.launch"
    try:
        for version in (1, 2):
            document = server.texts.open(launch_file.as_uri(), "roslaunch", version, "<launch/>")
            session.takes(document)
            session.text_changed(document, own=True, quiet=0)
            await asyncio.wait_for(session.analyses.settled(), PATIENCE)
            await asyncio.sleep(0.2)  # nothing tells that it is not tried again
            assert len(tried) <= 2 * version, "once for the edit, and once when the index came"
        view = await session.view(launch_file.as_uri())
        assert view is not None
        assert view.analysis.graph is None, "what the text alone says is left"
    finally:
        await asyncio.get_running_loop().run_in_executor(None, session.close)


@pytest.mark.parametrize(("nodes", "first"), [(LARGE, False), (LARGE - 1, True)])
async def test_of_a_large_launch_what_needs_no_graph_is_there_first(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, nodes: int, first: bool
) -> None:
    may_go_on = threading.Event()
    whole = Workspace.with_interfaces

    def waits(self: Workspace, *args: Any) -> Analysis:
        may_go_on.wait(PATIENCE)
        return whole(self, *args)

    monkeypatch.setattr(Workspace, "with_interfaces", waits)
    monkeypatch.setattr(PreflightServer, "client_capabilities", types.ClientCapabilities())
    server = PreflightServer()
    session = Session(server, str(tmp_path), Settings(), trusted=False)
    launch_file = tmp_path / "a.launch"
    text = "".join(f'<node pkg="nowhere" type="t" name="n{number}"/>\n' for number in range(nodes))
    try:
        document = server.texts.open(launch_file.as_uri(), "roslaunch", 1, f"<launch>{text}</launch>")
        session.takes(document)
        session.text_changed(document, own=True, quiet=0)
        if first:
            may_go_on.set()
        await asyncio.wait_for(session.analyses.settled(), PATIENCE)
        view = await session.view(launch_file.as_uri())
        assert view is not None
        assert {finding.rule for finding in view.findings} >= {"PKG001"}
        assert (view.analysis.graph is not None) == first
        session.analyses.ask_again()  # as when the index is there
        assert await asyncio.wait_for(session.view(launch_file.as_uri()), PATIENCE / 2) is not None
        may_go_on.set()
        view = await answered(
            lambda: session.view(launch_file.as_uri()),
            lambda view: view is not None and view.analysis.graph is not None,
        )
        assert view is not None
        assert any(finding.rule == "PKG001" for finding in view.findings)
    finally:
        may_go_on.set()
        await asyncio.get_running_loop().run_in_executor(None, session.close)


async def test_what_texts_say_does_not_wait_for_the_graph(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    may_go_on = threading.Event()
    whole = Workspace.with_interfaces

    def waits(self: Workspace, *args: Any) -> Analysis:
        may_go_on.wait(PATIENCE)
        return whole(self, *args)

    monkeypatch.setattr(Workspace, "with_interfaces", waits)
    monkeypatch.setattr(PreflightServer, "client_capabilities", types.ClientCapabilities())
    server = PreflightServer()
    session = Session(server, str(tmp_path), Settings(), trusted=False)
    launch_file = tmp_path / "a.launch"
    try:
        text = '<launch><node pkg="nowhere" type="t" name="n"/></launch>'
        document = server.texts.open(launch_file.as_uri(), "roslaunch", 1, text)
        session.takes(document)
        session.text_changed(document, own=True, quiet=0)
        await asyncio.wait_for(session.analyses.published(), PATIENCE)
        found = session.analyses.findings[str(launch_file)]
        assert [finding.rule for finding in found] == ["PKG001"]
        may_go_on.set()
        view = await asyncio.wait_for(session.view(launch_file.as_uri()), PATIENCE)
        assert view is not None
        assert view.analysis.graph is not None, "who asks waits for it"
    finally:
        may_go_on.set()
        await asyncio.get_running_loop().run_in_executor(None, session.close)


async def test_no_edit_waits_for_who_reads(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    reads, may_go_on = threading.Event(), threading.Event()
    let_go: list[bool] = []
    whole = Workspace.analysed

    def waits(self: Workspace, *args: Any) -> Analysis:
        if not reads.is_set():
            with self.sources.db.reading():  # as who parses a large file, and asks nothing meanwhile
                reads.set()
                let_go.append(may_go_on.wait(PATIENCE))
        return whole(self, *args)

    monkeypatch.setattr(Workspace, "analysed", waits)
    monkeypatch.setattr(PreflightServer, "client_capabilities", types.ClientCapabilities())
    server = PreflightServer()
    session = Session(server, str(tmp_path), Settings(), trusted=False)
    launch_file = tmp_path / "a.launch"

    def edit(version: int, text: str) -> None:
        document = server.texts.open(launch_file.as_uri(), "roslaunch", version, text)
        session.takes(document)
        session.text_changed(document, own=True, quiet=0)

    try:
        edit(1, "<launch/>")
        assert await asyncio.get_running_loop().run_in_executor(None, reads.wait, PATIENCE)
        for version in (2, 3, 4):
            edit(version, f'<launch><arg name="a{version}"/></launch>')
            await asyncio.sleep(0)  # for the loop to begin with what it is told
        may_go_on.set()
        view = await answered(
            lambda: session.view(launch_file.as_uri()),
            lambda view: view is not None and "a4" in view.document.text,
        )
        assert view is not None
        assert view.analysis.documents[str(launch_file)].text == view.document.text
        assert let_go == [True], "the event loop went on while somebody read"
    finally:
        may_go_on.set()
        await asyncio.get_running_loop().run_in_executor(None, session.close)


async def test_trust_that_is_withdrawn_just_before_a_run_prevents_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    done: list[str] = []
    asked = asyncio.Event()
    node = TraceRequest("/n", "p", str(tmp_path / "n.py"))

    async def requests(self: Runs, *_: Any) -> dict[tuple[str, int], TraceRequest]:
        asked.set()
        session.set_trusted(False)
        return {("/n", 0): node}

    async def run(self: Runs, *_: Any) -> None:
        done.append("run")

    monkeypatch.setattr(sandbox, "probe", lambda: SimpleNamespace(works=True, reason=None))
    monkeypatch.setattr(Tracer, "lookup", lambda *_: None)
    monkeypatch.setattr(Runs, "_requests", requests)
    monkeypatch.setattr(Runs, "_run", run)
    monkeypatch.setattr(PreflightServer, "client_capabilities", types.ClientCapabilities())
    server = PreflightServer()
    session = Session(server, str(tmp_path), Settings(), trusted=True)
    try:
        document = server.texts.open((tmp_path / "a.launch").as_uri(), "roslaunch", 1, "<launch/>")
        session.takes(document)
        session.text_changed(document, own=True, quiet=0)
        await asyncio.wait_for(asked.wait(), PATIENCE)
        assert session.runs._loop is not None
        await asyncio.wait_for(session.runs._loop, PATIENCE)
        assert not done
        assert session.runs.not_run_since == "untrusted"
    finally:
        await asyncio.get_running_loop().run_in_executor(None, session.close)
