"""Questions about a workspace, answered from memory as long as what they were answered from is unchanged."""

from __future__ import annotations

import ast
import os
import threading
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import Place
from preflight_analysis.environment.detect import SETTINGS_FILE
from preflight_analysis.environment.executables import ExecutableIndex
from preflight_analysis.environment.model import Environment
from preflight_analysis.environment.view import of_generation, seen_from
from preflight_analysis.evaluation.commands import Commands, NoResults
from preflight_analysis.evaluation.launch import evaluate_launch
from preflight_analysis.evaluation.ros1.memo import Memo
from preflight_analysis.evaluation.ros2.params import sections_for_any_name
from preflight_analysis.evaluation.taken_over import taken_over
from preflight_analysis.evaluation.tree import CommandValue, LaunchNode, LaunchTree
from preflight_analysis.findings.finding import Finding
from preflight_analysis.findings.severities import Severities, adjusted
from preflight_analysis.graph.build import build_graph
from preflight_analysis.graph.model import Graph
from preflight_analysis.incremental.kept import Kept
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.nodl.installed import NodlFiles
from preflight_analysis.rules.registry import run_rules
from preflight_analysis.rules.rule import Context
from preflight_analysis.source.analyse import SourceAnalysis
from preflight_analysis.source.fallback import Fallback
from preflight_analysis.tracing import preload
from preflight_analysis.tracing.interface import Interface
from preflight_analysis.tracing.parameter_server import SharedParams
from preflight_analysis.tracing.recipe import is_python
from preflight_analysis.tracing.request import TraceRequest, split_args
from preflight_analysis.tracing.similar import SimilarTraces
from preflight_analysis.workspace.index import Root
from preflight_analysis.workspace.not_run import not_run
from preflight_analysis.workspace.observations import Notes
from preflight_analysis.workspace.project_settings import (
    ProjectSettings,
    from_settings,
    located_problems,
    read_project_settings,
)
from preflight_analysis.workspace.resolve_node_names import resolve_node_names
from preflight_analysis.workspace.sources import Sources

MAX_ANALYSES = 64
"""How many analyses are remembered, the latest."""


@dataclass(frozen=True)
class Analysis:
    """Everything known of one root. `documents` has each text that a location in it may point into, by path."""

    root: str
    args: tuple[tuple[str, str], ...]
    tree: LaunchTree
    documents: Mapping[str, Document]
    launch_files: Mapping[str, LaunchFile]
    environment: Environment
    context: Context
    """What the rules get to see."""
    severities: tuple[Severities, ...] = ()
    """Those that the settings want."""

    @property
    def graph(self) -> Graph | None:
        """Who talks to whom, None while the interfaces are not there yet."""
        return self.context.graph

    @property
    def why_not_run(self) -> str | None:
        """Why no node was run, None when they were."""
        return self.context.why_not_run

    @cached_property
    def findings(self) -> tuple[Finding, ...]:
        """What all rules say. They are run when this is first asked for: where the graph follows, only with that."""
        found = run_rules(self.context)
        if self.tree.edited:
            found = [each for each in found if not self._of_replaced_text(each)]
        return adjusted(found, self.severities)

    def _of_replaced_text(self, finding: Finding) -> bool:
        """Whether it speaks of what a Python file was, where it was edited since."""
        edited = self.tree.edited.get(finding.location.file)
        return edited is not None and edited.replaces(finding.location.span)

    @property
    def launch(self) -> Root:
        """The root with the arguments that it was launched with."""
        return Root(self.root, self.args)


@dataclass(frozen=True, slots=True)
class _View:
    """What launch files of one generation see, those that mean the same packages; and what was found by it."""

    environment: Environment
    executables: ExecutableIndex
    nodl: NodlFiles
    source: SourceAnalysis
    fallback: Fallback
    memo: Memo


class Workspace:
    """The engine behind server and command. Thread-safe.

    `cwd` is what relative paths in launch files are relative to, the folder where roslaunch would be called.
    `commands` knows what commands of parameters gave; none was run where it is left out. `similar` knows what
    executables did under other configurations.
    """

    def __init__(
        self,
        environment: Environment,
        sources: Sources,
        cwd: str | None = None,
        commands: Commands | None = None,
        similar: SimilarTraces | None = None,
    ) -> None:
        self.environment = environment
        self.sources = sources
        sources.undecided = environment.generation
        self.commands = commands or NoResults()
        self.cwd = cwd or environment.workspace or os.getcwd()
        self._views: dict[object, _View] = {}
        self._generations: dict[int, Environment] = {}
        self._similar = similar
        self._project: tuple[str, ProjectSettings] | None = None
        self._ahead: tuple[Analysis, Analysis] | None = None
        self._lock = threading.Lock()
        self._memo_lock = threading.Lock()
        self._static: dict[tuple[str, tuple[tuple[str, str], ...]], Analysis] = {}

    @property
    def executables(self) -> ExecutableIndex:
        """The executables on the disk; a new index after each `refresh`."""
        return self._common.executables

    @property
    def _common(self) -> _View:
        """What launch files of the environment's generation see, those that mean no other packages than most."""
        return self._view_of(self._of_generation(self.environment.generation))

    def environment_of(self, path: str) -> Environment:
        """The environment as a launch file sees it."""
        return self._view(path).environment

    def _view(self, path: str) -> _View:
        found = self.sources.launch_file(path)
        generation = self.environment.generation if isinstance(found, Unreadable) else found.generation
        return self._view_of(seen_from(self._of_generation(generation), path))

    def _of_generation(self, generation: int) -> Environment:
        known = self._generations.get(generation)
        if known is None:
            known = self._generations[generation] = of_generation(self.environment, generation)
        return known

    def _view_of(self, environment: Environment) -> _View:
        key = environment.generation, tuple(environment.meant.items())
        with self._lock:
            view = self._views.get(key)
            if view is None:
                source = SourceAnalysis(environment, self.sources)
                view = self._views[key] = _View(
                    environment,
                    ExecutableIndex(environment, self.sources),
                    NodlFiles(environment, self.sources),
                    source,
                    Fallback(source, self._similar),
                    Memo(),
                )
        return view

    def component(self, package: str, cls: str) -> Place | None:
        """Where the class of a component is defined; None where its source is not there."""
        return self._common.source.component(package, cls)

    def entry_point(self, path: str, function: str) -> Place | None:
        """Where a module defines the function that a console script calls."""
        tree = self._common.source.tree(path)
        defined = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)
        body = tree.body if tree is not None else ()
        lines = [each.lineno for each in body if isinstance(each, defined) and each.name == function]
        return Place(path, lines[-1]) if lines else None

    def static(self, path: str, args: Mapping[str, str] | None = None) -> Analysis:
        """What can be said of `path` launched with `args` without running anything."""
        path = os.path.normpath(path)
        args = args or {}
        key = (path, tuple(sorted(args.items())))
        with self._lock:
            known = self._static.get(key)
        severities = self._project_settings().severities
        if known is not None and known.severities == severities and self.is_current(known.tree):
            return known
        view, tree, documents, launch_files = self.sources.in_one_revision(
            lambda: self._looked_into(path, args, known),
            files=lambda found: found[1].inputs,
            likely=known.tree.inputs if known is not None else (),
        )
        context = Context(
            path,
            tree,
            documents,
            launch_files,
            view.environment,
            view.executables,
            self.sources,
            kept=Kept(known.context.kept if known is not None else None),
        )
        analysis = Analysis(path, key[1], tree, documents, launch_files, view.environment, context, severities)
        with self._lock:
            self._static.pop(key, None)
            self._static[key] = analysis
            if len(self._static) > MAX_ANALYSES:
                del self._static[next(iter(self._static))]
        return analysis

    def _looked_into(
        self, path: str, args: Mapping[str, str], known: Analysis | None
    ) -> tuple[_View, LaunchTree, dict[str, Document], dict[str, LaunchFile]]:
        view = self._view(path)
        tree = self._remembering_tree(path, args, view)
        if known is not None:
            tree = taken_over(tree, known.tree)
        return view, tree, *self._documents(tree)

    def tree(self, path: str, args: Mapping[str, str], notes: Notes | None = None) -> LaunchTree:
        """What `path` launched with `args` would start; not remembered. `notes` are taken of what it is made from."""
        view = self._view(path)
        if notes is None:
            return self._evaluate(path, args, view, None)
        environment = replace(view.environment, variables=notes.variables(view.environment.variables))
        commands = notes.commands(self.commands)
        return evaluate_launch(path, args, self.sources, view.executables, environment, self.cwd, commands)

    def _remembering_tree(self, path: str, args: Mapping[str, str], view: _View) -> LaunchTree:
        # One thread at a time has the memo; another one does without.
        if not self._memo_lock.acquire(blocking=False):
            return self._evaluate(path, args, view, None)
        try:
            return self._evaluate(path, args, view, view.memo)
        finally:
            self._memo_lock.release()

    def _evaluate(self, path: str, args: Mapping[str, str], view: _View, memo: Memo | None) -> LaunchTree:
        return evaluate_launch(
            path, args, self.sources, view.executables, view.environment, self.cwd, self.commands, memo
        )

    def refresh(self) -> None:
        """Look at the disk again: executables may have come or gone."""
        self.sources.look()
        with self._lock:
            self._views.clear()
            self._static.clear()

    def requests(self, analysis: Analysis) -> tuple[TraceRequest | None, ...]:
        """How to run each node of the tree; None for one that cannot be run, for what is not known or not there."""
        if analysis.tree.ros.own_parameters:
            return tuple(self._ros2_request(node, analysis.documents) for node in analysis.tree.nodes)
        values = analysis.tree.params.values()
        params = SharedParams({p.name: p.value for p in values if not isinstance(p.value, CommandValue)})
        return tuple(_request(node, params) for node in analysis.tree.nodes)

    def cannot_run(self, tree: LaunchTree) -> str | None:
        """What the environment lacks for running any node of the tree."""
        lacks = tree.ros.needs_rclpy and self.environment.ros2_python is None
        return "there is no rclpy to run it with; ros-preflight doctor shows where it was looked for" if lacks else None

    def _ros2_request(self, node: LaunchNode, documents: Mapping[str, Document]) -> TraceRequest | None:
        """How to run a node of ROS 2: one that is written in Python, where there is a rclpy for it, or a program."""
        path = node.resolved.path
        if path is None or node.unknowns or node.kind not in ("node", "lifecycle"):
            return None
        if node.resolved.entry_point is not None or is_python(path):
            if self.environment.ros2_python is None:
                return None
        elif not preload.applies(path):
            return None
        return TraceRequest(
            node.name,
            node.package,
            path,
            split_args(node.args),
            tuple((remap.source, remap.target) for remap in node.remaps),
            params={f"{node.name}/{p.name}": p.value for p in node.params if not isinstance(p.value, CommandValue)},
            env=node.env,
            cwd=node.cwd,
            generation=2,
            entry_point=node.resolved.entry_point,
            named=node.named,
            sections=sections_for_any_name(node, documents),
            launch=node.location.file,
        )

    def with_interfaces(
        self,
        analysis: Analysis,
        interfaces: Sequence[Interface],
        why_not_run: str | None,
        previous: Analysis | None = None,
    ) -> Analysis:
        """The analysis with the graph that the interfaces (one a node of the tree, in order) make, and all findings.

        `why_not_run` says why nothing was executed, None where it was. `previous` is what this came to for the same
        root before: what has not changed since is taken over.
        """
        kept = Kept(previous.context.kept if previous is not None else None)
        tree = resolve_node_names(analysis.tree, interfaces, analysis.documents)
        if tree is not analysis.tree:
            analysis = _under_names(analysis, tree)
        project = self._project_settings()
        whole = self._filled_in(tree, interfaces, project, kept)
        of_source = resolve_node_names(tree, whole, analysis.documents)
        if of_source is not tree:
            analysis = _under_names(analysis, of_source)
            whole = self._filled_in(of_source, interfaces, project, kept)
        graph = build_graph(
            analysis.tree, whole, project.external_topics, self.environment.distro, analysis.documents, kept
        )
        document, problems = located_problems(project)
        context = replace(
            analysis.context,
            graph=graph,
            why_not_run=why_not_run,
            executables=self._view(analysis.root).executables,
            settings_problems=problems,
            kept=kept,
        )
        documents = analysis.documents if document is None else {**analysis.documents, document.path: document}
        return replace(analysis, context=context, documents=documents, severities=project.severities)

    def ahead_of_runs(self, analysis: Analysis) -> Analysis:
        """The analysis with what is known without a run of the nodes whose run has not ended: while a node is being
        written, what its source declares can be proposed before it has run once."""
        if analysis.graph is None:
            interfaces = [not_run(node) for node in analysis.tree.nodes]
        elif any(interface.pending for interface in analysis.graph.processes):
            pairs = zip(analysis.tree.nodes, analysis.graph.processes, strict=True)
            interfaces = [not_run(node) if each.pending else each for node, each in pairs]
        else:
            return analysis
        known = self._ahead
        if known is None or known[0] is not analysis:
            known = self._ahead = analysis, self.with_interfaces(analysis, interfaces, analysis.why_not_run)
        return known[1]

    def _filled_in(
        self, tree: LaunchTree, interfaces: Sequence[Interface], project: ProjectSettings, kept: Kept
    ) -> Sequence[Interface]:
        """The interfaces with what is known beside runs."""
        interfaces = from_settings(tree, interfaces, project.nodes)
        view = self._view(tree.file)
        return view.fallback.fill_in(tree, view.nodl.fill_in(tree, interfaces, kept), kept)

    def _project_settings(self) -> ProjectSettings:
        """The settings file of the workspace as it is now."""
        folder = self.environment.workspace
        if folder is None:
            return ProjectSettings()
        digest = self.sources.digest(os.path.join(folder, SETTINGS_FILE))
        known = self._project
        if known is None or known[0] != digest:
            known = self._project = digest, read_project_settings(folder)
        return known[1]

    def is_current(self, tree: LaunchTree) -> bool:
        """Whether nothing that it was made of has changed since."""
        return all(self.sources.digest(path) == known for path, known in tree.inputs.items()) and all(
            self.commands.result(command.line) == command.result for command in tree.commands
        )

    def _documents(self, tree: LaunchTree) -> tuple[dict[str, Document], dict[str, LaunchFile]]:
        launch_files: dict[str, LaunchFile] = {}
        documents: dict[str, Document] = {}
        for path in tree.files:
            found = self.sources.launch_file(path, tree.generation)
            if not isinstance(found, Unreadable):
                launch_files[path] = found
                documents[path] = found.document
        for path in tree.inputs:
            if path not in documents:
                text = self.sources.text(path)
                if not isinstance(text, Unreadable):
                    documents[path] = text
        return documents, launch_files


def _under_names(analysis: Analysis, tree: LaunchTree) -> Analysis:
    """The analysis with the tree in which nodes have the names that their own code gives them."""
    return replace(analysis, tree=tree, context=replace(analysis.context, tree=tree))


def _request(node: LaunchNode, params: Mapping[str, object]) -> TraceRequest | None:
    if node.unknowns or node.resolved.path is None:
        return None
    args = split_args(node.args)
    remaps = tuple((remap.source, remap.target) for remap in node.remaps)
    file = node.location.file
    return TraceRequest(
        node.name, node.package, node.resolved.path, args, remaps, params, node.env, node.cwd, launch=file
    )
