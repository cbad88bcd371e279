"""Questions about a workspace, answered from memory as long as what they were answered from is unchanged."""

from __future__ import annotations

import ast
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property, partial

from preflight_analysis.catalogue.launches import catalogued_file
from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import Location, Place
from preflight_analysis.environment.detect import SETTINGS_FILE
from preflight_analysis.environment.executables import ExecutableIndex
from preflight_analysis.environment.installed_paths import package_around
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.environment.packages import package_of
from preflight_analysis.environment.variables import with_queried_variables
from preflight_analysis.environment.view import meaning, meant_by, of_generation
from preflight_analysis.evaluation.commands import EDITION, CommandResult, Commands, NoResults, QueriedCommands
from preflight_analysis.evaluation.inversion import Assignment, arguments_and_variables
from preflight_analysis.evaluation.launch import evaluate_launch, outline_of
from preflight_analysis.evaluation.meanings import KnownMeanings
from preflight_analysis.evaluation.partial_text import is_whole
from preflight_analysis.evaluation.ros2.params import sections_for_any_name
from preflight_analysis.evaluation.ros2.python_runs import parse_request
from preflight_analysis.evaluation.ros2.spawners import with_spawned
from preflight_analysis.evaluation.surroundings import Surroundings
from preflight_analysis.evaluation.taken_over import taken_over
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree, NotTaken, nothing_launched
from preflight_analysis.findings.failure import Failure
from preflight_analysis.findings.finding import Finding
from preflight_analysis.findings.offered import with_offered_fixes
from preflight_analysis.findings.severities import Severities, adjusted
from preflight_analysis.generation import ros
from preflight_analysis.graph.bare_types import with_packages
from preflight_analysis.graph.build import build_graph
from preflight_analysis.graph.model import Graph
from preflight_analysis.incremental.database import Cancelled, Database
from preflight_analysis.incremental.kept import Kept
from preflight_analysis.incremental.query import query
from preflight_analysis.interfaces.merge import merged
from preflight_analysis.interfaces.part import Launch
from preflight_analysis.interfaces.plugins import PluginIndex
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.recognize import FileKind
from preflight_analysis.model.behavior_trees import trees_of
from preflight_analysis.model.context import Context
from preflight_analysis.model.installation import build_files_of, packages_in
from preflight_analysis.model.loose_param_files import loose_param_files
from preflight_analysis.robot.sources import documents_of
from preflight_analysis.rules.registry import (
    all_rules,
    found_in_branch,
    found_in_file,
    found_in_loose_files,
    found_in_packages,
    found_in_supposed,
    run_rules,
    without_suppressed,
)
from preflight_analysis.source.analyse import SourceAnalysis
from preflight_analysis.tracing import preload
from preflight_analysis.tracing.interface import Interface
from preflight_analysis.tracing.parameter_server import SharedParams
from preflight_analysis.tracing.recipe import is_python
from preflight_analysis.tracing.request import TraceRequest, split_args
from preflight_analysis.tracing.similar import SimilarTraces
from preflight_analysis.workspace.branches import BRANCHES, Branches, WhatIf, branches_of
from preflight_analysis.workspace.components import Containers
from preflight_analysis.workspace.index import Root
from preflight_analysis.workspace.not_run import not_run
from preflight_analysis.workspace.own_knowledge import OwnKnowledge, own_knowledge
from preflight_analysis.workspace.project_settings import (
    ProjectSettings,
    located_problems,
    project_settings_of,
)
from preflight_analysis.workspace.resolve_node_names import resolve_node_names
from preflight_analysis.workspace.run_results import RESULTS, RunResults
from preflight_analysis.workspace.sources import TEXTS_BEFORE, Sources
from preflight_analysis.workspace.supposed_launch import WithSupposed, supposed_launch

MAX_ANALYSES = 64
"""How many analyses are remembered, the latest."""
MAX_WHAT_IFS_KEPT = 96
"""How many launches with other arguments, for the tags that these take."""
MAX_READINGS_KEPT = 1_000
"""How many readings of Python launch files, and of calls of their code."""
_MAX_AHEAD = 2
"""The same of those that were completed without runs, for who types just now."""
_MAX_AROUND = 10
"""Tags within each other that conditions leave out."""


@dataclass(frozen=True, eq=False)
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
    of_texts: bool = False
    """Whether only those rules are asked that do without graph and sources."""
    before_names: LaunchTree | None = None
    """The tree before nodes got the names that their own code gives them; None where none has another one."""

    @property
    def evaluated(self) -> LaunchTree:
        """The tree as the launch files name its nodes. What is run, and what runs tell, goes by these names: those that
        a run tells would be other ones before and after it."""
        return self.before_names or self.tree

    @property
    def graph(self) -> Graph | None:
        """Who talks to whom, None while the interfaces are not there yet."""
        return self.context.graph

    @property
    def why_not_run(self) -> str | None:
        """Why no node was run, None when they were."""
        return self.context.why_not_run

    failures_of_branches: tuple[Failure, ...] = ()
    """The rules that raised on the tags that the launch leaves out."""

    @property
    def findings(self) -> tuple[Finding, ...]:
        """What all rules say. They are run when this is first asked for."""
        return self._judgement[0]

    @property
    def failures(self) -> tuple[Failure, ...]:
        """The rules that raised, whose findings are missing; all rules are run for that, too."""
        return tuple(dict.fromkeys((*self._judgement[1], *self.failures_of_branches)))

    @cached_property
    def _judgement(self) -> tuple[tuple[Finding, ...], tuple[Failure, ...]]:
        failures: list[Failure] = []
        rules = [rule for rule in all_rules() if not rule.of_sources] if self.of_texts else None
        found = run_rules(self.context, rules, failures)
        self.context.kept.end()
        if self.tree.edited:
            found = [each for each in found if not self._of_replaced_text(each)]
        return adjusted(found, self.severities), tuple(failures)

    @cached_property
    def offered(self) -> tuple[Finding, ...]:
        """The findings with those of their fixes that may be offered."""
        return with_offered_fixes(self.findings, self.text)

    def text(self, path: str) -> str | None:
        """The text of any file; None where it is not known."""
        document = self.document(path) or self.context.document(path)
        return document.text if document is not None else None

    def _of_replaced_text(self, finding: Finding) -> bool:
        """Whether it speaks of what a Python file was, where it was edited since."""
        edited = self.tree.edited.get(finding.location.file)
        return edited is not None and edited.replaces(finding.location.span)

    def with_branches(self, branches: Branches) -> Analysis:
        """The analysis with what was found in tags that it leaves out, as far as its text is still the same."""
        if not branches.findings and not branches.failures:
            return self
        context = replace(self.context, documents={**branches.documents, **self.documents})
        found = tuple(finding for finding, text in branches.findings if context.text(finding.location) == text)
        return replace(self, context=replace(context, of_branches=found), failures_of_branches=branches.failures)

    def document(self, path: str) -> Document | None:
        """The text of a launch file or of one that is handed over, as the analysis has it; None of any other."""
        found = self.documents.get(path)
        if found is None and path.endswith(".xml"):
            parts = (part for loaded in trees_of(self.context) for part in loaded.parts)
            found = next((part.document for part in parts if part.path == path), None)
        return found

    @property
    def reached(self) -> frozenset[str]:
        """The files that were read for it."""
        return frozenset((*self.tree.inputs, *self.documents))

    def reaches(self, path: str) -> bool:
        """Whether a file is one of them, or of those that only the context knows."""
        return path in self.tree.inputs or self.document(path) is not None

    @property
    def all_documents(self) -> Mapping[str, Document]:
        """The documents with those that only what is left out reaches."""
        return {**self.context.documents, **self.documents}

    @property
    def documents_of_findings(self) -> Mapping[str, Document]:
        """All documents, and those of files that no launch file names: a Python launch file reads them itself."""
        documents = self.all_documents
        others = {finding.location.file for finding in self.findings}.difference(documents)
        found = {path: self.context.disk.text(path) for path in others}
        return {**documents, **{path: text for path, text in found.items() if isinstance(text, Document)}}

    @property
    def launch(self) -> Root:
        """The root with the arguments that it was launched with."""
        return Root(self.root, self.args)


class Workspace:
    """The engine behind server and command. Thread-safe.

    `cwd` is what relative paths in launch files are relative to, the folder where roslaunch would be called.
    `commands` knows what commands of parameters gave; none was run where it is left out. `similar` knows what
    executables did under other configurations. `chosen` are severities that a command wants: they count more than
    those of the settings for all files. Without `reads` Python launch files are only run.
    """

    def __init__(
        self,
        environment: Environment,
        sources: Sources,
        cwd: str | None = None,
        commands: Commands | None = None,
        similar: SimilarTraces | None = None,
        *,
        chosen: Sequence[Severities] = (),
        reads: bool = True,
    ) -> None:
        self.environment = environment
        self._chosen = tuple(chosen)
        self.reads = reads
        self.sources = sources
        sources.undecided = environment.generation
        sources.access = environment.access
        self.commands = commands or NoResults()
        self.cwd = cwd or environment.workspace or os.getcwd()
        self._similar = similar

    @property
    def executables(self) -> ExecutableIndex:
        """Those that most launch files of the environment's generation see."""
        return _executables(self.sources.db, self, self._common)

    def executables_in(self, environment: Environment) -> ExecutableIndex:
        """Those that launch files see which see that environment."""
        return ExecutableIndex(environment, self.sources)

    @property
    def _common(self) -> Environment:
        """What most launch files of the environment's generation see."""
        return _of_generation(self.sources.db, self.environment, self.environment.generation)

    def environment_of(self, path: str) -> Environment:
        """The environment as a launch file sees it."""
        found = self.sources.launch_file(path)
        generation = self._generation_of(self.package_of(path)) if isinstance(found, Unreadable) else found.generation
        db = self.sources.db
        environment = _of_generation(db, self.environment, generation)
        meant = meant_by(environment, path)
        return _meaning(db, environment, meant) if meant else environment

    def component(self, package: str, cls: str) -> Place | None:
        """Where the class of a component is defined; None where its source is not there."""
        return SourceAnalysis(self._common, self.sources).component(package, cls)

    def entry_point(self, path: str, function: str) -> Place | None:
        """Where a module defines the function that a console script calls."""
        tree = SourceAnalysis(self._common, self.sources).tree(path)
        defined = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)
        body = tree.body if tree is not None else ()
        lines = [each.lineno for each in body if isinstance(each, defined) and each.name == function]
        return Place(path, lines[-1]) if lines else None

    def static(self, path: str, args: Mapping[str, str] | None = None) -> Analysis:
        """What can be said of `path` launched with `args` without running anything.

        The files that it was made of the last time are looked at; what else there is on the disk is as it was when it
        was last looked at (`refresh`).
        """
        root = self._looked_at(path, args)
        return _static(self.sources.db, self, root.path, root.args)

    def of_texts(self, path: str, args: Mapping[str, str] | None = None) -> Analysis:
        """As `static` without the rules that read the sources of programs: it is there seconds earlier, at first."""
        return replace(self.evaluated(path, args), of_texts=True)

    def analysed(self, path: str, args: Mapping[str, str] | None = None) -> Analysis:
        """All that is known of `path` launched with `args`, by what is known of its runs (`set_results`). The disk is
        looked at as for `static`. While the first runs are under way it says nothing of the graph."""
        root = self._looked_at(path, args)
        return _analysed(self.sources.db, self, root.path, root.args)

    def evaluated(self, path: str, args: Mapping[str, str] | None = None) -> Analysis:
        """As `static` for who has no need of findings: they are made when they are asked for."""
        root = self._looked_at(path, args)
        return _evaluated(self.sources.db, self, root.path, root.args)

    def set_results(self, root: Root, results: RunResults) -> None:
        """What is known now of the runs of the nodes of a root."""
        db = self.sources.db
        if RESULTS(db, self, root) != results:
            with db.writing() as write:
                write.set(RESULTS, results, self, root)

    def set_branches(self, root: Root, branches: Branches) -> bool:
        """What is known now of the tags that a root leaves out; whether that is something else than before."""
        db = self.sources.db
        if BRANCHES(db, self, root) == branches:
            return False
        with db.writing() as write:
            write.set(BRANCHES, branches, self, root)
        return True

    def look_at(self, roots: Iterable[Root]) -> None:
        """Look at the files that these were made of the last time, and at what runs gave meanwhile."""
        files = {*self._settings_files}
        for root in roots:
            known = _evaluated.last(self.sources.db, self, root.path, root.args)
            files.update(known.tree.inputs if known is not None else (root.path,))
        self.sources.look(files)
        self.look_at_results()

    def _looked_at(self, path: str, args: Mapping[str, str] | None) -> Root:
        root = Root.of(os.path.normpath(path), args or {})
        if not self.sources.db.is_reading:
            self.look_at([root])
        return root

    def tree(self, path: str, args: Mapping[str, str]) -> LaunchTree:
        """What `path` launched with `args` would start; not remembered. The results of commands are those of the last
        `look_at_results`."""
        return evaluate_launch(path, args, self._within(path))

    def outline(self, path: str, args: Mapping[str, str]) -> LaunchTree:
        """As `tree`, of what the index keeps: files, includes, and nodes by their names."""
        return outline_of(path, args, self._within(path))

    def _within(self, path: str) -> Surroundings:
        return _surroundings(self.sources.db, self, self.environment_of(path))

    def look_at_results(self) -> None:
        """Notice results of commands that came, and what executables did elsewhere meanwhile."""
        db = self.sources.db
        if self._similar is not None:
            self._similar.look()
        if db.is_outdated(EDITION, self.commands):
            with db.writing() as write:
                write.reload(EDITION, self.commands)

    def refresh(self) -> bool:
        """Look at all of the disk that something depends on; whether anything has changed."""
        return self.sources.look()

    def close(self) -> None:
        """Another workspace takes the place of this one: what was remembered for it is forgotten."""
        self.sources.db.forget(self)

    def requests(self, analysis: Analysis) -> tuple[TraceRequest | None, ...]:
        """How to run each node of the evaluated tree; None for one that cannot be run, for what is not known or not
        there."""
        tree = analysis.evaluated
        if tree.ros.own_parameters:
            containers = Containers(tree, analysis.context.executables)
            return tuple(self._ros2_request(node, analysis.documents, containers) for node in tree.nodes)
        params = SharedParams({p.name: p.value for p in tree.params.values() if is_whole(p.value)})
        return tuple(_request(node, params) for node in tree.nodes)

    def _ros2_request(
        self, node: LaunchNode, documents: Mapping[str, Document], containers: Containers
    ) -> TraceRequest | None:
        """How to run a node of ROS 2: one that is written in Python, a program, or a component."""
        path = node.resolved.path
        params = {f"{node.name}/{p.name}": p.value for p in node.params if is_whole(p.value)}
        if node.kind == "composable":
            return containers.request(node, params, documents)
        if path is None or node.unknowns or node.kind not in ("node", "lifecycle", "container"):
            return None
        if node.resolved.entry_point is None and not is_python(path) and not preload.applies(path):
            return None
        return TraceRequest(
            node.name,
            node.package,
            path,
            split_args(node.args),
            tuple((remap.source, remap.target) for remap in node.remaps),
            params=params,
            env=node.env,
            cwd=node.cwd,
            generation=2,
            entry_point=node.resolved.entry_point,
            named=node.named,
            sections=sections_for_any_name(node, documents),
            launch=node.location.file,
        )

    def branches(self, analysis: Analysis, stops: Callable[[], bool] = lambda: False) -> Branches:
        """What is found in the tags and parameter files that a static analysis leaves out. It takes several evaluations
        of the launch, which are remembered. It raises `Cancelled` when it `stops`, and within `Database.reading` where
        somebody writes meanwhile."""
        db, path = self.sources.db, analysis.root

        failures: dict[Failure, None] = {}

        def ask(args: Assignment, assumed: frozenset[Location]) -> WhatIf:
            if stops():
                raise Cancelled
            what_if, failed = _what_if(db, self, path, tuple(sorted(args.items())), assumed)
            failures.update(dict.fromkeys(failed))
            return what_if

        def ask_params(args: Assignment, assumed: frozenset[Location]) -> tuple[Finding, ...]:
            if stops():
                raise Cancelled
            found, failed = _params_if(db, self, path, tuple(sorted(args.items())), assumed)
            failures.update(dict.fromkeys(failed))
            return found

        found = branches_of(analysis.tree, analysis.launch_files, dict(analysis.args), ask, ask_params)
        found = found.with_others(self._found_in_loose_files(analysis.context), self.sources)
        return replace(found, failures=tuple(failures))

    def findings_of_packages(
        self, packages: Iterable[Package], *, param_files: bool = False
    ) -> tuple[tuple[Finding, ...], Mapping[str, Document]]:
        """What is wrong with how packages are built that no launch has to do with, and the texts of the files; with
        their parameter files too, which takes longer, if these are asked for."""
        found: list[Finding] = []
        for each in packages:
            found += found_in_packages(self.sources, self.environment, (each,))
            loose = self._found_in_loose_files(self._context_of(each.manifest, each)) if param_files else ()
            found += without_suppressed(self.sources, loose)
        return self._with_texts(tuple(found))

    def findings_of_file(self, path: str, kind: FileKind) -> tuple[tuple[Finding, ...], Mapping[str, Document]]:
        """What is wrong with a file that is no launch file, and the texts of the files."""
        package = self.package_of(path)
        found = found_in_file(self._context_of(path, package), kind, package)
        if kind == "parameter file":
            found = tuple(_with_further(found, without_suppressed(self.sources, self._as_supposed(path))))
        return self._with_texts(found)

    def _found_in_loose_files(self, context: Context) -> Iterator[Finding]:
        """What is wrong with files that no node of a launch gets."""
        found = list(found_in_loose_files(context))
        supposed = (each for path in loose_param_files(context) for each in self._as_supposed(path))
        yield from _with_further(found, without_suppressed(self.sources, supposed))

    def _as_supposed(self, path: str) -> tuple[Finding, ...]:
        """What rules say of a parameter file of ROS 2 where the nodes get it that it has sections for."""
        return _as_supposed(self.sources.db, self, path)

    def package_of(self, path: str) -> Package | None:
        """The package that a file is in, also one that is ignored where packages are looked for."""
        return package_around(self.environment, path) or package_of(path)

    def _context_of(self, path: str, package: Package | None) -> Context:
        """What there is to ask of a file that is no launch file."""
        generation = self._generation_of(package)
        environment = _of_generation(self.sources.db, self.environment, generation)
        tree = nothing_launched(path, generation)
        return _of_tree(self.sources.db, self, Root(path), tree, environment).context

    def _generation_of(self, package: Package | None) -> int:
        return package.generation if package is not None else self.environment.generation

    def _with_texts(self, found: tuple[Finding, ...]) -> tuple[tuple[Finding, ...], Mapping[str, Document]]:
        found = adjusted(found, self.settings.severities)
        texts = {path: self.sources.text(path) for path in {each.location.file for each in found}}
        documents = {path: text for path, text in texts.items() if isinstance(text, Document)}
        return with_offered_fixes(found, self.sources.content), documents

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
        db = self.sources.db
        tree = resolve_node_names(analysis.tree, interfaces, analysis.documents, analysis.context.known)
        if tree is not analysis.tree:
            analysis = _under_names(analysis, tree)
        project = self.settings
        managed = with_spawned(tree, analysis.documents)
        whole = self._merged(managed, interfaces, analysis.documents, kept)
        of_source = resolve_node_names(tree, whole[: len(tree.nodes)], analysis.documents, analysis.context.known)
        if of_source is not tree:
            analysis = _under_names(analysis, of_source)
            managed = with_spawned(of_source, analysis.documents)
            whole = self._merged(managed, interfaces, analysis.documents, kept)
        db.leave_if_cancelled()
        seen = self.environment_of(tree.file)
        typed = with_packages(whole, self.sources, seen, tree.generation, kept)
        graph = build_graph(managed, typed, project.external_topics, seen, analysis.documents, kept)
        document, problems = located_problems(project)
        own = self.own_knowledge
        context = replace(
            analysis.context,
            graph=graph,
            why_not_run=why_not_run,
            settings_problems=(*problems, *own.problems),
            own_knowledge=own.files,
            kept=kept,
        )
        more = (*own.documents, *((document,) if document is not None else ()))
        documents = {**analysis.documents, **{each.path: each for each in more}} if more else analysis.documents
        return replace(analysis, context=context, documents=documents, severities=project.severities)

    def ahead_of_runs(self, analysis: Analysis) -> Analysis:
        """The analysis with what is known without a run of the nodes whose run has not ended: while a node is being
        written, what its source declares can be proposed before it has run once."""
        return _ahead_of_runs(self.sources.db, self, analysis)

    def taking(self, analysis: Analysis, file: str, offset: int) -> tuple[Analysis, NotTaken | None]:
        """What the launch would be if it took the tags around an offset which their conditions leave out, as far as
        that is known without runs of its nodes, and the outermost of these tags; the analysis itself where there are
        none, or where the file is included another time and takes them."""
        left_out: dict[Location, NotTaken] = {}
        supposed = _known_if if analysis.graph is not None else _if
        while len(left_out) < _MAX_AROUND:
            found = _left_out_around(analysis.tree, file, offset)
            if found is None or found.origin[-1] in left_out:
                break
            left_out[found.origin[-1]] = found
            assumed = frozenset(left_out)
            analysis = supposed(self.sources.db, self, analysis.root, analysis.args, assumed)
        return analysis, next(iter(left_out.values()), None)

    def _merged(
        self, tree: LaunchTree, runs: Sequence[Interface], documents: Mapping[str, Document], kept: Kept
    ) -> Sequence[Interface]:
        """What the nodes do, by what runs told and all else that is known of them; those of simulated nodes last."""
        environment = self.environment_of(tree.file)
        known = KnownMeanings(self.own_knowledge.files, environment.distro, tree.generation)
        settings = self.settings.nodes
        return merged(Launch(tree, environment, documents, self.sources, kept, known, settings, self._similar), runs)

    @property
    def _settings_files(self) -> tuple[str, ...]:
        folder = self.environment.workspace
        if folder is None:
            return ()
        return (os.path.join(folder, SETTINGS_FILE), *(path for path, _ in self.settings.knowledge))

    @property
    def settings(self) -> ProjectSettings:
        """The settings file of the workspace."""
        folder = self.environment.workspace
        settings = project_settings_of(self.sources.db, folder) if folder is not None else ProjectSettings()
        if not self._chosen:
            return settings
        everywhere = [each for each in settings.severities if each.pattern is None]
        by_path = [each for each in settings.severities if each.pattern is not None]
        return replace(settings, severities=(*everywhere, *self._chosen, *by_path))

    @property
    def own_knowledge(self) -> OwnKnowledge:
        """What the user's files say of parameters."""
        folder = self.environment.workspace
        return own_knowledge(self.sources.db, folder) if folder is not None else OwnKnowledge()

    def texts_of(self, tree: LaunchTree) -> tuple[dict[str, Document], dict[str, LaunchFile]]:
        """All that places in a tree may lead to, and what of it are launch files that somebody here may mend."""
        launch_files: dict[str, LaunchFile] = {}
        documents: dict[str, Document] = {}
        for path in tree.files:
            found = self.sources.launch_file(path, tree.generation)
            if not isinstance(found, Unreadable):
                documents[path] = found.document
                if catalogued_file(path) is None:
                    launch_files[path] = found
        one_of_folder = {os.path.dirname(path): path for path in launch_files}
        around = map(self._manifest_around, one_of_folder.values())
        manifests = {manifest for manifest in around if manifest is not None}
        packages = packages_in(self.environment_of(tree.file), launch_files, tree.nodes)
        build_files = (path for package in packages for path in build_files_of(self.sources, package))
        for path in (*tree.inputs, *sorted(manifests), *build_files):
            if path not in documents:
                text = self.sources.text(path)
                if not isinstance(text, Unreadable):
                    documents[path] = text
        for path, document in documents_of(tree, self.sources, self.environment_of(tree.file)).items():
            documents.setdefault(path, document)
        return documents, launch_files

    def _manifest_around(self, path: str) -> str | None:
        """The manifest of the package that a launch file is in."""
        package = package_around(self.environment, path)
        return package.manifest if package is not None else None


@query
def _of_generation(db: Database, environment: Environment, generation: int) -> Environment:
    return with_queried_variables(db, of_generation(environment, generation))


@query
def _meaning(db: Database, environment: Environment, packages: tuple[Package, ...]) -> Environment:
    return meaning(environment, packages)


@query
def _executables(db: Database, workspace: Workspace, environment: Environment) -> ExecutableIndex:
    return workspace.executables_in(environment)


@query
def _plugins(db: Database, workspace: Workspace, environment: Environment) -> PluginIndex:
    return PluginIndex(environment, workspace.sources)


@query
def _surroundings(db: Database, workspace: Workspace, environment: Environment) -> Surroundings:
    executables = _executables(db, workspace, environment)
    commands = QueriedCommands(db, workspace.commands, _Reader(db, workspace, environment))
    knowledge = workspace.own_knowledge.files
    return Surroundings(workspace.sources, executables, environment, workspace.cwd, commands, knowledge)


class _Reader:
    """Implements `evaluation.commands.Reader`."""

    def __init__(self, db: Database, workspace: Workspace, environment: Environment) -> None:
        self._db, self._workspace, self._environment = db, workspace, environment

    def reading(self, line: str) -> CommandResult | None:
        """The answer to a request for a run."""
        return _reading(self._db, self._workspace, self._environment, line)

    def texts_before(self, path: str) -> tuple[str, ...]:
        """Texts that an open file had before."""
        return TEXTS_BEFORE(self._db, path)


@query(limit=MAX_READINGS_KEPT)
def _reading(db: Database, workspace: Workspace, environment: Environment, line: str) -> CommandResult | None:
    """What reading a Python launch file says in the place of a run."""
    from preflight_analysis.tracing.reading.answers import tell  # noqa: PLC0415 - who has none starts faster

    request = parse_request(line) if workspace.reads else None
    told = tell(environment, workspace.sources, request) if request is not None else None
    return CommandResult("done", told) if told is not None else None


@query(limit=MAX_WHAT_IFS_KEPT)
def _if(
    db: Database,
    workspace: Workspace,
    path: str,
    args: tuple[tuple[str, str], ...],
    assumed: frozenset[Location],
) -> Analysis:
    """A launch with other arguments, as if it took some tags whatever their conditions are."""
    within = _surroundings(db, workspace, workspace.environment_of(path))
    given, variables = arguments_and_variables(dict(args))
    # What is taken against its condition, or with other variables, is not remembered for launches where it is not so.
    by_parts = not assumed and not variables
    tree = evaluate_launch(path, given, within, by_parts=by_parts, assumed=assumed, variables=variables)
    return _of_tree(db, workspace, Root(path, args), tree, within.environment)


def _of_tree(db: Database, workspace: Workspace, root: Root, tree: LaunchTree, environment: Environment) -> Analysis:
    documents, launch_files = workspace.texts_of(tree)
    index, plugins = _executables(db, workspace, environment), _plugins(db, workspace, environment)
    context = Context(root.path, tree, documents, launch_files, environment, index, plugins, workspace.sources)
    return Analysis(root.path, root.args, tree, documents, launch_files, environment, context)


@query(limit=MAX_WHAT_IFS_KEPT)
def _what_if(
    db: Database,
    workspace: Workspace,
    path: str,
    args: tuple[tuple[str, str], ...],
    assumed: frozenset[Location],
) -> tuple[WhatIf, tuple[Failure, ...]]:
    known = _if(db, workspace, path, args, assumed)
    # Whoever waits to write does not wait for all rules: reading anything raises then.
    pause = partial(_executables, db, workspace, known.environment)
    failures: list[Failure] = []
    found = tuple(each for each in found_in_branch(known.context, pause, failures) if each.lack is None)
    return WhatIf(known.tree, known.documents, known.launch_files, found), tuple(failures)


@query(limit=MAX_WHAT_IFS_KEPT)
def _known_if(
    db: Database,
    workspace: Workspace,
    path: str,
    args: tuple[tuple[str, str], ...],
    assumed: frozenset[Location],
) -> Analysis:
    """Likewise with what is known of the nodes, of which none was run for that."""
    known = _if(db, workspace, path, args, assumed)
    interfaces = [not_run(node, known.context.executables) for node in known.tree.nodes]
    return workspace.with_interfaces(known, interfaces, None)


@query(limit=MAX_WHAT_IFS_KEPT)
def _params_if(
    db: Database,
    workspace: Workspace,
    path: str,
    args: tuple[tuple[str, str], ...],
    assumed: frozenset[Location],
) -> tuple[tuple[Finding, ...], tuple[Failure, ...]]:
    """What the rules of parameters say of a launch with other arguments, of whose nodes none was run for that."""
    known = _known_if(db, workspace, path, args, assumed)
    pause = partial(_executables, db, workspace, known.environment)
    failures: list[Failure] = []
    return tuple(each for each in found_in_branch(known.context, pause, failures) if each.lack is None), tuple(failures)


@query
def _as_supposed(db: Database, workspace: Workspace, path: str) -> tuple[Finding, ...]:
    environment, package = workspace.environment_of(path), workspace.package_of(path)
    executables, document = _executables(db, workspace, environment), workspace.sources.text(path)
    if package is None or not ros(package.generation).own_parameters or not isinstance(document, Document):
        return ()
    launch = supposed_launch(db, environment, executables, package, document)
    if launch is None:
        return ()
    within = replace(_surroundings(db, workspace, environment), files=WithSupposed(workspace.sources, *launch))
    tree = evaluate_launch(launch.path, {}, within)
    static = _of_tree(db, workspace, Root(launch.path), tree, environment)
    known = workspace.with_interfaces(static, [not_run(node, executables) for node in tree.nodes], None)
    return tuple(found_in_supposed(known.context, path))


def _with_further(found: Iterable[Finding], further: Iterable[Finding]) -> Iterator[Finding]:
    """Findings, with those of places of which they say nothing."""
    places = set()
    for each in found:
        places.add(each.location)
        yield each
    yield from (each for each in further if each.location not in places)


def _left_out_around(tree: LaunchTree, file: str, offset: int) -> NotTaken | None:
    """The outermost tag around an offset that no inclusion of the file takes."""
    found = [n for n in tree.not_taken if n.origin[-1].file == file and n.action.span.contains(offset)]
    around = min(found, key=lambda each: each.action.span.start, default=None)
    origins = (*(node.origin for node in tree.nodes), *(include.origin for include in tree.includes))
    if around is None or any(
        step.file == file and around.action.span.contains(step.span.start) for origin in origins for step in origin
    ):
        return None
    return around


@query(limit=MAX_ANALYSES)
def _evaluated(db: Database, workspace: Workspace, path: str, args: tuple[tuple[str, str], ...]) -> Analysis:
    known: Analysis | None = db.previous
    within = _surroundings(db, workspace, workspace.environment_of(path))
    tree = evaluate_launch(path, dict(args), within, by_parts=True)
    if known is not None:
        tree = taken_over(tree, known.tree)
    found = _of_tree(db, workspace, Root(path, args), tree, within.environment)
    return replace(found, severities=workspace.settings.severities)


@query(limit=MAX_ANALYSES)
def _static(db: Database, workspace: Workspace, path: str, args: tuple[tuple[str, str], ...]) -> Analysis:
    before = db.previous
    return _judged(_going_on(_evaluated(db, workspace, path, args), before))


@query(limit=MAX_ANALYSES)
def _analysed(db: Database, workspace: Workspace, path: str, args: tuple[tuple[str, str], ...]) -> Analysis:
    before, root = db.previous, Root(path, args)
    analysis, results = _evaluated(db, workspace, path, args), RESULTS(db, workspace, root)
    analysis = analysis.with_branches(BRANCHES(db, workspace, root))
    if results.awaited and any(request is not None for request in workspace.requests(analysis)):
        return _judged(_going_on(analysis, before))
    return _judged(
        workspace.with_interfaces(analysis, *results.of(analysis.tree, analysis.context.executables), before)
    )


def _going_on(analysis: Analysis, before: Analysis | None) -> Analysis:
    """The analysis, for which is taken over what was the same before."""
    kept = Kept(before.context.kept if before is not None else None)
    return replace(analysis, context=replace(analysis.context, kept=kept))


def _judged(analysis: Analysis) -> Analysis:
    """The analysis with its findings: what the rules look at is part of what the query was made of."""
    _ = analysis.findings
    return analysis


@query(limit=_MAX_AHEAD)
def _ahead_of_runs(db: Database, workspace: Workspace, analysis: Analysis) -> Analysis:
    executables = analysis.context.executables
    if analysis.graph is None:
        interfaces = [not_run(node, executables) for node in analysis.tree.nodes]
    elif any(interface.pending for interface in analysis.graph.processes):
        pairs = zip(analysis.tree.nodes, analysis.graph.processes, strict=True)
        interfaces = [not_run(node, executables) if each.pending else each for node, each in pairs]
    else:
        return analysis
    return workspace.with_interfaces(analysis, interfaces, analysis.why_not_run)


def _under_names(analysis: Analysis, tree: LaunchTree) -> Analysis:
    """The analysis with the tree in which nodes have the names that their own code gives them."""
    context = replace(analysis.context, tree=tree)
    return replace(analysis, tree=tree, before_names=analysis.evaluated, context=context)


def _request(node: LaunchNode, params: Mapping[str, object]) -> TraceRequest | None:
    if node.unknowns or node.resolved.path is None:
        return None
    args = split_args(node.args)
    remaps = tuple((remap.source, remap.target) for remap in node.remaps)
    file = node.location.file
    return TraceRequest(
        node.name, node.package, node.resolved.path, args, remaps, params, node.env, node.cwd, launch=file
    )
