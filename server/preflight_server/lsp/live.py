"""Watches the running system for a client that asks for it: what is told stands in `protocol.py` (`LIVE`)."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import threading
from typing import TYPE_CHECKING, Any

from preflight_analysis.findings.failure import error_line
from preflight_analysis.live.expected import expected_of
from preflight_analysis.live.model import Expected
from preflight_analysis.live.report import event_json
from preflight_analysis.live.watcher import Event, Observer, Waiting, Watcher, observer
from preflight_analysis.workspace.workspace import Analysis

from preflight_server.lsp.protocol import LIVE
from preflight_server.lsp.text_store import to_uri

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer
    from preflight_server.lsp.session import Session

_log = logging.getLogger(__name__)

POLL_SECONDS = 0.5
SETTLE_SECONDS = 2.0
"""How long a difference has to last before it is told: nodes that are started again are away for a moment."""
_CLOSE_SECONDS = 5.0
"""For an answer that is being waited for."""


class _Watch:
    """One root, watched from a thread. `analysis` is the newest one, which the event loop replaces."""

    def __init__(self, session: Session, analysis: Analysis) -> None:
        self.session = session
        self.analysis = analysis
        self.observer: Observer = observer(analysis.tree.generation, analysis.environment)
        self.stopped = threading.Event()
        self._expected: tuple[Analysis, Expected] | None = None

    def expected(self) -> Expected:
        """What the newest analysis expects."""
        analysis = self.analysis
        if self._expected is None or self._expected[0] is not analysis:
            nothing = Expected(analysis.tree.generation, (), complete=False)
            found = expected_of(analysis.graph, analysis.documents) if analysis.graph is not None else nothing
            self._expected = analysis, found
        return self._expected[1]


class LiveWatch:
    """At most one watch. Call it on the event loop."""

    def __init__(self, server: PreflightServer) -> None:
        self._server = server
        self._watch: _Watch | None = None
        self._thread: threading.Thread | None = None
        server.after_analysis.append(self._analysed)

    def start(self, session: Session, analysis: Analysis) -> None:
        """Watch what the root of this analysis starts, in place of what was watched before."""
        self.stop(None)
        self._watch = watch = _Watch(session, analysis)
        loop = asyncio.get_running_loop()
        self._thread = threading.Thread(target=self._run, args=(watch, loop), name="live", daemon=True)
        self._thread.start()

    def stop(self, reason: str | None) -> None:
        """Watch nothing any more, and tell that."""
        watch, self._watch = self._watch, None
        if watch is not None:
            watch.stopped.set()
            watch.observer.close()
            self._notify(watch, {"event": "stopped", "reason": reason})

    def forget(self, session: Session) -> None:
        """A folder was closed."""
        if self._watch is not None and self._watch.session is session:
            self.stop("the folder was closed")

    def close(self) -> None:
        """Leave nothing running; may be called from any thread."""
        watch, self._watch = self._watch, None
        if watch is not None:
            watch.stopped.set()
            watch.observer.close()
        if self._thread is not None:
            self._thread.join(_CLOSE_SECONDS)

    def _analysed(self) -> None:
        watch = self._watch
        if watch is not None:
            newest = (a for a in watch.session.analyses.of_roots() if a.launch == watch.analysis.launch)
            watch.analysis = next(newest, watch.analysis)

    def _run(self, watch: _Watch, loop: asyncio.AbstractEventLoop) -> None:
        watcher = Watcher(watch.observer, watch.expected, settle=SETTLE_SECONDS)
        while not watch.stopped.is_set():
            try:
                events = watcher.look()
            except Exception as error:
                if not watch.stopped.is_set():
                    _log.exception("the running system could not be compared")
                    with contextlib.suppress(RuntimeError):  # the event loop is closed
                        loop.call_soon_threadsafe(self._failed, watch, f"internal error: {error_line(error)}")
                return
            with contextlib.suppress(RuntimeError):  # the event loop is closed
                for event in events:
                    loop.call_soon_threadsafe(self._report, watch, event)
            watch.stopped.wait(POLL_SECONDS)

    def _failed(self, watch: _Watch, reason: str) -> None:
        if watch is self._watch:
            self.stop(reason)

    def _report(self, watch: _Watch, event: Event) -> None:
        if watch is not self._watch:
            return
        if isinstance(event, Waiting) and event.final:
            self.stop(event.reason)
            return
        record = event_json(event)
        for issue in record.get("issues", ()):
            issue["location"], issue["source"] = _location(issue.pop("place")), _location(issue["source"])
        self._notify(watch, record)

    def _notify(self, watch: _Watch, record: dict[str, Any]) -> None:
        root = {"uri": to_uri(watch.analysis.root), "args": dict(watch.analysis.args)}
        self._server.protocol.notify(LIVE, {**record, "root": root})


def _location(place: dict[str, Any] | None) -> dict[str, Any] | None:
    """The start of the line, which is the same in each encoding."""
    if place is None:
        return None
    start = {"line": place["line"] - 1, "character": 0}
    return {"uri": to_uri(place["file"]), "range": {"start": start, "end": start}}
