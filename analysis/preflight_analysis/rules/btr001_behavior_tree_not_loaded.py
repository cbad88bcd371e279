"""BTR001: a behaviour tree file that cannot be loaded (ROS 2)."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.behavior_trees import trees_of
from preflight_analysis.rules.further_reading import BEHAVIOR_TREES
from preflight_analysis.rules.nearest import did_you_mean, nearest
from preflight_analysis.rules.problems import rename
from preflight_analysis.rules.rule import Context, Rule
from preflight_analysis.trees.known_nodes import NAV_DISTRIBUTIONS

_WITH_FOLDERS = frozenset({"lyrical", "rolling"})
"""Where bt_navigator takes trees from the other files of a folder, too (`bt_search_directories`)."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    seen = set[tuple[str, int]]()
    distro = context.environment.distro
    for loaded in context.once(trees_of):
        file = loaded.file
        for problem in file.problems:
            if (loaded.path, problem.span.start) not in seen:
                seen.add((loaded.path, problem.span.start))
                yield rule.finding(
                    f"behavior tree cannot be loaded: {problem.message}",
                    context.location(loaded.path, problem.span),
                    related=loaded.related,
                )
        if file.includes or distro in _WITH_FOLDERS:
            continue
        for used in file.subtrees:
            if used.name in file.trees or (loaded.path, used.span.start) in seen:
                continue
            seen.add((loaded.path, used.span.start))
            near, place = nearest(used.name, file.trees), context.location(loaded.path, used.span)
            yield rule.finding(
                f"subtree '{used.name}' does not exist in this file" + did_you_mean(near),
                place,
                confidence="certain" if distro in NAV_DISTRIBUTIONS else "likely",
                related=loaded.related,
                fixes=rename(context, place, used.name, near) if near is not None else (),
            )


RULE = Rule(
    id="BTR001",
    name="behavior-tree-not-loaded",
    severity="warning",
    what="Checks for a behavior tree that bt_navigator cannot load. Tags do not match, `<root>` has no main tree, or a "
    "`<SubTree>` names a tree that the file does not have. The file is the value of `default_nav_to_pose_bt_xml` or a "
    "similar parameter. A file with `<include>` is checked by itself only.",
    why="bt_navigator rejects the goal or does not become active.",
    example='<root BTCPP_format="4" main_tree_to_execute="Main">\n'
    '  <BehaviorTree ID="MainTree">\n    <SubTree ID="Recovery"/>\n  </BehaviorTree>\n</root>',
    instead='<root BTCPP_format="4" main_tree_to_execute="MainTree">\n'
    '  <BehaviorTree ID="MainTree">\n    <SubTree ID="Recovery"/>\n  </BehaviorTree>\n'
    '  <BehaviorTree ID="Recovery">\n    <Wait wait_duration="5"/>\n  </BehaviorTree>\n</root>',
    references=(BEHAVIOR_TREES,),
    generations=(2,),
    check=_check,
)
