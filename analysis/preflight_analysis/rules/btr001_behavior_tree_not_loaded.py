"""BTR001: a behaviour tree file that cannot be loaded (ROS 2)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from preflight_analysis.documents.span import Span
from preflight_analysis.evaluation.value_places import value_place
from preflight_analysis.findings.claim import Kind, Subject, say
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.behavior_trees import FOLDERS, Loaded, folder_of, trees_of
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import did_you_mean, nearest
from preflight_analysis.model.problems import include_chain, rename
from preflight_analysis.rules.further_reading import BEHAVIOR_TREES
from preflight_analysis.rules.rule import Rule

_WITH_FOLDERS = frozenset({"lyrical", "rolling"})
"""Where bt_navigator takes trees from the other files of a folder, too (`bt_search_directories`)."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    yield from _of_folders(rule, context)
    seen = set[tuple[str, int]]()
    for loaded in trees_of(context):
        for path, wrong in _wrong(context, loaded):
            if (path, wrong.span.start) in seen:
                continue
            seen.add((path, wrong.span.start))
            place, near = context.location(path, wrong.span), wrong.near
            yield rule.claim(
                wrong.message,
                place,
                subject=wrong.about,
                kind=wrong.kind,
                candidates=(near,),
                related=loaded.related,
                fixes=rename(context, place, wrong.about.name, near) if near is not None else (),
            )


def _of_folders(rule: Rule, context: Context) -> Iterator[Finding]:
    """Folders of trees that are not there."""
    for node, param in ((each, param) for each in context.tree.nodes for param in each.params):
        for listed in param.value if param.name == FOLDERS and isinstance(param.value, list) else ():
            folder = folder_of(context, listed)
            if folder is None or context.disk.is_folder(folder):
                continue
            place = value_place(param.place, str(listed), context.documents.get(param.place.file)) or param.place
            said = "folder '{folder}' in '{param}' of {node} does not exist, so no tree is loaded from it"
            yield rule.claim(
                say(said, folder=listed, param=FOLDERS, node=node.name),
                place,
                subject=Subject("file", folder),
                kind="absent",
                related=include_chain(node.origin),
            )


class _Wrong(NamedTuple):
    """What is wrong in a file, and what was meant."""

    message: str
    span: Span
    about: Subject
    kind: Kind = "absent"
    near: str | None = None


def _wrong(context: Context, loaded: Loaded) -> Iterator[tuple[str, _Wrong]]:
    """Each with the path of its file."""
    for part in loaded.parts:
        main = loaded.file.main_problems if part is loaded.parts[0] and loaded.is_navigator else ()
        for problem in (*part.file.problems, *main):
            message = f"behavior tree cannot be loaded: {problem.message}"
            yield part.path, _Wrong(message, problem.span, Subject("tree", problem.message), "invalid")
    for path, included, target in loaded.missing:
        message = f"behavior tree cannot be loaded: '{target}' does not exist"
        yield path, _Wrong(message, included.span, Subject("file", target))
    # Others may register several files before they make a tree.
    if not loaded.is_navigator or not loaded.whole or loaded.missing or context.environment.distro in _WITH_FOLDERS:
        return
    trees, one = loaded.trees, len(loaded.parts) == 1
    where = "this file" if one else "this file and those that it includes"
    main_tree = loaded.file.main
    if not one and main_tree is not None and main_tree.name not in trees:
        message = f"behavior tree cannot be loaded: there is no tree '{main_tree.name}', its main tree"
        yield loaded.path, _Wrong(message, main_tree.span, Subject("tree", main_tree.name))
    for part in loaded.parts:
        for used in part.file.subtrees:
            if used.name not in trees:
                near = nearest(used.name, trees)
                message = f"subtree '{used.name}' does not exist in {where}" + did_you_mean(near)
                kind: Kind = "absent" if near is None else "near"
                yield part.path, _Wrong(message, used.span, Subject("tree", used.name), kind, near)


RULE = Rule(
    id="BTR001",
    name="behavior-tree-not-loaded",
    effect="breaks",
    kind="invalid",
    always=(Reason.LIBRARY,),
    what="Checks for a behavior tree that a parameter names and that cannot be loaded. Its tags, its main tree, its "
    "subtrees or the files that it includes are wrong. The folders in `behavior_trees` must exist.",
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
