"""Runs of nodes in the sandbox: when they may start, and which are needed."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import threading
from collections import Counter
from collections.abc import Callable, Collection, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import field
from typing import TYPE_CHECKING, Literal

from preflight_analysis.dataclass import dataclass
from preflight_analysis.tracing import sandbox
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.interface import Interface
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.schedule import likeness, run_all
from preflight_analysis.tracing.trace import Tracer
from preflight_analysis.workspace.broken import Broken
from preflight_analysis.workspace.index import Root
from preflight_analysis.workspace.run_results import NodeKey, RunResults, node_keys
from preflight_analysis.workspace.workspace import Analysis, Workspace

from preflight_server.lsp.command_runs import CommandRuns
from preflight_server.lsp.markup import counted
from preflight_server.lsp.node_results import NodeResults
from preflight_server.lsp.progress import Progress

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer
    from preflight_server.lsp.session import Session

_log = logging.getLogger(__name__)

SWITCHED_OFF = "the setting rosPreflight.runNodes is off"
NOT_TRUSTED = "the workspace is not trusted; trust it to run its nodes in the sandbox"
CANCELLED = "the runs were cancelled; save the file to start them again"
FIRST_RUNS = 24
"""Nodes of a launch that are run before others have their turn, and twice as many each time thereafter: all of it is
analysed again after that."""
NotRunSince = Literal["off", "untrusted", "cancelled", "sandbox"]
_KINDS: Mapping[str, NotRunSince] = {SWITCHED_OFF: "off", NOT_TRUSTED: "untrusted", CANCELLED: "cancelled"}


@dataclass(frozen=True, slots=True)
class _Job:
    """One run of a batch. `cancel` is its own: what an edit makes obsolete is ended, and the others go on."""

    request: TraceRequest
    fresh: bool = False
    """Whether a run is wanted, whatever earlier ones told."""
    begun: threading.Event = field(default_factory=threading.Event, compare=False)
    cancel: threading.Event = field(default_factory=threading.Event, compare=False)

    def run(self, tracer: Tracer) -> Interface:
        """In a thread."""
        self.begun.set()
        return tracer.trace(self.request, self.cancel, fresh=self.fresh)


@dataclass(frozen=True, slots=True)
class _Batch:
    root: Root
    jobs: Mapping[NodeKey, _Job]
    progress: Progress
    done: set[NodeKey] = field(default_factory=set)
    cancelled: threading.Event = field(default_factory=threading.Event)

    def stop(self) -> None:
        """End all of it."""
        self.cancelled.set()
        for job in self.jobs.values():
            job.cancel.set()


def report(
    loop: asyncio.AbstractEventLoop, callback: Callable[[int, Interface], None], index: int, what: Interface
) -> None:
    """Call `callback` on the loop; on a loop that has ended in the meantime nobody waits for it."""
    with contextlib.suppress(RuntimeError):
        loop.call_soon_threadsafe(callback, index, what)


class Runs:
    """The runs of one session. Everything but the runs themselves happens on the event loop."""

    def __init__(self, server: PreflightServer, session: Session, *, trusted: bool) -> None:
        self._server = server
        self._session = session
        self._trusted = trusted
        self._no_sandbox: str | None = None
        self._probed = False
        self._cancelled = False
        self._closing = False
        self.commands = CommandRuns(server, session, lambda: self.why_not_run)
        self._tracer: Tracer | None = None
        self._results = NodeResults()
        self._fresh: dict[Root, set[NodeKey]] = {}
        """Nodes that the user wants to be run anew."""
        self._batch: _Batch | None = None
        self._cut_off: Root | None = None
        """The root of the last batch where that did not have all of its nodes: now others have their turn."""
        self._turns: Counter[Root] = Counter()
        """How often a root was cut off since all of its nodes were known."""
        self._not_before = 0.0
        self._wanted = False
        self._loop: asyncio.Task[None] | None = None
        self._pool = ThreadPoolExecutor(1, thread_name_prefix="runs")

    @property
    def not_run_since(self) -> NotRunSince | None:
        """Which kind of thing keeps nodes from being run; None when they are."""
        why = self.why_not_run
        return _KINDS.get(why, "sandbox") if why is not None else None

    @property
    def why_not_run(self) -> str | None:
        """Why nodes are not run, for the user; None when they are."""
        if not self._session.settings.run_nodes:
            return SWITCHED_OFF
        if not self._trusted:
            return NOT_TRUSTED
        return self._no_sandbox or (CANCELLED if self._cancelled else None)

    @property
    def trusted(self) -> bool:
        """Whether the user trusts the workspace."""
        return self._trusted

    def running(self, root: Root) -> tuple[str, ...]:
        """The nodes of a root that run now or wait for their run, those that are shown first in front."""
        batch = self._batch
        if batch is None or batch.root != root:
            return ()
        return tuple(key[0] for key in batch.jobs if key not in batch.done)

    def results(self, root: Root) -> RunResults:
        """What is known of the nodes of a root."""
        return RunResults(self._results.of(root), self.why_not_run, pending=True)

    def set_trusted(self, trusted: bool) -> None:
        """The user's decision; without trust what runs is stopped."""
        self._trusted = trusted
        self._cancelled = False
        if not trusted:
            self.clear()
            self._stop()

    def set_workspace(self, workspace: Workspace) -> None:
        """What nodes and commands are run with."""
        self._tracer = Tracer(workspace.environment, TraceCache(), disk=workspace.sources)
        self.commands.set_workspace(workspace)

    def forget_requests(self) -> None:
        """Files changed: look every interface up again, but keep it until then."""
        self._cancelled = False
        self._results.look_again()
        self.commands.forget()

    def again(self, analysis: Analysis, names: Collection[str] | None = None) -> list[str]:
        """Run nodes anew, all or those of these names, whatever is known of them. Returns which are."""
        self._cancelled = False
        nodes = zip(node_keys(analysis.evaluated), analysis.tree.nodes, strict=True)
        wanted = {key: node.name for key, node in nodes if names is None or node.name in names}
        self._results.look_again_at(analysis.launch, wanted)
        self._fresh.setdefault(analysis.launch, set()).update(wanted)
        self.wake()
        return list(wanted.values())

    def clear(self) -> None:
        """Take back all that runs told."""
        self._cancelled = False
        self._results.clear()
        self.commands.clear()

    def hold(self, seconds: float) -> None:
        """Start no run before `seconds` have passed."""
        self._not_before = asyncio.get_running_loop().time() + seconds

    def wake(self) -> None:
        """See whether something has to be run."""
        if self._closing:
            return
        self._wanted = True
        if self._loop is None or self._loop.done():
            self._loop = self._server.spawn(self._rounds())
            self.commands.reconsider(self._session.analyses.of_roots())  # of branches: that must not keep it waiting
        elif self._batch is not None:
            self._server.spawn(self._reconsider(self._batch))
        else:
            self.commands.reconsider(self._session.analyses.of_roots())

    def closed(self) -> None:
        """A file was closed: what runs for no open one ends."""
        if self._batch is not None and self._batch.root not in self._session.analyses.wanted():
            self._batch.stop()

    def look_again(self) -> None:
        """The user looks at another file: its runs come first."""
        if self._batch is not None:
            self._server.spawn(self._reconsider(self._batch))

    async def of_branches(self, lines: Collection[str]) -> bool:
        """Run the Python launch files that only branches reach, where nodes may be run. Whether to ask again what lines
        there are."""
        if not lines or self._closing:
            return False
        await self._probe()
        async with self._server.turn_to_run:
            if self._closing or self.why_not_run is not None:
                return False
            return await self.commands.more(lines, self._pool)

    def cancel(self, token: int | str) -> None:
        """The user cancelled a batch."""
        if self.commands.cancel(token):
            self._cancelled = True
        if self._batch is not None and self._batch.progress.token == token:
            self._cancelled = True
            self._fresh.clear()
            self._batch.stop()

    def close(self) -> None:
        """Stop what runs and wait for its end."""
        self._closing = True
        self._stop()
        self._pool.shutdown(wait=True, cancel_futures=True)

    def _stop(self) -> None:
        self.commands.stop()
        if self._batch is not None:
            self._batch.stop()

    async def _rounds(self) -> None:
        while self._wanted and not self._closing:
            while (pause := self._not_before - asyncio.get_running_loop().time()) > 0:  # noqa: ASYNC110
                await asyncio.sleep(pause)
            await self._session.analyses.settled()
            self._wanted = False
            await self._probe()
            if self.why_not_run is None:
                for analysis in self._in_turn():
                    async with self._server.turn_to_run:
                        if not self._wanted and not self._closing and self.why_not_run is None:
                            await self._round(analysis)

    def _in_turn(self) -> list[Analysis]:
        """The analysed roots in the order in which their nodes are run: those that the user looks at first."""
        return sorted(self._session.analyses.of_roots(), key=lambda each: each.launch == self._cut_off)

    async def _probe(self) -> None:
        """Find out, once, whether a sandbox works here."""
        if self._probed or self.why_not_run is not None:
            return
        status = await self._session.in_pool(sandbox.probe)
        self._no_sandbox = None if status.works else status.reason or "no sandbox works on this machine"
        self._probed = True
        if self._no_sandbox is not None:
            self._session.analyses.ask_again()

    async def _round(self, analysis: Analysis) -> None:
        """Look up, then run, what is not known of the nodes of one root."""
        tracer, results = self._tracer, self._results
        if tracer is None:
            return
        edition = results.edition
        broken = await self._session.in_pool(lambda: Broken(analysis))
        if await self.commands.round(analysis, self._pool, broken):
            return
        workspace = await self._session.workspace()
        requests = await self._requests(workspace, analysis, broken)
        root = analysis.launch
        if not broken.files:  # else what an error hides comes back
            results.keep(root, requests)
        lacking = results.lacking(root, requests)
        fresh = frozenset(self._fresh.get(root, ()))
        kept = {k: r for k, r in lacking.items() if k not in fresh}
        hits = await self._session.in_pool(lambda: {k: tracer.lookup(r) for k, r in kept.items()})
        found = {k: hit for k, hit in hits.items() if hit is not None}
        news = [results.put(root, k, lacking[k], hit, edition) for k, hit in found.items()]
        if any(news):
            self._session.analyses.ask_again()
        remaining = {k: r for k, r in lacking.items() if k not in found}
        # Trust may have been withdrawn meanwhile.
        if remaining and not self._closing and self.why_not_run is None:
            await self._run(tracer, root, remaining)

    async def _requests(self, workspace: Workspace, analysis: Analysis, broken: Broken) -> dict[NodeKey, TraceRequest]:
        """What to run; not what is being typed: a tag with a syntax error is not worth a run."""
        requests = await self._session.in_pool(lambda: workspace.requests(analysis))
        tree = analysis.evaluated
        asked = zip(node_keys(tree), tree.nodes, requests, strict=True)
        return {key: r for key, node, r in asked if r is not None and not broken.touches(node.origin)}

    async def _run(self, tracer: Tracer, root: Root, requests: Mapping[NodeKey, TraceRequest]) -> None:
        loop = asyncio.get_running_loop()
        focus = self._session.focus
        # The nodes of the file that is being looked at come first.
        keys = sorted(requests, key=lambda key: requests[key].launch != focus)
        most = FIRST_RUNS << self._turns[root]
        is_cut_off, keys = len(keys) > most, keys[:most]
        fresh = self._fresh.get(root, set())
        jobs = [_Job(requests[key], key in fresh) for key in keys]
        progress = Progress(self._server, "Running nodes in the sandbox", "tracing", len(keys))
        batch = self._batch = _Batch(root, dict(zip(keys, jobs, strict=True)), progress)
        edition = self._results.edition
        done = 0
        self._changed()

        def one_done(index: int, interface: Interface) -> None:
            nonlocal done
            done += 1
            batch.done.add(keys[index])
            key, job = keys[index], jobs[index]
            if interface.known or not job.cancel.is_set():
                self._results.put(root, key, job.request, interface, edition)
            self._fresh.get(root, set()).discard(key)
            waiting = self.running(root)
            progress.report(done, len(keys), f"waiting for {waiting[0]}" if waiting else key[0])

        def work() -> None:
            run_all(
                lambda job: job.run(tracer),
                jobs,
                alike=lambda job: likeness(job.request),
                on_done=lambda index, interface: report(loop, one_done, index, interface),
            )

        try:
            await loop.run_in_executor(self._pool, work)
        except asyncio.CancelledError:  # the loop ends; the thread would go on
            batch.stop()
            raise
        finally:
            self._batch = None
            self._cut_off = root if is_cut_off else None
            self._turns[root] = self._turns[root] + 1 if is_cut_off else 0
            self._changed()  # an analysis that has all results already may be the last
            progress.end("cancelled" if batch.cancelled.is_set() else counted(len(keys), "node"))
        self._session.analyses.ask_again()

    def _changed(self) -> None:
        for callback in self._server.when_runs_change:
            callback()

    async def _reconsider(self, batch: _Batch) -> None:
        """End the runs of a batch that the launch file does not ask for any more, and let the root that the user looks
        at now go first. A run that is under way may still tell what is asked for now: that depends on what it reads."""
        roots = self._in_turn()
        analysis = next((a for a in roots if a.launch == batch.root), None)
        if analysis is None:
            batch.stop()
            return
        workspace = await self._session.workspace()
        requests = await self._requests(workspace, analysis, Broken(analysis))
        behind = roots[0].launch != batch.root and await self._wants_runs(workspace, roots[0])
        for key, job in batch.jobs.items():
            now = requests.get(key)
            another = now is None or likeness(now) != likeness(job.request)
            if another or ((behind or now != job.request) and not job.begun.is_set()):
                job.cancel.set()

    async def _wants_runs(self, workspace: Workspace, analysis: Analysis) -> bool:
        requests = await self._requests(workspace, analysis, Broken(analysis))
        return bool(self._results.lacking(analysis.launch, requests))
