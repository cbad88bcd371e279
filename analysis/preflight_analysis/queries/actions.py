"""What can be done at a place: the fixes of its findings, and writing a traced interface into the launch file."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from preflight_analysis.documents.span import Span
from preflight_analysis.findings.finding import Edit, Finding, Fix
from preflight_analysis.graph.annotations import annotation_edit
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


def annotation(analysis: Analysis, file: str, offset: int) -> Rewrite | None:
    """Write what a run of the node at `offset` showed into its tag; None where there is no run to write down."""
    launch_file, document = analysis.launch_files.get(file), analysis.documents.get(file)
    action = action_at(launch_file, offset) if launch_file else None
    if action is None or document is None or analysis.graph is None:
        return None
    for index, node in nodes_of(analysis, file, action):
        interface = analysis.graph.interfaces[index]
        if interface.source == "trace" and interface.outcome.status == "spinning":
            edit = annotation_edit(node, interface, document)
            return Rewrite(f"Annotate '{node.name}' with its traced interface", (edit,)) if edit else None
    return None
