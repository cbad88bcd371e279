"""BTR004: a behaviour tree node with a wrong number of children (ROS 2).

`VerifyXML` in src/xml_parsing.cpp of BehaviorTree/BehaviorTree.CPP.
"""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.behavior_trees import is_version_4, trees_of
from preflight_analysis.model.context import Context
from preflight_analysis.model.tree_nodes_in_sources import own_nodes
from preflight_analysis.rules.further_reading import BEHAVIOR_TREES
from preflight_analysis.rules.rule import Rule
from preflight_analysis.trees.children import children_of


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    seen = set[tuple[str, int]]()
    for loaded in trees_of(context):
        own = own_nodes(context.disk.db, context.environment)
        for part, used in loaded.nodes:
            number = children_of(used, is_version_4=is_version_4(context, loaded))
            if (
                number is None
                or used.name in own.nodes
                or number.least <= used.children <= (used.children if number.most is None else number.most)
                or (part.path, used.span.start) in seen
            ):
                continue
            seen.add((part.path, used.span.start))
            counted = f", not {used.children}" if number.most != 0 and used.children else ""
            yield rule.claim(
                f"behavior tree node '{used.name}' {number.text}{counted}",
                context.location(part.path, used.span),
                subject=Subject("tree-node", used.name),
                related=loaded.related,
            )


RULE = Rule(
    id="BTR004",
    name="number-of-behavior-tree-children",
    effect="breaks",
    kind="invalid",
    always=(Reason.LIBRARY,),
    what="Checks for a node in a behavior tree with too many or too few children. Nodes of Nav2 and BehaviorTree.CPP "
    "are known, and what `<Action>`, `<Condition>`, `<Decorator>` and `<Control>` say.",
    why="The tree cannot be created, or it fails as soon as it runs the node.",
    example='<RecoveryNode number_of_retries="6">\n  <ComputePathToPose goal="{goal}" path="{path}"/>\n'
    '  <FollowPath path="{path}"/>\n  <ClearEntireCostmap service_name="local_costmap/clear_entirely_local_costmap"/>\n'
    "</RecoveryNode>",
    instead='<RecoveryNode number_of_retries="6">\n  <Sequence>\n'
    '    <ComputePathToPose goal="{goal}" path="{path}"/>\n    <FollowPath path="{path}"/>\n  </Sequence>\n'
    '  <ClearEntireCostmap service_name="local_costmap/clear_entirely_local_costmap"/>\n</RecoveryNode>',
    references=(BEHAVIOR_TREES,),
    generations=(2,),
    check=_check,
)
