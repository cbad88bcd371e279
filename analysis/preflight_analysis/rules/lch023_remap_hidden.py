"""LCH023: a remap that another one of the same name puts out of effect."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode, Remap
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import include_chain
from preflight_analysis.model.syntax import Tags, removal
from preflight_analysis.rules.further_reading import REMAPPING_DESIGN, ROSLAUNCH_REMAP
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    if context.tree.ros.first_remap_wins:
        yield from _behind_the_first(rule, context)
        return
    tags = Tags(context.launch_files)
    seen: set[Location] = set()
    found = [*filter(None, context.each(_of_node, context.tree.nodes, rule))]
    one_hides = any(each.in_one_file for each in found)
    for each in found:
        for old, winner in each.replaced if one_hides else ():
            place = old.origin[-1]
            if place not in seen and place not in _effective(context):
                seen.add(place)
                yield from _hidden(rule, context, tags, old, winner)
        yield from each.same_name


@derived
def _effective(context: Context) -> frozenset[Location]:
    return frozenset(remap.origin[-1] for node in context.tree.nodes for remap in node.remaps)


@dataclass(frozen=True, slots=True)
class _OfNode:
    """The remaps that those of a node replace, each with what replaces it, and what is said of the node alone."""

    replaced: tuple[tuple[Remap, Remap], ...]
    same_name: tuple[Finding, ...]
    in_one_file: bool
    """Whether one is replaced by another that the same includes lead to."""


def _of_node(node: LaunchNode, rule: Rule) -> _OfNode | None:
    replaced = tuple(pair for remap in node.remaps for pair in pairwise((*remap.replaces, remap)))
    same_name = tuple(_same_name(rule, node))
    in_one_file = any(old.origin[:-1] == winner.origin[:-1] for old, winner in replaced)
    return _OfNode(replaced, same_name, in_one_file) if replaced or same_name else None


def _behind_the_first(rule: Rule, context: Context) -> Iterator[Finding]:
    """In ROS 2 the first rule that fits is the one, and those of `<set_remap>` stand before the node's own."""
    seen: set[Location] = set()
    nodes = context.tree.nodes
    for node, behind in zip(nodes, context.each(_behind, nodes), strict=True):
        for remap, winner in behind:
            place = remap.origin[-1]
            if place in seen:
                continue
            seen.add(place)
            yield rule.claim(
                say(
                    "overridden: '{source}' is already remapped to '{target}', and the first remap applies to {node}",
                    source=winner.source,
                    target=winner.target,
                    node=node.name,
                ),
                place,
                subject=Subject("remap", remap.source),
                related=(Related("the remap that applies", winner.origin[-1]), *include_chain(remap.origin)),
            )


def _behind(node: LaunchNode) -> tuple[tuple[Remap, Remap], ...]:
    """The remaps of a node that have no effect, each with the one that counts."""
    first: dict[str, Remap] = {}
    found: list[tuple[Remap, Remap]] = []
    for remap in node.remaps:
        name = remap.source if remap.source[:1] == "/" else f"{node.namespace}{remap.source}"
        winner = first.setdefault(name, remap)
        targets = {names.resolve(each.target, node.name) for each in (winner, remap)}
        if len(targets) > 1:
            found.append((remap, winner))
    return tuple(found)


def _hidden(rule: Rule, context: Context, tags: Tags, old: Remap, winner: Remap) -> Iterator[Finding]:
    """A remap that reaches no node of the launch, each maps the name elsewhere.

    Under conditions it may in another launch, and one that a scope further in replaces may be meant as its default.
    """
    if old.origin[:-1] != winner.origin[:-1] or not tags.siblings(old.origin[-1], winner.origin[-1]):
        return
    if tags.conditional(old.origin[-1]) or tags.conditional(winner.origin[-1]):
        return
    same = old.target == winner.target
    if same:
        message = f"duplicate remap of '{old.source}' to '{old.target}'"
    else:
        message = f"overridden: '{old.source}' is remapped again to '{winner.target}' below"
    yield rule.claim(
        message,
        old.origin[-1],
        subject=Subject("remap", old.source),
        kind="duplicate" if same else None,
        effect="style" if same else None,
        related=(Related("the remap that applies", winner.origin[-1]), *include_chain(old.origin)),
        fixes=removal(context, tags, old.origin[-1], "Remove this remap"),
    )


def _same_name(rule: Rule, node: LaunchNode) -> Iterator[Finding]:
    """Remaps whose names are written differently and come to the same: `/scan` and `scan` of a node in `/`."""
    if all(remap.source[0] not in "/~" for remap in node.remaps):
        return  # all relative: then different texts are different names
    by_name: dict[str, list[Remap]] = {}
    for remap in node.remaps:
        by_name.setdefault(names.resolve(remap.source, node.name), []).append(remap)
    for name, remaps in by_name.items():
        for first, second in pairwise(remaps):
            targets = {names.resolve(remap.target, node.name) for remap in (first, second)}
            same = len(targets) == 1
            yield rule.claim(
                say(
                    "duplicate remap: '{first}' and '{second}' are both '{name}' for {node}{outcome}",
                    first=first.source,
                    second=second.source,
                    name=name,
                    node=node.name,
                    outcome="" if same else "; the client library decides which one applies",
                ),
                second.source_location,
                subject=Subject("remap", name),
                kind="duplicate" if same else None,
                effect="style" if same else None,
                related=(
                    Related(f"'{first.source}' is remapped here", first.source_location),
                    *include_chain(second.origin),
                ),
            )


RULE = Rule(
    id="LCH023",
    name="remap-hidden",
    effect="no-effect",
    kind="conflict",
    sometimes=("style",),
    what="Checks for a remap that another remap of the same name overrides: in ROS 1 a later one, in ROS 2 an "
    "earlier one. Remaps under a condition, and defaults that a node's own remap overrides, are not reported.",
    why="Only one of several remaps of a name applies, and the launcher does not report the others. `roslaunch` "
    "uses the last one. It passes remaps that are written differently to the node, and its client library chooses "
    "one. ROS 2 uses the first one.",
    example='<remap from="scan" to="front/scan"/>\n<remap from="scan" to="rear/scan"/>\n'
    '<node pkg="slam" type="mapper" name="mapper"/>',
    instead='<remap from="scan" to="front/scan"/>\n<node pkg="slam" type="mapper" name="mapper"/>',
    references=(
        ROSLAUNCH_REMAP,
        REMAPPING_DESIGN,
    ),
    check=_check,
)
