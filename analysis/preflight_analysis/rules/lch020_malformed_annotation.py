"""LCH020: an annotation that cannot be read."""

from collections.abc import Iterator

from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.annotations import AnnotationProblem, read_annotation
from preflight_analysis.rules.problems import include_chain
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for node, problems in filter(None, context.kept.each(_malformed, context.tree.nodes)):
        for problem in problems:
            location = context.location(node.location.file, problem.span)
            yield rule.finding(problem.message, location, related=include_chain(node.origin))


def _malformed(node: LaunchNode) -> tuple[LaunchNode, tuple[AnnotationProblem, ...]] | None:
    problems = read_annotation(node.action)[1]
    return (node, problems) if problems else None


RULE = Rule(
    id="LCH020",
    name="malformed-annotation",
    severity="warning",
    what="Reports what cannot be understood in the `<topics>`, `<services>`, `<params>` and `<actions>` that annotate "
    "a node.",
    why="The item is left out, so that findings that rest on the annotation are missing or wrong.",
    example='<!-- <topics><topic name="chatter" type="String" class="publish"/></topics> -->',
    instead='<!-- <topics><topic name="chatter" type="std_msgs/String" class="pub"/></topics> -->',
    check=_check,
)
