"""What a query that looks across files has to go by: a launch file with the analyses of the roots that reach it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import cached_property

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.evaluation.tree import LaunchTree, NotTaken
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.queries.places import shown_path
from preflight_analysis.workspace.facts import FileFacts, facts_of
from preflight_analysis.workspace.index import WorkspaceIndex
from preflight_analysis.workspace.indexing import entry_of, written_includes
from preflight_analysis.workspace.workspace import Analysis, Workspace


@dataclass(frozen=True)
class QueryContext:
    """A launch file with all that is known around it. `analyses` are of roots that reach it, the one that it is shown
    in first; `index` may be older than they are. Make a new one for each question."""

    path: str
    analyses: tuple[Analysis, ...]
    index: WorkspaceIndex
    workspace: Workspace

    @cached_property
    def current(self) -> WorkspaceIndex:
        """The index, with what the analyses know better: they are of the texts as they are now."""
        return with_analyses(self.index, self.analyses)

    @cached_property
    def trees(self) -> tuple[LaunchTree, ...]:
        """What the analysed roots start."""
        return tuple(analysis.tree for analysis in self.analyses)

    @cached_property
    def all_trees(self) -> tuple[LaunchTree, ...]:
        """What every root starts that reaches the file: those that were not analysed are evaluated now."""
        return self.trees_around((self.path,))

    def trees_around(self, paths: Iterable[str]) -> tuple[LaunchTree, ...]:
        """What every root starts that reaches the file (`all_trees`, first), or one of these paths: as a launch file or
        another that it reads."""
        known = {analysis.launch for analysis in self.analyses}
        roots = dict.fromkeys(self.current.roots_of(self.path))
        for path in (self.path, *paths):
            roots.update(dict.fromkeys(self.current.roots_touching(path)))
        others = (root for root in roots if root not in known)
        return (*self.trees, *(self.workspace.tree(root.path, dict(root.args)) for root in others))

    def taking(self, offset: int) -> tuple[QueryContext, NotTaken | None]:
        """The context in which the launches take what is at an offset of the file (`Workspace.taking`), and the tag
        that the first of them leaves out."""
        found = [self.workspace.taking(analysis, self.path, offset) for analysis in self.analyses]
        left_out = found[0][1] if found else None
        if left_out is None:
            return self, None
        return replace(self, analyses=tuple(analysis for analysis, _ in found)), left_out

    def facts(self, path: str) -> FileFacts | None:
        """What a launch file mentions."""
        return self.current.files.get(path)

    def outdated(self) -> tuple[str, ...]:
        """The launch files whose text is another one by now than the one that the index has."""
        sources = self.workspace.sources
        known = ((path, facts.version.partition(".")[0]) for path, facts in self.current.files.items())
        other = ((path, version) for path, version in known if sources.digest(path).partition(".")[0] != version)
        read = ((path, version, sources.launch_file(path)) for path, version in other)
        # What is known of a file of the catalogue is no digest of it.
        return tuple(p for p, version, now in read if isinstance(now, Unreadable) or now.document.digest != version)

    def launch_file(self, path: str) -> LaunchFile | None:
        """The launch file of the text that positions in it speak of."""
        for analysis in self.analyses:
            if (known := analysis.launch_files.get(path)) is not None:
                return known
        found = self.workspace.sources.launch_file(path)
        return None if isinstance(found, Unreadable) else found

    def document(self, path: str) -> Document | None:
        """The text that positions in a file speak of, whatever kind of file it is."""
        for analysis in self.analyses:
            if (known := analysis.documents.get(path)) is not None:
                return known
        found = self.workspace.sources.text(path)
        return None if isinstance(found, Unreadable) else found

    def location(self, path: str, span: Span) -> Location:
        """The location of a span of that text."""
        document = self.document(path)
        return document.location(span) if document is not None else Location.of_file(path)

    def text(self, location: Location) -> str:
        """What is written at a place."""
        document = self.document(location.file)
        return document.text[location.span.start : location.span.end] if document else ""

    def targets(self, tag: Location) -> tuple[str, ...]:
        """The files that the include with this start tag leads to, in any root."""
        found = (i.target for i in self.current.included_from(tag.file) if i.tag.span == tag.span)
        return tuple(dict.fromkeys(found))

    def shown(self, path: str) -> str:
        """A path as the user knows it: below the workspace's folder."""
        return shown_path(path, self.workspace.environment.workspace)

    def line(self, path: str, number: int) -> Location:
        """A line of a file, counted from 1, without the blanks around it; its start where there is no such line."""
        document = self.document(path)
        if document is None:
            return Location.of_file(path)
        span = document.lines.line_span(number - 1)
        text = document.text[span.start : span.end]
        start = span.start + len(text) - len(text.lstrip())
        return document.location(Span(start, max(start, span.start + len(text.rstrip()))))


def with_analyses(index: WorkspaceIndex, analyses: Sequence[Analysis]) -> WorkspaceIndex:
    """The index brought up to what newer analyses know; the very same where they know nothing new."""
    now = {path: found for analysis in reversed(analyses) for path, found in analysis.launch_files.items()}
    stale = {p: f for p, f in now.items() if p not in index.files or index.files[p].version != f.document.version}
    trees = {analysis.launch: analysis.tree for analysis in analyses}
    newer = {
        root: entry_of(tree, root)
        for root, tree in trees.items()
        if root not in index.entries or index.entries[root].inputs != tree.inputs
    }
    if not stale and not newer:
        return index
    entries = {
        root: entry
        if stale.keys().isdisjoint(entry.files)
        else replace(entry, inclusions=tuple(i for i in entry.inclusions if i.includer not in stale))
        for root, entry in index.entries.items()
    }
    packages = analyses[0].environment.packages if analyses else {}
    written = [i for i in index.written if i.includer not in stale]
    written += (i for found in stale.values() for i in written_includes(found, packages))
    files = {**index.files, **{path: facts_of(found) for path, found in stale.items()}}
    return WorkspaceIndex(files, {**entries, **newer}, tuple(written), index.complete)
