"""What can be done at a place: the fixes of its findings, alone or all of a kind, ways to suppress them, and writing a
traced interface into the launch file."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.edits.edit import Edit
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.graph.annotations import annotation_edits, annotation_template, annotation_text
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


def touching(findings: Iterable[Finding], file: str, span: Span) -> tuple[Finding, ...]:
    """The findings that touch `span`."""
    return tuple(
        finding
        for finding in findings
        if finding.location.file == file
        and finding.location.span.start <= span.end
        and span.start <= finding.location.span.end
    )


def fixes(findings: Iterable[Finding]) -> Iterator[FixOf]:
    """The fixes of findings, those that change the same once."""
    first: dict[tuple[Edit, ...], FixOf] = {}
    for finding in findings:
        for fix in finding.fixes:
            first.setdefault(fix.edits, FixOf(finding, fix))
    return iter(first.values())


def fix_all(findings: Iterable[Finding], rule: str | None = None) -> tuple[tuple[Edit, ...], int]:
    """The edits of the preferred fixes of a rule, and how many of them there are; without a rule those of all findings
    that are certain. Of two that change the same place the first counts."""
    chosen: dict[Edit, None] = {}
    count = 0
    for finding in findings:
        fix = next((each for each in finding.fixes if each.preferred), None)
        if fix is None or finding.rule != (rule or finding.rule) or (rule is None and finding.confidence != "certain"):
            continue
        new = [edit for edit in fix.edits if edit not in chosen]
        if not any(_overlap(edit.location, known.location) for edit in new for known in chosen):
            count += 1
            chosen.update(dict.fromkeys(new))
    return tuple(chosen), count


def _overlap(one: Location, other: Location) -> bool:
    """Whether two places share text; two insertions at one place do not."""
    if one.file != other.file:
        return False
    (start, end), (first, last) = one.span, other.span
    return (start < last and first < end) or ((start, end) == (first, last) and start < end)


_FROM = {
    "trace": "its traced interface",
    "similar": "the interface of another run",
    "source": "the interface in its source",
    "settings": "the interface in the settings",
    "nodl": "its NoDL document",
    "catalogue": "the interface in the catalogue",
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
            edits = annotation_edits(each, annotation_text(known), document) if known.source in _FROM else ()
            if edits:
                yield Rewrite(f"Annotate '{each.name}' with {_FROM[known.source]}", edits)
                break
        outdated = compare([(each, interfaces[index]) for index, each in nodes])
        edits = bring_up_to_date(outdated, document) if outdated is not None else ()
        if edits:
            yield Rewrite(f"Update the annotation of '{node.name}' from its run", edits)
    if interfaces is None or not any(interfaces[index].complete for index, _ in nodes):
        edits = annotation_edits(node, annotation_template(), document)
        if edits:
            yield Rewrite(f"Annotate '{node.name}' with an empty template", edits)
