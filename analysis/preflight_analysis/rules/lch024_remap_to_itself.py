"""LCH024: a remap from a name to the same name."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.tree import LaunchNode, Remap
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.problems import include_chain
from preflight_analysis.rules.rule import Context, Rule
from preflight_analysis.rules.syntax import Tags, removal


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    reached: dict[Location, list[tuple[LaunchNode, Remap]]] = {}
    for node in context.tree.nodes:
        for remap in node.remaps:
            reached.setdefault(remap.origin[-1], []).append((node, remap))
    tags = Tags(context.launch_files)
    for location, uses in reached.items():
        if all(_idle(node, remap) for node, remap in uses) and _literal(context, uses[0][1]):
            remap = uses[0][1]
            yield rule.finding(
                f"'{remap.source}' is remapped to itself, which has no effect",
                location,
                related=include_chain(remap.origin),
                fixes=removal(context, tags, location, "Remove this remap"),
            )


def _idle(node: LaunchNode, remap: Remap) -> bool:
    """Whether the remap changes nothing for the node; one that undoes an outer one does."""
    return remap.source == remap.target and all(old.target == remap.target for old in remap.replaces)


def _literal(context: Context, remap: Remap) -> bool:
    """Whether both names are written as they are: what an argument gives may be another name in another launch."""
    document = context.documents.get(remap.source_location.file)
    if document is None:
        return False
    written = (document.text[at.span.start : at.span.end] for at in (remap.source_location, remap.target_location))
    return not any("$(" in text for text in written)


RULE = Rule(
    id="LCH024",
    name="remap-to-itself",
    severity="hint",
    what="Reports a `<remap>` that is written with the same name on both sides. One that undoes an outer remap of the "
    "name has an effect, and one whose names come from arguments may have: of these nothing is said.",
    why="It does nothing. Either it is left over, or one of the names was to be another.",
    example='<remap from="scan" to="scan"/>',
    instead='<remap from="scan" to="front/scan"/>',
    check=_check,
)
