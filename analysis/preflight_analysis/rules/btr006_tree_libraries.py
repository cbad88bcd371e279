"""BTR006: a library of behaviour tree nodes that bt_navigator cannot load, or loads twice (ROS 2).

`registerBuilder` in src/bt_factory.cpp of BehaviorTree/BehaviorTree.CPP: `already registered`; `on_configure` in
nav2_bt_navigator/src/bt_navigator.cpp of ros-navigation/navigation2, which since Jazzy loads its own libraries before
those of `plugin_lib_names`: https://docs.nav2.org/migration/Iron.html
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.tree import Param
from preflight_analysis.evaluation.value_places import value_place
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.model.behavior_trees import LIBRARIES, has_own_nav, is_navigator, libraries_of
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import did_you_mean, is_slip_of_words
from preflight_analysis.model.problems import include_chain, rename
from preflight_analysis.rules.further_reading import BEHAVIOR_TREES
from preflight_analysis.rules.rule import Rule
from preflight_analysis.trees.known_nodes import NAV_DISTRIBUTIONS, NAV_LIBRARIES, NAV_NODES, loads_by_default

_LISTS = f"'{LIBRARIES}' of {{node}} lists {{what}}"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    seen = set[Location]()
    for node in filter(is_navigator, context.tree.nodes):
        param = next((each for each in node.params if each.name == LIBRARIES), None)
        listed = libraries_of(node)
        if param is None or listed is None or param.place in seen:
            continue
        seen.add(param.place)
        related = include_chain(node.origin)
        yield from _twice(rule, context, node.name, param, listed, related)
        for library in dict.fromkeys(listed):
            yield from _unknown(rule, context, node.name, param, library, related)


def _twice(
    rule: Rule, context: Context, name: str, param: Param, listed: Sequence[str], related: tuple[Related, ...]
) -> Iterator[Finding]:
    distro = context.environment.distro or ""
    is_known = distro in NAV_DISTRIBUTIONS and not has_own_nav(context)
    by_default = [each for each in listed if is_known and each in _libraries(distro) and loads_by_default(distro, each)]
    again = [each for at, each in enumerate(listed) if each in listed[:at] and each not in by_default]
    if by_default:
        nodes = sorted(each for each, node in NAV_NODES.items() if node.libraries.get(distro) == by_default[0])
        some = f"'{by_default[0]}'" if len(by_default) == 1 else f"{len(by_default)} libraries"
        what = f"{some} that bt_navigator of {distro} loads itself: it stops with 'ID [{nodes[0]}] already registered'"
        yield rule.claim(
            say(_LISTS, node=name, what=what),
            param.place,
            subject=Subject("parameter", LIBRARIES),
            kind="duplicate",
            doubts=doubts(CATALOGUE=True),
            related=related,
        )
    for library in dict.fromkeys(again):
        place = value_place(param.place, library, context.documents.get(param.place.file)) or param.place
        yield rule.claim(
            say(_LISTS, node=name, what=f"'{library}' twice: bt_navigator stops with 'already registered'"),
            place,
            subject=Subject("plugin", library),
            kind="duplicate",
            doubts=doubts(CATALOGUE=True),
            related=related,
        )


def _unknown(
    rule: Rule, context: Context, name: str, param: Param, library: str, related: tuple[Related, ...]
) -> Iterator[Finding]:
    """A slip of one of Nav2's libraries, or one that Nav2 of the distribution does not have."""
    distro = context.environment.distro or ""
    known = _libraries(distro) if distro in NAV_DISTRIBUTIONS else NAV_LIBRARIES
    if library in known or (library in NAV_LIBRARIES and has_own_nav(context)):
        return
    if library in NAV_LIBRARIES:
        same = {node.libraries[distro] for node in NAV_NODES.values() if _has(node.libraries, library, distro)}
        near = sorted(same)[:1]
        what = f"'{library}', which Nav2 of {distro} does not have"
    else:
        near = [each for each in known if is_slip_of_words(library, each)]
        what = f"the unknown library '{library}'"
        if len(near) != 1:
            return
    place = value_place(param.place, library, context.documents.get(param.place.file)) or param.place
    yield rule.claim(
        say(_LISTS, node=name, what=f"{what}{did_you_mean(near[0] if near else None)}"),
        place,
        subject=Subject("plugin", library),
        kind="near" if near else "absent",
        doubts=doubts(UNSEEN=True),
        candidates=near,
        related=related,
        fixes=rename(context, place, library, near[0]) if near else (),
    )


def _libraries(distro: str) -> frozenset[str]:
    return frozenset(node.libraries[distro] for node in NAV_NODES.values() if distro in node.libraries)


def _has(libraries: Mapping[str, str], library: str, distro: str) -> bool:
    """Whether the node is in that library elsewhere, and in some library of the distribution."""
    return library in libraries.values() and distro in libraries


RULE = Rule(
    id="BTR006",
    name="behavior-tree-libraries",
    effect="stops-node",
    kind="duplicate",
    sometimes=(Reason.CATALOGUE, Reason.UNSEEN),
    what="Checks the libraries in `plugin_lib_names` of bt_navigator. It loads one twice, or Nav2 of the distribution "
    "does not have it. Since Jazzy bt_navigator loads the libraries of Nav2 itself.",
    why="bt_navigator does not become active, and the lifecycle manager aborts the bringup.",
    example="bt_navigator:\n  ros__parameters:\n    plugin_lib_names:  # in Jazzy\n"
    "      - nav2_compute_path_to_pose_action_bt_node\n      - my_robot_open_door_bt_node",
    instead="bt_navigator:\n  ros__parameters:\n    plugin_lib_names:\n      - my_robot_open_door_bt_node",
    references=(BEHAVIOR_TREES,),
    generations=(2,),
    check=_check,
)
