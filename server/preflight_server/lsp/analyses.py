"""The analyses of the roots of open files: asked for after each change, put together and published.

A change asks again: a snapshot is taken, a thread makes a round of it, and what comes back is dropped if something
else has changed meanwhile. Nothing is kept here of what is out of date: the database knows.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
import threading
import time
from collections.abc import Collection, Iterator, Mapping
from functools import partial
from typing import TYPE_CHECKING

from lsprotocol import types
from preflight_analysis.findings.failure import Failure
from preflight_analysis.findings.finding import Finding
from preflight_analysis.findings.lack import Missing
from preflight_analysis.workspace.branches import Branches
from preflight_analysis.workspace.index import Root
from preflight_analysis.workspace.resolve_commands import MAX_ROUNDS
from preflight_analysis.workspace.workspace import Analysis, Workspace

from preflight_server.lsp.launch_documents import is_build_file
from preflight_server.lsp.rounds import Round, Snapshot, branches_of

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer
    from preflight_server.lsp.session import Session

_log = logging.getLogger(__name__)

PAUSE_BEFORE_BRANCHES = 3.0
"""Seconds more before it is looked into what conditions leave out: an edit waits until that has noticed it."""


class Analyses:
    """Of one session; use it on the event loop, where nothing else is said."""

    def __init__(self, server: PreflightServer, session: Session) -> None:
        self._server = server
        self._session = session
        self._last: Round | None = None
        """What was published last."""
        self._edited: str | None = None
        """The file whose edit leads to what is published next; None where something else does."""
        self._quiet_at = 0.0
        """When the user will have stopped typing, by `time.monotonic`."""
        self._refreshing: asyncio.Task[None] | None = None
        self._branching: asyncio.Task[None] | None = None
        self._news = asyncio.Event()
        """Whether what was asked for may have another answer by now."""
        self._settled = asyncio.Event()
        self._published = asyncio.Event()
        """Whether something is published that was found in the texts as they are."""
        self.calm = threading.Event()
        """Whether all that is shown is up to date: what runs in the background waits for that, thread or not."""
        self._mark_settled()

    # When

    def ask_again(self, edited: str | None = None) -> None:
        """Something changed, by an edit of this file where one is named."""
        self._edited = edited
        if edited is not None or self._last is None:
            self._published.clear()
        if edited is not None or self._last is None or not self._last.large:
            self._settled.clear()  # what there is before a graph stays until that is there, unless the text is another
        self.calm.clear()
        self._news.set()
        if self._refreshing is None or self._refreshing.done():
            self._refreshing = self._server.spawn(self._refresh())

    def hold(self, quiet: float) -> None:
        """All but what is shown waits `quiet` seconds: the user is typing."""
        self._quiet_at = time.monotonic() + quiet

    @property
    def quiet_for(self) -> float:
        """In how many seconds the user will have paused, if no further edit comes; in any thread."""
        return self._quiet_at - time.monotonic()

    async def quiet(self) -> None:
        """Wait until the user has not typed for a moment."""
        while (pause := self.quiet_for) > 0:  # noqa: ASYNC110
            await asyncio.sleep(pause)

    async def settled(self) -> None:
        """Wait until what was typed so far is analysed, in the context in which it is shown."""
        await self._settled.wait()

    async def published(self) -> None:
        """Wait until something is published that was found in what was typed so far."""
        await self._published.wait()

    # What there is

    @property
    def all(self) -> Mapping[Root, Analysis]:
        """Those that were published last."""
        return self._last.analyses if self._last is not None else {}

    @property
    def findings(self) -> Mapping[str, tuple[Finding, ...]]:
        """What the user is shown of each file."""
        return self._last.findings if self._last is not None else {}

    @property
    def missing(self) -> tuple[Missing, ...]:
        """What of all that open files are launched with this machine does not have."""
        return self._last.missing if self._last is not None else ()

    def of_roots(self) -> list[Analysis]:
        """Those of the roots that reach open files, of those that files are shown in first."""
        return [self.all[root] for root in self.wanted() if root in self.all]

    def of(self, path: str) -> Iterator[Analysis]:
        """Those that reach a file, the one that it is shown in first."""
        for root in dict.fromkeys((*self._session.choice.of(path), *self.all)):
            analysis = self.all.get(root)
            if analysis is not None and analysis.document(path) is not None:
                yield analysis

    def is_current(self, analysis: Analysis) -> bool:
        """Whether an analysis is of the texts as they were when something was published last."""
        return self._last is not None and analysis.launch not in self._last.outdated

    # Which roots are analysed

    def wanted(self) -> list[Root]:
        """The roots to be analysed: for each open file the one that it is shown in, then the others."""
        return list(dict.fromkeys((*self._shown(), *self._session.choice.others())))

    def _shown(self) -> list[Root]:
        """The roots that open files are shown in."""
        return list(dict.fromkeys(root for _, root in self._session.choice.shown()))

    # How a change becomes findings

    def _mark_settled(self) -> None:
        self._published.set()
        self._settled.set()
        self.calm.set()

    async def _refresh(self) -> None:
        """Ask for what files are shown in at once, for the rest when the user pauses."""
        has_looked = False
        try:
            while True:
                self._news.clear()
                workspace = await self._session.workspace()
                self._session.choice.settle(workspace)
                shown = self._shown()
                if not await self._ask(workspace, shown) or shown != self._shown():
                    continue
                self._mark_settled()
                if not await self._pauses() or not await self._ask_others(workspace, shown):
                    continue
                if has_looked:
                    break
                # Not every client tells of what changes on the disk, and none of all that launches depend on.
                has_looked = True
                if await self._session.in_pool(workspace.refresh):
                    self.ask_again()
                elif not self._news.is_set():
                    break
        finally:
            self._mark_settled()
        self._session.runs.wake()
        if self._branching is None or self._branching.done():
            self._branching = self._server.spawn(self._look_into_branches(workspace))

    async def _look_into_branches(self, workspace: Workspace) -> None:
        """Evaluate what conditions leave out, while all that is shown is up to date: no edit waits for it, and the next
        one ends it."""
        with contextlib.suppress(asyncio.CancelledError):
            if not await self._pauses(PAUSE_BEFORE_BRANCHES) or not self._settled.is_set():
                return  # they are looked into at the next pause
            for root in self.wanted():
                found = None
                rounds = 0
                while found is None or (rounds < MAX_ROUNDS and await self._session.runs.of_branches(found.asked)):
                    rounds += found is not None
                    try:
                        found = await self._session.in_pool(
                            partial(branches_of, workspace, root, lambda: self._session.is_closed)
                        )
                    except Exception as error:
                        _log.exception("the branches of %s could not be evaluated", root)
                        found = Branches(failures=(Failure.of(error, root.path),))
                    if not self._settled.is_set() or not self._session.uses(workspace):
                        return  # likewise
                if await self._session.in_pool(partial(workspace.set_branches, root, found)):
                    self.ask_again()
                    return  # likewise

    async def _pauses(self, more: float = 0) -> bool:
        """Wait until the user has paused for some seconds `more`; whether nothing came before that."""
        while not self._news.is_set() and (pause := self.quiet_for + more) > 0:
            with contextlib.suppress(asyncio.TimeoutError):
                await asyncio.wait_for(self._news.wait(), pause)
        return not self._news.is_set()

    async def _ask_others(self, workspace: Workspace, shown: Collection[Root]) -> bool:
        """Ask for the roots that no file is shown in, one after another; whether nothing came before that."""
        for root in self.wanted():
            if root not in shown and not await self._ask(workspace, [root], only_news=True):
                return False
        return True

    async def _ask(self, workspace: Workspace, asked: Collection[Root], *, only_news: bool = False) -> bool:
        """Ask for some roots, and put the findings of all of them together; whether that is the last word."""
        snapshot = self._snapshot(asked, only_news)
        try:
            round_ = await self._session.in_pool(lambda: snapshot.round(workspace))
        except Exception as error:
            _log.exception("the findings of %s could not be merged", asked)
            for root in asked:
                self._server.report_failure(Failure.of(error, root.path))
            return not self._news.is_set()
        if round_ is None or self._news.is_set() or self._session.is_closed:
            return False  # superseded by a newer text
        if round_ is not self._last:
            self._commit(round_)
        self._published.set()
        if round_.large:
            self._settled.set()
        return not round_.preliminary

    def _snapshot(self, asked: Collection[Root], only_news: bool) -> Snapshot:
        session, choice = self._session, self._session.choice
        return Snapshot(
            asked,
            list(dict.fromkeys((*self.wanted(), *asked))),
            {root: session.runs.results(root) for root in asked},
            frozenset((*choice.chosen, *session.indexing.named)),
            frozenset(self._shown()),
            choice.chosen,
            self._build_files(),
            self._awaited(),
            session.indexing.made,
            self._last,
            only_news,
            self._server.texts,
            self._shows_related,
            self._server.shown_pages,
        )

    def _awaited(self) -> dict[Root, frozenset[str]]:
        """The files of the roots that are still to be analysed."""
        entries = self._session.indexing.index.entries
        new = (root for root in self.wanted() if root not in self.all)
        return {r: frozenset((*entries[r].files, *entries[r].inputs)) for r in new if r in entries}

    def _build_files(self) -> list[str]:
        """The open ones of this folder."""
        texts, of = self._server.texts, self._server.session_of
        return [each.path for each in texts if each.path and is_build_file(each) and of(each.uri) is self._session]

    def _commit(self, round_: Round) -> None:
        self._last = round_
        for failure in round_.failures:
            self._server.report_failure(failure)
        current = [a.tree.inputs for root, a in round_.analyses.items() if root not in round_.outdated]
        clean = {
            path: list[types.Diagnostic]()
            for path in self._session.choice.open
            if any(path in inputs for inputs in current)
        }
        clean |= {path: [] for path in self._build_files()}
        self._server.publisher.update(self._session, {**clean, **round_.diagnostics}, self._edited)
        for callback in self._server.after_analysis:
            callback()

    @property
    def _shows_related(self) -> bool:
        document = self._server.client_capabilities.text_document
        publish = document.publish_diagnostics if document else None
        pull = document.diagnostic if document else None
        return bool((publish and publish.related_information) or (pull and pull.related_information))
