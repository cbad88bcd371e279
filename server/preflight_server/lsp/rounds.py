"""From a snapshot of a session to what is published: all that a thread does after an edit."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace

from lsprotocol import types
from preflight_analysis.findings.contexts import RootFindings, lacks_once
from preflight_analysis.findings.finding import Finding
from preflight_analysis.findings.lack import Missing, missing
from preflight_analysis.incremental.database import Cancelled
from preflight_analysis.incremental.kept import Kept
from preflight_analysis.workspace.branches import Branches
from preflight_analysis.workspace.index import Root
from preflight_analysis.workspace.merged import counting, merged
from preflight_analysis.workspace.run_results import RunResults, with_results
from preflight_analysis.workspace.workspace import Analysis, Workspace

from preflight_server.lsp.convert import Converter
from preflight_server.lsp.text_store import TextStore

LARGE = 100
"""From so many nodes on, what can be said of a launch without the graph is shown first."""


@dataclass(frozen=True, slots=True)
class Round:
    """What one more analysis led to, over all roots."""

    analyses: Mapping[Root, Analysis]
    findings: Mapping[str, tuple[Finding, ...]]
    missing: tuple[Missing, ...]
    diagnostics: Mapping[str, list[types.Diagnostic]]
    kept: Kept
    converter: Converter
    """What made them, for the next round."""
    preliminary: bool = False
    """Whether the graph of the one that was analysed is still missing."""


def branches_of(workspace: Workspace, root: Root, stops: Callable[[], bool]) -> Branches | None:
    """What is found in the tags that a launch leaves out; None where something was written before that was known, or
    it `stops`. Call it in a thread."""
    static = workspace.static(root.path, dict(root.args))
    with suppress(Cancelled), workspace.sources.db.reading():
        return workspace.branches(static, stops)
    return None


@dataclass(frozen=True, slots=True)
class Snapshot:
    """A session at one moment. `root` is to be analysed, None where only the findings are to be put together anew."""

    root: Root | None
    results: RunResults
    """Of its nodes."""
    branches: Branches
    """What was found last in the tags that it leaves out."""
    analyses: Mapping[Root, Analysis]
    stale: Collection[Root]
    """Those of them that an edit made out of date."""
    asked: Collection[Root]
    """Roots that count though others include them."""
    selected: Mapping[str, Root]
    """The root that the user chose for a file to be shown in."""
    before: Round | None
    look: bool
    """Whether files changed on the disk."""
    texts: TextStore
    shows_related: bool

    def analysed(self, workspace: Workspace) -> Round:
        """What follows from it. Call it in a thread."""
        if self.look:
            workspace.refresh()
        root, analyses, preliminary = self.root, dict(self.analyses), False
        if root is not None:
            static = workspace.static(root.path, dict(root.args)).with_branches(self.branches)
            preliminary = root not in analyses and len(static.tree.nodes) >= LARGE
            whole = static if preliminary else with_results(workspace, static, self.results, analyses.get(root))
            analyses[root] = whole
        return replace(self._published(workspace, analyses), preliminary=preliminary)

    def _published(self, workspace: Workspace, analyses: Mapping[Root, Analysis]) -> Round:
        """The findings of all roots by file, of a file for which the user chose a root those in that one. Files that
        are not open are read for their lines."""
        kept = Kept(self.before.kept if self.before is not None else None)
        count = counting({root: analysis.tree.files for root, analysis in analyses.items()}, self.asked)
        shown_roots = {root: analysis for root, analysis in analyses.items() if root in count}
        reports = {root: self._report(workspace, root, analysis) for root, analysis in shown_roots.items()}
        findings = merged(reports.values(), kept)
        for path, root in self.selected.items():
            if root in reports and path in reports[root].files:
                findings[path] = merged([reports[root]]).get(path, ())
        newest_last = sorted(shown_roots, key=lambda root: root not in self.stale)
        documents = {
            path: document for root in newest_last for path, document in shown_roots[root].all_documents.items()
        }
        before = self.before.converter if self.before is not None else None
        converter = Converter(self.texts, documents, related=self.shows_related, before=before)
        shown = {path: kept.get(lacks_once, path, found) for path, found in findings.items()}
        diagnostics = {path: converter.diagnostics(path, found) for path, found in shown.items()}
        lacks = missing((f.lack, f.location) for found in findings.values() for f in found if f.lack is not None)
        converter.end()
        kept.end()
        return Round(analyses, shown, lacks, diagnostics, kept, converter)

    def _report(self, workspace: Workspace, root: Root, analysis: Analysis) -> RootFindings:
        """The findings of one root. Those of an earlier text say nothing of files that changed since."""
        inputs = analysis.tree.inputs
        files = frozenset((*analysis.tree.files, *inputs))
        findings = analysis.findings
        if root in self.stale:
            files -= {path for path, digest in inputs.items() if workspace.sources.digest(path) != digest}
            findings = tuple(f for f in findings if f.location.file in files)
        return RootFindings(root.label, files, findings)
