"""LCH024: a remap from a name to the same name."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.tree import LaunchNode, Remap
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.idle_remaps import idle_remaps
from preflight_analysis.model.problems import include_chain
from preflight_analysis.model.syntax import Tags, removal
from preflight_analysis.rules.further_reading import REMAPPING_DESIGN, ROSLAUNCH_REMAP
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    # Names that are written as they are are the same in every context: no other use of the tag has to be looked at.
    reached: dict[Location, list[Remap]] = {}
    for remap in chain.from_iterable(context.each(_to_itself, context.tree.nodes)):
        reached.setdefault(remap.origin[-1], []).append(remap)
    tags = Tags(context.launch_files)
    # Where another name was meant, TOP004 says so.
    explained = {idle.remap.origin[-1] for idle in idle_remaps(context)} if reached else ()
    for location, remaps in reached.items():
        remap = remaps[0]
        if location not in explained and all(map(_idle, remaps)) and _literal(context, remap):
            yield rule.claim(
                f"remap of '{remap.source}' to itself has no effect",
                location,
                subject=Subject("remap", remap.source),
                related=include_chain(remap.origin),
                fixes=removal(context, tags, location, "Remove this remap"),
            )


def _to_itself(node: LaunchNode) -> tuple[Remap, ...]:
    return tuple(remap for remap in node.remaps if remap.source == remap.target)


def _idle(remap: Remap) -> bool:
    """Whether the remap changes nothing; one that undoes an outer one does."""
    return all(old.target == remap.target for old in remap.replaces)


def _literal(context: Context, remap: Remap) -> bool:
    """Whether both names are written as they are: what an argument gives may be another name in another launch."""
    written = (context.text(place) for place in (remap.source_location, remap.target_location))
    return all(text and "$(" not in text for text in written)


RULE = Rule(
    id="LCH024",
    name="remap-to-itself",
    effect="style",
    kind="unused",
    what="Checks for a `<remap>` with the same name on both sides. A remap that undoes an outer remap, or whose "
    "names come from arguments, is not reported.",
    why="The remap has no effect. Either it is left over, or one of the names is wrong.",
    example='<remap from="scan" to="scan"/>',
    instead='<remap from="scan" to="front/scan"/>',
    references=(
        ROSLAUNCH_REMAP,
        REMAPPING_DESIGN,
    ),
    check=_check,
)
