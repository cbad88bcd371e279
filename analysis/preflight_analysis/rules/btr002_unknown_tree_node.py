"""BTR002: a behaviour tree node that no loaded library has (ROS 2).

https://docs.nav2.org/configuration/packages/configuring-bt-navigator.html
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from preflight_analysis.edits.xml import XmlWriter
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Doubt, Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.behavior_trees import Loaded, has_only_nodes_of_nav, trees_of
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import did_you_mean, is_slip
from preflight_analysis.model.problems import fix
from preflight_analysis.model.tree_nodes_in_sources import own_nodes
from preflight_analysis.rules.further_reading import BEHAVIOR_TREES
from preflight_analysis.rules.rule import Rule
from preflight_analysis.trees.known_nodes import (
    BUILT_IN,
    NAV_DISTRIBUTIONS,
    NAV_NODES,
    built_in,
    instead_of,
    is_version_3,
    loads_by_default,
)
from preflight_analysis.trees.read import SUBTREES


class _Complaint(NamedTuple):
    message: str
    near: str | None = None
    doubts: tuple[Doubt, ...] = ()


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    seen = set[tuple[str, int]]()
    for loaded in trees_of(context):
        if not loaded.is_navigator:
            continue
        only_nav = has_only_nodes_of_nav(context, loaded)
        here = built_in(context.environment.distro)
        for part, used in (*loaded.nodes, *loaded.subtrees):
            name, span = (used.tag, used.tag_span) if used.tag in SUBTREES else (used.name, used.span)
            if name in here or name in loaded.trees or (part.path, span.start) in seen:
                continue
            found = _complaint(context, name, loaded, only_nav=only_nav)
            if found is None:
                continue
            seen.add((part.path, span.start))
            edits = XmlWriter(part.document).replace(span, found.near) if found.near is not None else ()
            yield rule.claim(
                found.message + did_you_mean(found.near),
                context.location(part.path, span),
                subject=Subject("tree-node", name),
                kind="absent" if found.near is None else "near",
                doubts=found.doubts,
                candidates=(found.near,),
                related=loaded.related,
                fixes=fix(f"Replace '{name}' with '{found.near}'", edits, preferred=True),
            )


def _complaint(context: Context, name: str, loaded: Loaded, *, only_nav: bool) -> _Complaint | None:
    distro = context.environment.distro
    others = doubts(PARTLY_READ=not only_nav)
    node = NAV_NODES.get(name)
    if name in loaded.models or own_nodes(context.disk.db, context.environment).has(name):
        return None
    if name in BUILT_IN and distro is not None:
        version = 3 if is_version_3(distro) else 4
        message = f"'{name}' does not exist in BehaviorTree.CPP {version}, which Nav2 of {distro} uses"
        return _Complaint(message, instead_of(name, distro))
    if node is None:
        near = [each for each in (*NAV_NODES, *BUILT_IN) if is_slip(name, each)]
        meant = near[0] if len(near) == 1 else None
        if meant is None and not (only_nav and loaded.whole):
            return None
        # Nav2 gets new nodes; a slip of a known one is none of them.
        why = (*others, *doubts(OTHER_VERSION=meant is None))
        return _Complaint(f"unknown behavior tree node '{name}'", meant, why)
    if distro not in NAV_DISTRIBUTIONS:
        return None
    library = node.libraries.get(distro)
    if library is None:
        return _Complaint(f"behavior tree node '{name}' does not exist in Nav2 of {distro}", doubts=others)
    listed = loaded.libraries
    if loads_by_default(distro, library) or listed is None or library in listed:
        return None
    return _Complaint(f"behavior tree node '{name}' needs '{library}' in 'plugin_lib_names'", doubts=others)


RULE = Rule(
    id="BTR002",
    name="unknown-behavior-tree-node",
    effect="breaks",
    kind="near",
    always=(Reason.LIBRARY,),
    sometimes=(Reason.OTHER_VERSION, Reason.PARTLY_READ),
    what="Checks for a node in a behavior tree that no library of bt_navigator has. It is a typo, a node of another "
    "version, or one whose library `plugin_lib_names` does not list.",
    why="bt_navigator cannot create the tree. It rejects the goal or does not become active.",
    example='<RecoveryNod number_of_retries="6">\n  <ComputePathToPose goal="{goal}" path="{path}"/>\n</RecoveryNod>',
    instead='<RecoveryNode number_of_retries="6">\n  <ComputePathToPose goal="{goal}" path="{path}"/>\n</RecoveryNode>',
    references=(BEHAVIOR_TREES,),
    generations=(2,),
    check=_check,
)
