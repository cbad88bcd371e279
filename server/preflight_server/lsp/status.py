"""What the server is busy with and what keeps it from running nodes, for a client that shows it all the time.

A client that sets `"status": true` in the initialisation options gets two notifications of our own:

- `rosPreflight/status`, `{"state": "idle" | "indexing" | "tracing", "done", "total", "notRun": null | {"kind": "off" |
  "untrusted" | "cancelled" | "sandbox", "message"}, "broken": [URI], "missing": {"lines": [text], "commands":
  [text]}}`, whenever one of it changes. `broken` are the files with a syntax error that open files are launched with:
  what the error touches is not run. `missing` is what this machine does not have of all that they need, a line for
  each kind of thing, and the commands that install it;
- `rosPreflight/analysed`, `{}`, when there is something newer to be shown: a tree, a graph.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

from preflight_analysis.findings.lack import commands, in_words

from preflight_server.lsp.text_store import to_uri

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer

State = Literal["indexing", "tracing"]
STATUS = "rosPreflight/status"
ANALYSED = "rosPreflight/analysed"


class Status:
    """Call it on the event loop. Nothing is sent to a client that did not ask for it (`wanted`)."""

    def __init__(self, server: PreflightServer) -> None:
        self.wanted = False
        self._server = server
        self._work: dict[str, tuple[State, int, int]] = {}
        self._sent: dict[str, Any] | None = None
        server.after_analysis.append(self._analysed)

    def working(self, token: str, state: State, done: int, total: int) -> None:
        """A piece of work began or went on; `total` is 0 while that is not known."""
        self._work[token] = (state, done, total)
        self.send()

    def ended(self, token: str) -> None:
        """A piece of work is over."""
        if self._work.pop(token, None) is not None:
            self.send()

    def send(self) -> None:
        """Send what there is to say if it is news."""
        if not self.wanted or not self._server.sessions:
            return
        # Runs of nodes are shown rather than the index, which is made beside them.
        state, done, total = max(self._work.values(), key=lambda work: work[0] == "tracing", default=("idle", 0, 0))
        runs = (session.runs for session in self._server.sessions)
        stopped = ({"kind": each.not_run_since, "message": each.why_not_run} for each in runs if each.not_run_since)
        not_run = next(stopped, None)
        now = {"state": state, "done": done, "total": total, "notRun": not_run, "broken": self._broken()}
        now["missing"] = self._missing()
        if now != self._sent:
            self._sent = now
            self._server.protocol.notify(STATUS, now)

    def _broken(self) -> list[str]:
        analyses = (analysis for session in self._server.sessions for analysis in session.analyses.of_roots())
        documents = (document for analysis in analyses for document in analysis.documents.values())
        return sorted({to_uri(document.path) for document in documents if document.problems})

    def _missing(self) -> dict[str, list[str]]:
        found = [each for session in self._server.sessions for each in session.analyses.missing]
        return {"lines": list(in_words(found)), "commands": list(commands(found))}

    def _analysed(self) -> None:
        if self.wanted:
            self.send()
            self._server.protocol.notify(ANALYSED, {})
