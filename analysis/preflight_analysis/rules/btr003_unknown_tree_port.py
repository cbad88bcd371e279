"""BTR003: an attribute in a behaviour tree that is no port of its node (ROS 2).

`createNodeFromXML` in src/xml_parsing.cpp of BehaviorTree/BehaviorTree.CPP: `Possible typo?`
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from preflight_analysis.documents.span import Location
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Doubt, Reason, doubts
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.model.behavior_trees import Loaded, has_only_nodes_of_nav, trees_of
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import did_you_mean, nearest
from preflight_analysis.model.problems import rename
from preflight_analysis.model.tree_nodes_in_sources import own_nodes
from preflight_analysis.rules.further_reading import BEHAVIOR_TREES
from preflight_analysis.rules.rule import Rule
from preflight_analysis.trees.known_nodes import BUILT_IN, NAV_DISTRIBUTIONS, is_version_3
from preflight_analysis.trees.ports import distributions_with, is_port, ports_of
from preflight_analysis.trees.read import Used

_SHARING = {True: ("__autoremap", "__shared_blackboard"), False: ("_autoremap",)}
"""By whether it is version 3 of BehaviorTree.CPP: attributes by which a subtree has the entries of its parent."""


class _Ports(NamedTuple):
    names: frozenset[str]
    doubts: tuple[Doubt, ...]
    related: tuple[Related, ...] = ()


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    seen = set[tuple[str, int]]()
    for loaded in trees_of(context):
        yield from _of_subtrees(rule, context, loaded, seen)
        only_nav = loaded.is_navigator and has_only_nodes_of_nav(context, loaded)
        for part in loaded.parts:
            for used in part.file.nodes if not part.file.problems else ():
                ports = _ports(context, used, loaded, only_nav=only_nav)
                for attribute in used.attributes if ports is not None else ():
                    name, span = attribute.name, attribute.name_span
                    if ports is None or name in ports.names or not is_port(name) or (part.path, span.start) in seen:
                        continue
                    seen.add((part.path, span.start))
                    near, place = nearest(name, ports.names), context.location(part.path, span)
                    elsewhere = distributions_with(used.name, name)
                    yield rule.claim(
                        f"'{name}' is not a port of '{used.name}'"
                        + (f" in {context.environment.distro}" if elsewhere else "")
                        + did_you_mean(near),
                        place,
                        subject=Subject("attribute", name),
                        kind="absent" if near is None else "near",
                        doubts=ports.doubts,
                        candidates=(near,),
                        related=(*loaded.related, *ports.related),
                        fixes=rename(context, place, name, near) if near is not None else (),
                    )


def _of_subtrees(rule: Rule, context: Context, loaded: Loaded, seen: set[tuple[str, int]]) -> Iterator[Finding]:
    """What shares the blackboard with a subtree in the other version of BehaviorTree.CPP only."""
    distro = context.environment.distro
    if not loaded.is_navigator or distro not in NAV_DISTRIBUTIONS:
        return
    is_old = is_version_3(distro)
    for part, used in loaded.subtrees:
        for attribute in used.attributes:
            if attribute.name not in _SHARING[not is_old] or attribute.value.text.lower() not in ("1", "true"):
                continue
            if (part.path, attribute.name_span.start) in seen:
                continue
            seen.add((part.path, attribute.name_span.start))
            near = "__autoremap' of <SubTreePlus>" if is_old else "_autoremap'"
            version = 3 if is_old else 4
            yield rule.claim(
                f"'{attribute.name}' of <{used.tag}> has no effect in BehaviorTree.CPP {version}, which Nav2 of "
                f"{distro} uses; did you mean '{near}?",
                context.location(part.path, attribute.name_span),
                subject=Subject("attribute", attribute.name),
                effect="no-effect",
                related=loaded.related,
            )


def _ports(context: Context, used: Used, loaded: Loaded, *, only_nav: bool) -> _Ports | None:
    own = own_nodes(context.disk.db, context.environment)
    node = own.nodes.get(used.name)
    if node is not None:
        at = Related(f"'{used.name}' is registered here", Location.of_file(node.path))
        return _Ports(frozenset(node.ports), doubts(FROM_SOURCE=True), (at,)) if node.ports is not None else None
    distro = context.environment.distro
    ports = ports_of(used.name, distro if distro in NAV_DISTRIBUTIONS else None)
    if ports is None or own.has(used.name) or not (loaded.is_navigator or used.name in BUILT_IN):
        return None
    return _Ports(ports, doubts(OTHER_VERSION=distro not in NAV_DISTRIBUTIONS, PARTLY_READ=not only_nav))


RULE = Rule(
    id="BTR003",
    name="unknown-behavior-tree-port",
    effect="breaks",
    kind="near",
    always=(Reason.LIBRARY,),
    sometimes=("no-effect", Reason.OTHER_VERSION, Reason.FROM_SOURCE, Reason.PARTLY_READ),
    what="Checks for an attribute of a node in a behavior tree that is not one of its ports. So it does for "
    "attributes of subtrees that only the other version of BehaviorTree.CPP has.",
    why="bt_navigator cannot create the tree. It rejects the goal or does not become active.",
    example='<ComputePathToPose gaol="{goal}" path="{path}" planner_id="GridBased"/>',
    instead='<ComputePathToPose goal="{goal}" path="{path}" planner_id="GridBased"/>',
    references=(BEHAVIOR_TREES,),
    generations=(2,),
    check=_check,
)
