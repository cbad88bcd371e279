"""BTR002: a behaviour tree node that no loaded library has (ROS 2).

https://docs.nav2.org/configuration/packages/configuring-bt-navigator.html
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from preflight_analysis.findings.finding import Finding, Severity
from preflight_analysis.rules.behavior_trees import Loaded, trees_of
from preflight_analysis.rules.further_reading import BEHAVIOR_TREES
from preflight_analysis.rules.nearest import did_you_mean, is_slip
from preflight_analysis.rules.rule import Context, Rule
from preflight_analysis.trees.known_nodes import (
    BUILT_IN,
    NAV_DISTRIBUTIONS,
    NAV_LIBRARIES,
    NAV_NODES,
    loads_by_default,
)


class _Complaint(NamedTuple):
    message: str
    severity: Severity
    near: str | None = None


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    seen = set[tuple[str, int]]()
    for loaded in context.once(trees_of):
        only_nav = _has_only_nodes_of_nav(context, loaded)
        for used in loaded.file.nodes if not loaded.file.problems else ():
            if used.name in BUILT_IN or used.name in loaded.file.trees or (loaded.path, used.span.start) in seen:
                continue
            found = _complaint(used.name, loaded, context.environment.distro, only_nav=only_nav)
            if found is None:
                continue
            seen.add((loaded.path, used.span.start))
            place = context.location(loaded.path, used.span)
            yield rule.finding(
                found.message + did_you_mean(found.near),
                place,
                severity=found.severity,
                confidence="likely",
                related=loaded.related,
            )


def _complaint(name: str, loaded: Loaded, distro: str | None, *, only_nav: bool) -> _Complaint | None:
    severity: Severity = "warning" if only_nav else "info"
    node = NAV_NODES.get(name)
    if node is None:
        near = [each for each in (*NAV_NODES, *BUILT_IN) if is_slip(name, each)]
        meant = near[0] if len(near) == 1 else None
        if meant is None and (not only_nav or loaded.file.includes):
            return None
        # Nav2 gets new nodes; a slip of a known one is none of them.
        return _Complaint(f"unknown behavior tree node '{name}'", severity if meant is not None else "info", meant)
    if distro not in NAV_DISTRIBUTIONS:
        return None
    library = node.libraries.get(distro)
    if library is None:
        return _Complaint(f"behavior tree node '{name}' does not exist in Nav2 of {distro}", severity)
    listed = loaded.libraries
    if loads_by_default(distro, library) or listed is None or library in listed:
        return None
    return _Complaint(f"behavior tree node '{name}' needs '{library}' in 'plugin_lib_names'", severity)


def _has_only_nodes_of_nav(context: Context, loaded: Loaded) -> bool:
    """Whether the node loads no other libraries: its list is known, and Nav2 is not changed in the workspace."""
    own = context.environment.packages.get("nav2_behavior_tree")
    workspace = context.environment.workspace
    if own is not None and workspace is not None and own.share.startswith(workspace.rstrip("/") + "/"):
        return False
    return loaded.knows_all and NAV_LIBRARIES.issuperset(loaded.libraries or ())


RULE = Rule(
    id="BTR002",
    name="unknown-behavior-tree-node",
    severity="warning",
    what="Checks for a node in a behavior tree that no library of bt_navigator has: a typo, a node of another "
    "distribution, or a node whose library `plugin_lib_names` does not list. Nodes of Nav2 and BehaviorTree.CPP are "
    "known. The finding is information if `plugin_lib_names` lists other libraries, or if it is not known. An unknown "
    "node is information too if no known name is similar.",
    why="bt_navigator cannot create the tree. It rejects the goal or does not become active.",
    example='<RecoveryNod number_of_retries="6">\n  <ComputePathToPose goal="{goal}" path="{path}"/>\n</RecoveryNod>',
    instead='<RecoveryNode number_of_retries="6">\n  <ComputePathToPose goal="{goal}" path="{path}"/>\n</RecoveryNode>',
    references=(BEHAVIOR_TREES,),
    generations=(2,),
    check=_check,
)
