"""From a snapshot of a session to what is published: all that a thread does after an edit."""

from __future__ import annotations

import logging
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from itertools import groupby

from lsprotocol import types
from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Span
from preflight_analysis.environment.installed_paths import package_around
from preflight_analysis.findings.contexts import RootFindings, causes_first, lacks_once
from preflight_analysis.findings.failure import Failure
from preflight_analysis.findings.finding import Finding
from preflight_analysis.findings.lack import Missing, missing
from preflight_analysis.incremental.database import Cancelled
from preflight_analysis.incremental.kept import Kept
from preflight_analysis.model.installation import packages_of
from preflight_analysis.workspace.branches import Branches
from preflight_analysis.workspace.index import Root
from preflight_analysis.workspace.merged import CRASH, counting, merged
from preflight_analysis.workspace.run_results import RunResults
from preflight_analysis.workspace.workspace import Analysis, Workspace

from preflight_server.lsp.convert import Converter
from preflight_server.lsp.rule_pages import RulePages
from preflight_server.lsp.text_store import TextStore

_log = logging.getLogger(__name__)

LARGE = 100
"""With so many nodes nobody waits for the graph who asks for something in a launch that is new."""


@dataclass(frozen=True, slots=True)
class Round:
    """What was asked led to, over all roots."""

    analyses: Mapping[Root, Analysis]
    outdated: frozenset[Root]
    """Those of them that were not asked for again since a file of theirs changed."""
    findings: Mapping[str, tuple[Finding, ...]]
    missing: tuple[Missing, ...]
    diagnostics: Mapping[str, list[types.Diagnostic]]
    kept: Kept
    converter: Converter
    """What made them, for the next round."""
    failures: tuple[Failure, ...] = ()
    """The errors of ours that cost findings."""
    preliminary: bool = False
    """Whether of one that was asked for there is only what its texts say."""
    large: bool = False
    """Whether that one is large."""


def branches_of(workspace: Workspace, root: Root, stops: Callable[[], bool]) -> Branches | None:
    """What is found in the tags that a launch leaves out; None where something was written before that was known, or
    it `stops`. Call it in a thread."""
    workspace.look_at_results()
    evaluated = workspace.evaluated(root.path, dict(root.args))
    with suppress(Cancelled), workspace.sources.db.reading():
        return workspace.branches(evaluated, stops)
    return None


@dataclass(frozen=True, slots=True)
class Snapshot:
    """A session at one moment, when it asks for some of the `wanted` roots. Of the others is known what was last."""

    asked: Collection[Root]
    wanted: Collection[Root]
    results: Mapping[Root, RunResults]
    """Of the nodes of those that are asked for."""
    named: Collection[Root]
    """Roots that count though others include them."""
    shown: Collection[Root]
    """Those that open files are shown in: they count likewise, where they lack no argument."""
    chosen: Mapping[Root, Collection[str]]
    """The roots that the user chose, the latest first, and the files that each reached: of these, what is found in it
    is all that counts."""
    build_files: Collection[str]
    """Those that are open: what is found in them is shown, whatever launches are."""
    awaited: Mapping[Root, frozenset[str]]
    """Those of the wanted roots of which nothing is known yet, and the files that they reach: of these is not shown
    what has to hold in each root."""
    knows_roots: bool
    """Whether it is known which roots reach which files; else that is so for all."""
    before: Round | None
    only_news: bool
    """Whether `before` is all there is to tell where the roots that are asked for are what they were."""
    texts: TextStore
    shows_related: bool
    pages: RulePages | None

    def round(self, workspace: Workspace) -> Round | None:
        """What follows from it; None where an edit came first. Call it in a thread."""
        for root, results in self.results.items():
            workspace.set_results(root, results)
        workspace.look_at(self.asked)
        with suppress(Cancelled), workspace.sources.db.reading():
            return self._asked(workspace)
        return None

    def _asked(self, workspace: Workspace) -> Round:
        known = self.before.analyses if self.before is not None else {}
        failures: list[Failure] = []
        new = [root for root in self.asked if root not in known and not self.only_news]
        # One after another: the first is that of the file which the user looks at.
        asked = self._each(new[:1], workspace.of_texts, failures)
        preliminary = bool(asked)
        large = any(len(analysis.tree.nodes) >= LARGE for analysis in asked.values())
        asked = asked or self._each(self.asked, workspace.analysed, failures)
        if self.before is not None and self.only_news and self._is_known(asked, self.before):
            return self.before
        others = {root: known[root] for root in self.wanted if root in known and root not in asked}
        changed = {root: frozenset(_changed_files(workspace, analysis)) for root, analysis in others.items()}
        analyses = {root: either[root] for root in self.wanted if root in (either := {**others, **asked})}
        failures += [failure for analysis in asked.values() for failure in analysis.failures]
        found = self._published(workspace, analyses, changed)
        return replace(found, failures=tuple(failures), preliminary=preliminary, large=large)

    def _each(
        self, roots: Iterable[Root], ask: Callable[[str, dict[str, str]], Analysis], failures: list[Failure]
    ) -> dict[Root, Analysis]:
        """The roots with their findings; those that break are noted."""
        asked = {}
        for root in roots:
            try:
                analysis = ask(root.path, dict(root.args))
                _ = analysis.findings
            except Exception as error:
                _log.exception("the analysis of %s failed; its findings are unchanged", root)
                failures.append(Failure.of(error, root.path))
            else:
                asked[root] = analysis
        return asked

    def _is_known(self, asked: Mapping[Root, Analysis], before: Round) -> bool:
        same = (asked.get(root) is before.analyses.get(root) for root in self.asked)
        return all(same) and before.outdated.isdisjoint(self.asked)

    def _published(
        self, workspace: Workspace, analyses: Mapping[Root, Analysis], changed: Mapping[Root, frozenset[str]]
    ) -> Round:
        """The findings of all roots by file, of a file for which the user chose a root those in that one. Files that
        are not open are read for their lines. `changed` has the files that are not what a root was made of."""
        kept = Kept(self.before.kept if self.before is not None else None)
        alone = (root for root in self.shown if root in analyses and not analyses[root].tree.lacking)
        count = counting({root: each.tree.files for root, each in analyses.items()}, {*self.named, *alone})
        # Which of them comes first decides how a finding is worded: not the file that was edited last.
        shown_roots = {root: analyses[root] for root in sorted(analyses) if root in count}
        reports = {root: _report(root, each, changed.get(root, frozenset())) for root, each in shown_roots.items()}
        known = [*_of_chosen(reports, self.chosen)]
        findings = merged([*known, *self._silent(known, analyses)], kept)
        newest_last = sorted(shown_roots, key=lambda root: not changed.get(root))
        documents = {
            path: document for root in newest_last for path, document in shown_roots[root].all_documents.items()
        }
        said = {package.share for each in shown_roots.values() for package in packages_of(each.context)}
        around = (package_around(workspace.environment, path) for path in self.build_files)
        others = {package.share: package for package in around if package and package.share not in said}
        of_packages, texts = workspace.findings_of_packages(others.values())
        findings |= {path: tuple(found) for path, found in groupby(sorted(of_packages, key=_place), key=_file)}
        documents = {**texts, **documents}
        before = self.before.converter if self.before is not None else None
        converter = Converter(self.texts, documents, related=self.shows_related, pages=self.pages, before=before)
        shown = {path: kept.get(lacks_once, path, found) for path, found in findings.items()}
        shown = dict(causes_first(shown, CRASH))
        diagnostics = {path: converter.diagnostics(path, found) for path, found in shown.items()}
        lacks = missing((f.lack, f.location) for found in findings.values() for f in found if f.lack is not None)
        converter.end()
        kept.end()
        outdated = frozenset(root for root, files in changed.items() if files)
        return Round(analyses, outdated, shown, lacks, diagnostics, kept, converter)

    def _silent(self, known: Iterable[RootFindings], analyses: Mapping[Root, Analysis]) -> Iterator[RootFindings]:
        """Those that say nothing yet of files that they reach."""
        if not self.knows_roots:
            yield RootFindings("", frozenset(path for report in known for path in report.files), ())
        for root, files in self.awaited.items():
            if root not in analyses:
                yield RootFindings(root.label, files, ())


def _of_chosen(reports: Mapping[Root, RootFindings], chosen: Mapping[Root, Collection[str]]) -> Iterable[RootFindings]:
    """The findings of each root, without those in files for which the user chose another one."""
    counts: dict[str, Root] = {}
    for root, reached in chosen.items():
        if root in reports:
            counts.update((path, root) for path in reached if path in reports[root].files and path not in counts)
    if not counts:
        return reports.values()
    return [
        _without(report, {p for p in report.files if counts.get(p, root) != root}) for root, report in reports.items()
    ]


def _without(report: RootFindings, files: Collection[str]) -> RootFindings:
    if not files:
        return report
    found = tuple(each for each in report.findings if each.location.file not in files)
    return replace(report, files=report.files.difference(files), findings=found)


def _file(finding: Finding) -> str:
    return finding.location.file


def _place(finding: Finding) -> tuple[str, Span]:
    return finding.location.file, finding.location.span


def _changed_files(workspace: Workspace, analysis: Analysis) -> Iterator[str]:
    """The files of an analysis that are not what they were."""
    sources = workspace.sources
    return (path for path, digest in analysis.tree.inputs.items() if sources.digest(path) != digest)


def _report(root: Root, analysis: Analysis, changed: frozenset[str]) -> RootFindings:
    """The findings of one root. Those of an earlier text say nothing of files that changed since."""
    files = frozenset((*analysis.tree.files, *analysis.tree.inputs)) - changed
    found = tuple(f for f in analysis.findings if f.location.file in files) if changed else analysis.findings
    return RootFindings(root.label, files, found)
