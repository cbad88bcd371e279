"""BTR001: a behaviour tree file that cannot be loaded (ROS 2)."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.documents.span import Span
from preflight_analysis.evaluation.value_places import value_place
from preflight_analysis.findings.finding import Confidence, Finding
from preflight_analysis.rules.behavior_trees import FOLDERS, Loaded, folder_of, trees_of
from preflight_analysis.rules.further_reading import BEHAVIOR_TREES
from preflight_analysis.rules.nearest import did_you_mean, nearest
from preflight_analysis.rules.problems import include_chain, rename
from preflight_analysis.rules.rule import Context, Rule
from preflight_analysis.trees.known_nodes import NAV_DISTRIBUTIONS

_WITH_FOLDERS = frozenset({"lyrical", "rolling"})
"""Where bt_navigator takes trees from the other files of a folder, too (`bt_search_directories`)."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    yield from _of_folders(rule, context)
    seen = set[tuple[str, int]]()
    for loaded in context.once(trees_of):
        for path, message, span, fix in _wrong(context, loaded):
            if (path, span.start) in seen:
                continue
            seen.add((path, span.start))
            place = context.location(path, span)
            yield rule.finding(
                message,
                place,
                confidence=_confidence(context, fix),
                related=loaded.related,
                fixes=rename(context, place, *fix) if fix is not None else (),
            )


def _of_folders(rule: Rule, context: Context) -> Iterator[Finding]:
    """Folders of trees that are not there."""
    for node, param in ((each, param) for each in context.tree.nodes for param in each.params):
        for listed in param.value if param.name == FOLDERS and isinstance(param.value, list) else ():
            folder = folder_of(context, listed)
            if folder is None or context.disk.is_folder(folder):
                continue
            place = value_place(param.place, str(listed), context.documents.get(param.place.file)) or param.place
            message = f"folder '{listed}' in '{FOLDERS}' of {node.name} does not exist, so no tree is loaded from it"
            yield rule.finding(message, place, confidence="likely", related=include_chain(node.origin))


_Wrong = tuple[str, str, Span, tuple[str, str] | None]
"""The file, the message, its place, and what is written there with what was meant."""


def _wrong(context: Context, loaded: Loaded) -> Iterator[_Wrong]:
    for part in loaded.parts:
        main = loaded.file.main_problems if part is loaded.parts[0] and loaded.is_navigator else ()
        for problem in (*part.file.problems, *main):
            yield part.path, f"behavior tree cannot be loaded: {problem.message}", problem.span, None
    for path, included, target in loaded.missing:
        yield path, f"behavior tree cannot be loaded: '{target}' does not exist", included.span, None
    # Others may register several files before they make a tree.
    if not loaded.is_navigator or not loaded.whole or loaded.missing or context.environment.distro in _WITH_FOLDERS:
        return
    trees, one = loaded.trees, len(loaded.parts) == 1
    where = "this file" if one else "this file and those that it includes"
    main_tree = loaded.file.main
    if not one and main_tree is not None and main_tree.name not in trees:
        message = f"behavior tree cannot be loaded: there is no tree '{main_tree.name}', its main tree"
        yield loaded.path, message, main_tree.span, None
    for part in loaded.parts:
        for used in part.file.subtrees:
            if used.name not in trees:
                near = nearest(used.name, trees)
                message = f"subtree '{used.name}' does not exist in {where}" + did_you_mean(near)
                yield part.path, message, used.span, (used.name, near) if near is not None else None


def _confidence(context: Context, fix: object) -> Confidence:
    return "certain" if fix is None or context.environment.distro in NAV_DISTRIBUTIONS else "likely"


RULE = Rule(
    id="BTR001",
    name="behavior-tree-not-loaded",
    severity="warning",
    what="Checks for a behavior tree that cannot be loaded. Tags do not match, `<root>` has no main tree, `<SubTree>` "
    "names a tree that neither the file nor those that it includes have, or an included file does not exist. The file "
    "is the value of `default_nav_to_pose_bt_xml` or a similar parameter of bt_navigator. Of the trees that nodes of "
    "the workspace load, tags and included files are checked, and that the folders in `behavior_trees` of a "
    "`TreeExecutionServer` exist.",
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
