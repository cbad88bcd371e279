"""LCH020: an annotation that cannot be read."""

from collections.abc import Iterator
from itertools import compress

from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.annotations import read_annotation
from preflight_analysis.rules.further_reading import ANNOTATIONS
from preflight_analysis.rules.problems import include_chain
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    nodes = context.tree.nodes
    for node in compress(nodes, context.kept.each(_is_malformed, nodes)):
        for problem in read_annotation(node.action)[1]:
            location = context.location(node.location.file, problem.span)
            yield rule.finding(problem.message, location, related=include_chain(node.origin))


def _is_malformed(node: LaunchNode) -> bool:
    return bool(read_annotation(node.action)[1])


RULE = Rule(
    id="LCH020",
    name="malformed-annotation",
    severity="warning",
    what="Checks for invalid `<topics>`, `<services>`, `<params>` and `<actions>` in the annotations of a node.",
    why="The invalid item is ignored. Findings that depend on the annotation are missing or wrong.",
    example='<!-- <topics><topic name="chatter" type="String" class="publish"/></topics> -->',
    instead='<!-- <topics><topic name="chatter" type="std_msgs/String" class="pub"/></topics> -->',
    references=(ANNOTATIONS,),
    check=_check,
)
