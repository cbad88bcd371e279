"""Whose nodes are run first, where several launches are open."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import AsyncIterator
from dataclasses import dataclass, field
from pathlib import Path
from types import SimpleNamespace

import pytest
from lsprotocol import types
from preflight_analysis.tracing import sandbox
from preflight_analysis.tracing.interface import Interface, Outcome
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.trace import Tracer
from preflight_analysis.workspace.workspace import Analysis, Workspace
from preflight_server.lsp.app import PreflightServer
from preflight_server.lsp.runs import FIRST_RUNS, Runs
from preflight_server.lsp.session import Session
from preflight_server.lsp.settings import Settings
from support.waiting import until

LARGE = 10 * FIRST_RUNS


@dataclass
class Desk:
    """A large launch that the user looks at, with a small one open behind it."""

    folder: Path
    session: Session
    ran: list[str] = field(default_factory=list)
    """The launches whose nodes were run, in that order."""
    stuck: threading.Event = field(default_factory=threading.Event)
    """Whether the nodes of the large one end only when they are cancelled."""
    cancelled: list[str] = field(default_factory=list)

    def open(self, name: str) -> None:
        text = f'<launch><node pkg="nowhere" type="t" name="{name[0]}"/></launch>'
        document = self.session._server.texts.open((self.folder / name).as_uri(), "roslaunch", 1, text)
        self.session.takes(document)
        self.session.text_changed(document, own=True, quiet=0)

    def close(self, name: str) -> None:
        self.session._server.texts.close((self.folder / name).as_uri())
        self.session.leaves(str(self.folder / name))
        self.session.closed(str(self.folder / name))


@pytest.fixture
async def desk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> AsyncIterator[Desk]:
    monkeypatch.setattr(PreflightServer, "client_capabilities", types.ClientCapabilities())
    desk = Desk(tmp_path, Session(PreflightServer(), str(tmp_path), Settings(), trusted=True))

    async def requests(_: Runs, __: Workspace, analysis: Analysis, ___: object) -> dict[tuple[str, int], TraceRequest]:
        size = LARGE if analysis.root.endswith("large.launch") else 1
        nodes = (f"/n{number}" for number in range(size))
        return {(node, 0): TraceRequest(node, "p", str(tmp_path / "n.py"), launch=analysis.root) for node in nodes}

    def trace(_: Tracer, request: TraceRequest, cancel: threading.Event, *, fresh: bool = False) -> Interface:
        name = Path(request.launch).name
        desk.ran.append(name)
        while name == "large.launch" and desk.stuck.is_set() and not cancel.wait(0.01):
            pass
        if cancel.is_set():
            desk.cancelled.append(request.node)
        return Interface("trace", Outcome("spinning"))

    monkeypatch.setattr(sandbox, "probe", lambda: SimpleNamespace(works=True, reason=None))
    monkeypatch.setattr(Tracer, "lookup", lambda *_: None)
    monkeypatch.setattr(Tracer, "trace", trace)
    monkeypatch.setattr(Runs, "_requests", requests)
    try:
        yield desk
    finally:
        await asyncio.get_running_loop().run_in_executor(None, desk.session.close)


async def has_run(desk: Desk, name: str, count: int) -> None:
    await asyncio.to_thread(until, lambda: desk.ran.count(name) >= count)


async def test_a_large_launch_lets_others_have_their_turn(desk: Desk) -> None:
    desk.open("small.launch")
    desk.open("large.launch")
    await has_run(desk, "large.launch", LARGE)
    assert desk.ran.index("small.launch") == FIRST_RUNS, "the one that is looked at first, then the others"
    assert len(desk.ran) == LARGE + 1


async def test_closing_a_file_ends_its_runs(desk: Desk) -> None:
    desk.stuck.set()
    desk.open("small.launch")
    desk.open("large.launch")
    await has_run(desk, "large.launch", 1)
    desk.close("large.launch")
    await has_run(desk, "small.launch", 1)
    assert desk.cancelled
    assert desk.ran.count("large.launch") <= FIRST_RUNS


async def test_what_the_user_looks_at_comes_first(desk: Desk) -> None:
    desk.stuck.set()
    desk.open("small.launch")
    desk.open("large.launch")
    await has_run(desk, "large.launch", 1)
    batch = desk.session.runs._batch
    assert batch is not None
    desk.session.looked_at((desk.folder / "small.launch").as_uri())
    waiting = [job for job in batch.jobs.values() if not job.begun.is_set()]
    await asyncio.to_thread(until, lambda: waiting and all(job.cancel.is_set() for job in waiting))
    desk.stuck.clear()
    await has_run(desk, "small.launch", 1)
    assert desk.ran.count("large.launch") < LARGE
