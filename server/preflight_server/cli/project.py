"""From the command line to an analysed launch file."""

from __future__ import annotations

import argparse
import os
import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import field
from functools import cached_property
from typing import TYPE_CHECKING

from preflight_analysis.dataclass import dataclass
from preflight_analysis.environment.model import Environment
from preflight_analysis.findings.printable import printable
from preflight_analysis.findings.report import place, relative
from preflight_analysis.findings.severities import Severities
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.interface import Interface
from preflight_analysis.tracing.kept_traces import KeptTraces
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.schedule import trace_all
from preflight_analysis.tracing.similar import SimilarTraces
from preflight_analysis.workspace.branches import Branches
from preflight_analysis.workspace.commands import CommandResults, run_commands
from preflight_analysis.workspace.index import Root
from preflight_analysis.workspace.resolve_commands import MAX_ROUNDS, Resolving, resolve_together
from preflight_analysis.workspace.run_results import NodeKey, RunResults, node_keys
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Analysis, Workspace

from preflight_server.cli import options
from preflight_server.cli.errors import BROKEN
from preflight_server.cli.output import say, say_failures
from preflight_server.cli.progress import Progress

if TYPE_CHECKING:
    from preflight_analysis.tracing.commands import CommandRunner

NO_RUN = "--no-run was given"


@dataclass(frozen=True, slots=True)
class Project:
    """A launch file in its environment, statically analysed."""

    workspace: Workspace
    analysis: Analysis

    @property
    def environment(self) -> Environment:
        """What the nodes would run with."""
        return self.workspace.environment

    def with_results(self) -> Analysis:
        """The analysis as it is by what is known of runs."""
        return self.workspace.analysed(self.analysis.root, dict(self.analysis.args))


def open_project(args: argparse.Namespace) -> Project:
    """Analyse FILE with its arguments. The commands of its parameters are run in the sandbox, unless with --no-run.

    Raises `CannotDoError` for a file that is not there.
    """
    path = options.launch_file(args)
    values = options.launch_args(args.launch_args, path)
    return analyse(path, values, options.environment(args, path), args)


def analyse(
    path: str,
    values: Mapping[str, str],
    environment: Environment,
    args: argparse.Namespace,
    *,
    similar: bool = True,
) -> Project:
    """The same in an environment that is known. `similar`: whether what executables did elsewhere is of interest."""
    return open_workspace(environment, args, similar=similar).analysed(path, values)


@dataclass(frozen=True)
class OpenWorkspace:
    """A workspace of which several files are analysed. The commands of parameters are run in the sandbox, unless with
    `--no-run`."""

    workspace: Workspace
    results: CommandResults
    no_run: bool
    _tried: set[str] = field(default_factory=set)

    def analysed(self, path: str, values: Mapping[str, str]) -> Project:
        """A launch file with its arguments."""
        self.run_commands([Root.of(path, values)])
        return Project(self.workspace, self.workspace.evaluated(path, values))

    def branches(self, analysis: Analysis) -> Branches:
        """What is found in the tags that an analysis leaves out, once the Python launch files are run that these
        include."""
        found = self.workspace.branches(analysis)
        for _ in range(MAX_ROUNDS):
            lines = [line for line in found.asked if line not in self._tried]
            if self.no_run or not lines:
                break
            self._tried.update(lines)
            cancel = threading.Event()
            try:
                self.results.update(run_commands(self._runner, lines, cancel))
            except KeyboardInterrupt:
                cancel.set()
                raise
            self.workspace.look_at_results()
            found = self.workspace.branches(analysis)
        return found

    @cached_property
    def _runner(self) -> CommandRunner:
        from preflight_analysis.tracing.commands import CommandCache, CommandRunner  # noqa: PLC0415, seldom needed

        return CommandRunner(self.workspace.environment, self.workspace.cwd, CommandCache(), self.workspace.sources)

    def run_commands(self, roots: Sequence[Root]) -> None:
        """Run what has to be run before these are known, side by side."""
        if self.no_run:
            return
        waiting = [root for root in roots if self.workspace.evaluated(root.path, dict(root.args)).tree.commands]
        if not waiting:
            return
        cancel = threading.Event()
        try:
            resolve_together(self.workspace, waiting, Resolving(self.results, self._runner, cancel), tried=self._tried)
        except KeyboardInterrupt:
            cancel.set()
            raise


def open_workspace(
    environment: Environment, args: argparse.Namespace, *, similar: bool = True, chosen: Sequence[Severities] = ()
) -> OpenWorkspace:
    """The workspace of an environment; `similar` as for `analyse`, `chosen` as for `Workspace`."""
    results = CommandResults(lambda: NO_RUN if args.no_run else None)
    sources = Sources()
    elsewhere = SimilarTraces(TraceCache(), environment, sources) if similar else None
    workspace = Workspace(environment, sources, commands=results, similar=elsewhere, chosen=chosen)
    return OpenWorkspace(workspace, results, args.no_run)


def run_nodes(project: Project, args: argparse.Namespace, only: str | None = None) -> Analysis:
    """The analysis with the interfaces of all nodes (or of the one named `only`), run in the sandbox, as
    the common options say. Where nothing may be run, earlier runs tell that would have the same result. A terminal
    shows how far it is.

    Interrupting it stops the runs.
    """
    progress = Progress(1)
    progress.step(0, printable(relative(project.analysis.root, os.getcwd())))
    try:
        run_nodes_together([project], args, only, progress.part, progress.running)
    finally:
        progress.end()
    return project.with_results()


def run_nodes_together(
    projects: Sequence[Project],
    args: argparse.Namespace,
    only: str | None = None,
    report: Callable[[int, int], None] = lambda done, total: None,
    running: Callable[[Sequence[str]], None] = lambda names: None,
) -> None:
    """As `run_nodes`, of several launch files of one workspace: what one has to wait for keeps no other one waiting.
    What is known of them then is in `Project.with_results`. `running` is told the nodes that are run right now."""
    if not projects:
        return
    workspace, environment, cache = projects[0].workspace, projects[0].environment, TraceCache()
    kept = KeptTraces(environment, cache, disk=workspace.sources)
    runs = [_Runs.of(project, kept, only) for project in projects]
    missing = [(each, key) for each in runs for key in each.requests if key not in each.found]
    # Trying the sandbox starts processes: not where nothing is left to be run.
    why = _why_not(args.no_run) if missing or not all(each.found for each in runs) else None
    if why is None and missing:
        cancel = threading.Event()
        total = sum(len(each.requests) for each in runs)

        def done(index: int, interface: Interface) -> None:
            each, key = missing[index]
            each.found[key] = interface
            under_way.pop(index, None)
            running([*under_way.values()])
            report(sum(len(each.found) for each in runs), total)

        # Who has to run nothing starts faster without.
        from preflight_analysis.tracing.trace import Tracer  # noqa: PLC0415

        tracer = Tracer(environment, cache, disk=workspace.sources)
        requests = [each.requests[key] for each, key in missing]
        under_way: dict[int, str] = {}

        def begun(index: int) -> None:
            under_way[index] = requests[index].node
            running([*under_way.values()])

        try:
            trace_all(tracer, requests, workers=args.jobs, on_begin=begun, on_done=done, cancel=cancel)
        except KeyboardInterrupt:
            cancel.set()
            raise
    for project, each in zip(projects, runs, strict=True):
        is_known = bool(each.found) and each.requests.keys() == each.found.keys()
        workspace.set_results(project.analysis.launch, RunResults(each.found, None if is_known else why))


@dataclass(frozen=True, slots=True)
class _Runs:
    """What is run for a launch file, and what is known of that, by the keys of nodes."""

    requests: Mapping[NodeKey, TraceRequest]
    found: dict[NodeKey, Interface]

    @classmethod
    def of(cls, project: Project, kept: KeptTraces, only: str | None) -> _Runs:
        """With what is known without a run."""
        nodes = zip(node_keys(project.analysis.tree), project.workspace.requests(project.analysis), strict=True)
        requests = {key: request for key, request in nodes if request is not None and only in (None, key[0])}
        found = {key: hit for key, request in requests.items() if (hit := kept.lookup(request)) is not None}
        return cls(requests, found)


def _why_not(no_run: bool) -> str | None:
    if no_run:
        return NO_RUN
    from preflight_analysis.tracing import sandbox  # noqa: PLC0415, likewise

    status = sandbox.probe()
    return None if status.works else status.reason or "no sandbox works on this machine"


def say_errors(analysis: Analysis) -> None:
    """What would stop the launcher, on standard error."""
    for finding in analysis.findings:
        if finding.stops_launch:
            where = place(finding.location, analysis.documents, os.getcwd())
            say(f"{where}: {finding.severity} {finding.rule}: {finding.message}")


def exit_code(analysis: Analysis, fail_on: str) -> int:
    """1 if the launcher would stop, however severe that is, for verbs that show something else than findings. Errors of
    ours are said first."""
    say_failures(analysis.failures)
    if analysis.failures:
        return BROKEN
    return int(fail_on != options.NEVER and any(finding.stops_launch for finding in analysis.findings))
