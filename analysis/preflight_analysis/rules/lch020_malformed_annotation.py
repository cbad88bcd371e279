"""LCH020: an annotation that cannot be read."""

from collections.abc import Iterator, Sequence
from itertools import compress

from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.annotations import annotated_groups, read_annotation
from preflight_analysis.graph.bare_types import KINDS, full_types, is_bare
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import include_chain, rename
from preflight_analysis.rules.further_reading import ANNOTATIONS
from preflight_analysis.rules.rule import Rule
from preflight_analysis.tracing.interface import Endpoint

_MOST = 3
"""Types that are named."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    nodes = context.tree.nodes
    for node in compress(nodes, context.each(_is_malformed, nodes)):
        for problem in read_annotation(node.action)[1]:
            location = context.location(node.location.file, problem.span)
            about = Subject("annotation")
            yield rule.claim(problem.message, location, subject=about, related=include_chain(node.origin))
    for node in compress(nodes, context.each(_has_bare_types, nodes)):
        yield from _bare_types(rule, node, context)


def _bare_types(rule: Rule, node: LaunchNode, context: Context) -> Iterator[Finding]:
    for group in annotated_groups(node.action):
        for item in group.items:
            what = item.what
            if not isinstance(what, Endpoint) or what.type is None or not is_bare(what.type):
                continue
            full = full_types(context.disk, context.environment, context.tree.generation, KINDS[what.role], what.type)
            place = context.location(node.location.file, item.values["type"])
            yield rule.claim(
                f"type '{what.type}' has no package; {_meant(full)}",
                place,
                subject=Subject("type", what.type),
                effect="note",
                candidates=full,
                related=include_chain(node.origin),
                fixes=[
                    fix for each in full[:_MOST] for fix in rename(context, place, what.type, each, preferred=False)
                ],
            )


def _meant(full: Sequence[str]) -> str:
    if len(full) == 1:
        return f"{full[0]} is used"
    if not full:
        return "no known package has it, so any type matches"
    more = f" and {len(full) - _MOST} more" if len(full) > _MOST else ""
    return f"several packages have it, so any type matches: {', '.join(full[:_MOST])}{more}"


def _has_bare_types(node: LaunchNode) -> bool:
    annotation, _ = read_annotation(node.action)
    return annotation is not None and any(is_bare(each.type) for each in annotation.endpoints)


def _is_malformed(node: LaunchNode) -> bool:
    return bool(read_annotation(node.action)[1])


RULE = Rule(
    id="LCH020",
    name="malformed-annotation",
    effect="no-effect",
    kind="invalid",
    sometimes=("note",),
    what="Checks for invalid `<topics>`, `<services>`, `<params>` and `<actions>` in the annotations of a node, and "
    "for types without a package.",
    why="The invalid item is ignored. Findings that depend on the annotation are missing or wrong.",
    example='<!-- <topics><topic name="chatter" type="std_msgs/String" class="publish"/></topics> -->',
    instead='<!-- <topics><topic name="chatter" type="std_msgs/String" class="pub"/></topics> -->',
    references=(ANNOTATIONS,),
    check=_check,
)
