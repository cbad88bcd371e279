"""What can be done at a place: the fixes of its findings, and writing a traced interface into the launch file."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Span
from preflight_analysis.findings.finding import Edit, Finding, Fix
from preflight_analysis.graph.annotations import annotation_edit, annotation_template, annotation_text
from preflight_analysis.graph.outdated import bring_up_to_date, compare
from preflight_analysis.queries.places import action_at, nodes_of
from preflight_analysis.workspace.workspace import Analysis


@dataclass(frozen=True, slots=True)
class FixOf:
    """A fix and the finding that it mends."""

    finding: Finding
    fix: Fix


@dataclass(frozen=True, slots=True)
class Rewrite:
    """A change that mends nothing but is worth offering."""

    title: str
    edits: tuple[Edit, ...]


def fixes(findings: Iterable[Finding], file: str, span: Span) -> Iterator[FixOf]:
    """The fixes of the findings that touch `span`."""
    for finding in findings:
        there = finding.location
        if there.file == file and there.span.start <= span.end and span.start <= there.span.end:
            for fix in finding.fixes:
                yield FixOf(finding, fix)


_FROM = {
    "trace": "its traced interface",
    "similar": "what its executable did elsewhere",
    "source": "what its source says",
    "settings": "what the settings say",
    "nodl": "its NoDL document",
    "catalogue": "what the catalogue says",
}


def annotating(analysis: Analysis, file: str, offset: int) -> Iterator[Rewrite]:
    """Write what is known of the node at `offset` into its tag, or a template to fill in; where there is an annotation
    already, bring it up to date."""
    launch_file, document = analysis.launch_files.get(file), analysis.documents.get(file)
    action = action_at(launch_file, offset) if launch_file else None
    if action is None or document is None:
        return
    nodes = list(nodes_of(analysis, file, action))
    if not nodes:
        return
    node = nodes[0][1]
    interfaces = analysis.graph.processes if analysis.graph is not None else None
    if interfaces is not None:
        for index, each in nodes:
            known = interfaces[index]
            edit = annotation_edit(each, annotation_text(known), document) if known.source in _FROM else None
            if edit is not None:
                yield Rewrite(f"Annotate '{each.name}' with {_FROM[known.source]}", (edit,))
                break
        outdated = compare([(each, interfaces[index]) for index, each in nodes])
        edits = bring_up_to_date(outdated, document) if outdated is not None else ()
        if edits:
            yield Rewrite(f"Update the annotation of '{node.name}' from its run", edits)
    if interfaces is None or not any(interfaces[index].complete for index, _ in nodes):
        edit = annotation_edit(node, annotation_template(), document)
        if edit is not None:
            yield Rewrite(f"Annotate '{node.name}' with an empty template", (edit,))
