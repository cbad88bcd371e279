"""Making the workspace index, and bringing it up to date when files change."""

from __future__ import annotations

import logging
import os
import tempfile
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.python_text import PYTHON_SUFFIX
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.environment.installed_paths import installed_at, package_around
from preflight_analysis.environment.loaded_modules import is_loaded_module
from preflight_analysis.environment.model import Package
from preflight_analysis.environment.packages import walk_unignored
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.generation import ros
from preflight_analysis.launch.model import Action, LaunchFile, Literal, Substitution, Value
from preflight_analysis.launch.recognize import LAUNCH_FOLDER, LAUNCH_SUFFIXES
from preflight_analysis.workspace.facts import FileFacts, facts_of
from preflight_analysis.workspace.index import Inclusion, NodeEntry, Root, RootEntry, WorkspaceIndex
from preflight_analysis.workspace.observations import Notes
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

SKIPPED = frozenset({"build", "devel", "install", "log", "logs", "node_modules"})
"""Folders right below the workspace that hold copies of what is in its source."""

MAX_INCLUDED = 200_000
"""How many includes are evaluated for one index."""
_MAX_UPSTREAM = 100
_log = logging.getLogger(__name__)

Report = Callable[[int, int, str], None]
"""How many of how many are done, and the path that is next."""


@dataclass(frozen=True, slots=True)
class Earlier:
    """An index from before: only what depends on the files that `changed` since is looked at again."""

    index: WorkspaceIndex
    changed: Collection[str] = ()


@dataclass(frozen=True, slots=True)
class Watch:
    """Who waits for an index. `cancelled`, which may wait, is asked before each piece of work, and before one begins
    again since a text changed meanwhile."""

    report: Report = lambda done, total, path: None
    cancelled: Callable[[], bool] = lambda: False


_NOBODY = Watch()


def build_index(
    workspace: Workspace,
    folder: str | None,
    named: Sequence[Root] = (),
    *,
    paths: Sequence[str] | None = None,
    earlier: Earlier | None = None,
    watch: Watch = _NOBODY,
) -> WorkspaceIndex | None:
    """The index of the launch files below `folder`; None when the `watch` cancelled it.

    `named` are the roots that the settings name, `paths` those launch files, where they are known. Runs in a thread of
    its own for as long as it takes; never raises for what files contain.
    """
    known = earlier.index if earlier is not None else WorkspaceIndex()
    stale = frozenset(earlier.changed if earlier is not None else ())
    cancelled = watch.cancelled
    workspace.look_at_results()
    if paths is None:
        paths = launch_files(folder, workspace) if folder is not None else []
    maker = _Maker(workspace, known, stale, watch.report, len(paths), cancelled)
    for path in paths:
        if cancelled():
            return None
        maker.read(path)
    for root in _candidates(paths, named, maker.written):
        if cancelled():
            return None
        maker.enter(root)
    # A file that only a false condition includes, or files that include each other in a circle, are reached by no one.
    upstream = _Upstream(maker.written)
    for path in paths:
        while path not in maker.reached:
            if cancelled():
                return None
            maker.enter(root := Root(upstream.of(path, maker.reached)))
            maker.reached.add(root.path)
    if maker.left_out:
        what = (
            "%s: the launch files include each other more than %d times; who includes whom is not known of %d of them"
        )
        _log.warning(what, folder, MAX_INCLUDED, maker.left_out)
    maker.drop_included(keep=frozenset(named))
    maker.read_reached()
    return WorkspaceIndex(maker.files, maker.entries, tuple(maker.written), complete=True)


def parts_of_index(
    workspace: Workspace, paths: Sequence[str], named: Sequence[Root], step: int
) -> Iterator[WorkspaceIndex]:
    """What `build_index` would make of some of the launch files, `step` of them at a time: what is known of each, then
    the evaluated roots. What only other files include is evaluated as a root, too."""
    maker = _Maker(workspace, WorkspaceIndex(), frozenset(), lambda done, total, path: None, len(paths))
    for start in range(0, len(paths), step):
        some, before = paths[start : start + step], len(maker.written)
        for path in some:
            maker.read(path)
        facts = {path: maker.files[path] for path in some if path in maker.files}
        yield WorkspaceIndex(facts, {}, tuple(maker.written[before:]))
    roots = _candidates(paths, named, maker.written)
    for start in range(0, len(roots), step):
        some_roots = roots[start : start + step]
        for root in some_roots:
            maker.enter(root)
        if maker.left_out:
            break
        yield WorkspaceIndex({}, {root: maker.entries[root] for root in some_roots})


def _candidates(paths: Iterable[str], named: Sequence[Root], written: Iterable[Inclusion]) -> list[Root]:
    """What probably are roots."""
    included = frozenset(i.target for i in written if i.target != i.includer)
    named_paths = {root.path for root in named}
    return [*named, *(Root(p) for p in paths if p not in included and p not in named_paths)]


class _Upstream:
    """Where to begin with files that no root reaches, so that one evaluation reaches many of them."""

    def __init__(self, written: Sequence[Inclusion]) -> None:
        self._includers: dict[str, dict[str, None]] = {}
        for inclusion in written:
            self._includers.setdefault(inclusion.target, {})[inclusion.includer] = None

    def of(self, path: str, reached: Collection[str]) -> str:
        """The unreached file from which at most `_MAX_UPSTREAM` includes that are written lead to `path`; itself where
        it is in a shorter circle. A condition may forbid one of them, so the path is not always reached from there."""
        seen = {path}
        at = path
        while len(seen) <= _MAX_UPSTREAM:
            before = self._includers.get(at, {})
            if path in before and at != path:
                return path
            above = next((each for each in before if each not in reached and each not in seen), None)
            if above is None:
                break
            seen.add(above)
            at = above
        return at


def entry_of(tree: LaunchTree, root: Root) -> RootEntry:
    """What the index keeps of a tree."""
    inclusions = tuple(
        Inclusion(os.path.normpath(i.path), i.file_location, i.origin[-1], dict(i.args), root)
        for i in tree.includes
        if i.path is not None
    )
    nodes = tuple(NodeEntry(n.name, n.package, n.executable, n.location) for n in tree.nodes)
    return RootEntry(root, tree.files, tree.inputs, inclusions, nodes, _unknowns(tree))


def _unknowns(tree: LaunchTree) -> int:
    """How much of a launch is not known, of what an outline has."""
    not_run = sum(command.launch_file and command.result is None for command in tree.commands)
    unnamed = sum("$(" in node.name for node in tree.nodes)
    return len(tree.lacking) + not_run + unnamed + sum(include.path is None for include in tree.includes)


class _Maker:
    def __init__(
        self,
        workspace: Workspace,
        known: WorkspaceIndex,
        stale: frozenset[str],
        report: Report,
        total: int,
        pause: Callable[[], object] = lambda: None,
    ) -> None:
        self._workspace = workspace
        self._known = known
        self._stale = stale
        self._report = report
        self._pause = pause
        self._total = total
        self._written_before: dict[str, list[Inclusion]] = {}
        for inclusion in known.written:
            self._written_before.setdefault(inclusion.includer, []).append(inclusion)
        self.files: dict[str, FileFacts] = {}
        self.entries: dict[Root, RootEntry] = {}
        self.written: list[Inclusion] = []
        self.reached: set[str] = set()
        self._included = 0
        self.left_out = 0
        """Roots that were not evaluated, as there were too many includes before them."""

    def read(self, path: str) -> None:
        """The facts of one file, and the includes that its text shows."""
        facts = self._known.files.get(path) if path not in self._stale else None
        if facts is not None:
            self.files[path] = facts
            self.written += self._written_before.get(path, ())
            return
        notes = Notes(self._workspace.sources)
        found = notes.of(lambda: self._workspace.sources.launch_file(path), self._pause)
        if isinstance(found, Unreadable) or found.root is None:
            return
        self.files[path] = replace(facts_of(found), observations=notes.observations)
        packages = self._workspace.environment_of(path).packages
        self.written += written_includes(found, packages)

    def enter(self, root: Root) -> None:
        """Evaluate a root, unless nothing of it changed."""
        entry = self._known.entries.get(root)
        if entry is None or not self._stale.isdisjoint(entry.inputs):
            self._report(len(self.reached), self._total, root.path)
            if self._included >= MAX_INCLUDED:
                entry = RootEntry(root, (root.path,), {root.path: self._workspace.sources.digest(root.path)}, (), ())
                self.left_out += 1
            else:
                notes = Notes(self._workspace.sources)
                launch = partial(self._workspace.outline, root.path, dict(root.args))
                entry = notes.of(lambda: entry_of(launch(), root), self._pause)
                entry = replace(entry, observations=notes.observations)
                self._included += len(entry.inclusions)
        self.entries[root] = entry
        self.reached.update(entry.files)

    def drop_included(self, keep: frozenset[Root]) -> None:
        """Roots that turned out to be included, by an include whose file only the evaluation could tell."""
        reaching: dict[str, set[Root]] = {}
        for root, entry in self.entries.items():
            for path in entry.files:
                reaching.setdefault(path, set()).add(root)
        for root in list(self.entries):
            # Of files that include each other in a circle the last one stays.
            if root not in keep and any(r != root and r in self.entries for r in reaching.get(root.path, ())):
                del self.entries[root]

    def read_reached(self) -> None:
        """Facts of the files outside of the folder, or of another name, that some root includes."""
        for entry in self.entries.values():
            for path in entry.files:
                if path not in self.files:
                    self.read(path)


def written_includes(launch_file: LaunchFile, packages: Mapping[str, Package]) -> Iterator[Inclusion]:
    """The includes of a file whose target its text tells: literal paths, `$(find package)/...`, `$(dirname)/...`, and
    what a Python program joins of these."""
    if launch_file.root is None:
        return
    for action in launch_file.root.walk():
        if action.kind == "include" and (file := action.value("file")) is not None:
            target = _written_path(file, launch_file.path, packages)
            if target is not None:
                place, tag = launch_file.document.location(file.span), launch_file.document.location(action.head_span)
                yield Inclusion(target, place, tag, _no_args(action), None)


def _no_args(action: Action) -> dict[str, str | None]:
    return {name.text: None for child in action.children if child.kind == "arg" and (name := child.value("name"))}


def _written_path(value: Value, path: str, packages: Mapping[str, Package]) -> str | None:
    text = _written_text(value.parts, path, packages)
    return os.path.normpath(text) if text is not None and os.path.isabs(text) else None


def _written_text(parts: Iterable[Literal | Substitution], path: str, packages: Mapping[str, Package]) -> str | None:
    text = ""
    for part in parts:
        if isinstance(part, Literal):
            text += part.text
        elif part.command in ("find", "find-pkg-share") and part.arguments in packages:
            text += packages[part.arguments].share
        elif part.command == "dirname":
            text += os.path.dirname(path)
        elif part.command == "path-join":
            words = [_written_text(word, path, packages) for word in part.words]
            if not words or None in words:
                return None
            text += os.path.join(*(word for word in words if word is not None))
        else:
            return None
    return text


def launch_files(folder: str, workspace: Workspace) -> list[str]:
    """The launch files below a workspace, without those of ROS 2 that colcon ignores. In Python that is what is called
    like one, and what makes a launch description where it lies in a launch folder or is installed. A folder that is
    nobody's workspace (`/tmp`, the home folder), taken for one because a file in it was opened alone, is not walked:
    only its own files count."""
    found: list[str] = []
    for place, folders, names, ignored in walk_unignored(folder, SKIPPED):
        if place in (tempfile.gettempdir(), os.path.expanduser("~"), "/"):
            folders.clear()
        in_launch_folder = LAUNCH_FOLDER in place.split(os.sep)
        for name in names:
            path = os.path.join(place, name)
            placed = in_launch_folder or name.endswith(LAUNCH_SUFFIXES) or not name.endswith(PYTHON_SUFFIX)
            if (placed or _is_shared(workspace, path)) and _is_launch_file(path, workspace.sources, ignored=ignored):
                found.append(path)
    return sorted(found)  # a folder's own order changes with each file that is replaced


def _is_shared(workspace: Workspace, path: str) -> bool:
    """Whether a package installs the file beside its other files, and not as one of its modules or programs."""
    package = package_around(workspace.environment, path)
    return package is not None and bool(installed_at(workspace.sources, package, path))


def _is_launch_file(path: str, sources: Sources, *, ignored: bool) -> bool:
    is_one = sources.launch_format(path) is not None and not (ignored and _is_of_ament(path, sources))
    return is_one and not is_loaded_module(sources, path)


def _is_of_ament(path: str, sources: Sources) -> bool:
    found = sources.launch_file(path)
    return not isinstance(found, Unreadable) and ros(found.generation).ament
