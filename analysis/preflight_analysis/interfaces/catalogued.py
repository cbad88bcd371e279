"""What the catalogue says of nodes of which nothing else is known to the end: their package is not here, or has no
source, and no run came to the event loop.

It has them as the analysis read their source at the commit that it names, with no parameter set: the version that runs
on the robot may be another, and do what those that are given to it decide.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any, TypeVar

from preflight_analysis.catalogue.packages import distribution_of, interfaces_of
from preflight_analysis.catalogue.released import DISTRIBUTIONS
from preflight_analysis.catalogue.renamed import other_names
from preflight_analysis.dataclass import dataclass
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.meanings import params_by_namespace, place_of, within
from preflight_analysis.evaluation.ros2.spawners import LOAD_CONTROLLER, asked_of, is_spawner
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree, Param
from preflight_analysis.incremental.kept import Kept
from preflight_analysis.interfaces.nodl_groups import GROUPS
from preflight_analysis.interfaces.part import Launch, Part, Rows
from preflight_analysis.tracing.interface import (
    Endpoint,
    Evidence,
    Interface,
    MadeNode,
    NamedBy,
    ParamUse,
    Range,
    Role,
    TypedBy,
)

_What = TypeVar("_What", Endpoint, ParamUse)
_SAID = Evidence("catalogue")
_KEPT = 1024
_TYPE = ".type"
_NAMED_BY = "named_by"
_TYPED_BY = "typed_by"
_REMAPPED = "remapped"
_WORDS = re.compile("[./]")
_SERIES = re.compile(r"(\D*[A-Za-z])0")
"""The name of the first parameter of a numbered series."""
_PACKAGES = {"parallel_gripper_action_controller": "parallel_gripper_controller"}
"""The package of controllers whose types begin with another name."""
_OF_SPAWNERS = tuple(ParamUse(f"~{name}", "get") for name in ("type", "fallback_controllers"))
"""What the section of a controller has for its spawner
(https://control.ros.org/jazzy/doc/ros2_control/controller_manager/doc/userdoc.html)."""


@dataclass(frozen=True, slots=True)
class Catalogued:
    """What a node does, and where that is from, in words."""

    endpoints: tuple[Endpoint, ...]
    params: tuple[ParamUse, ...]
    nodes: tuple[MadeNode, ...]
    said_by: str
    by_parameter: tuple[tuple[str, Endpoint], ...] = ()
    """Ends that parameters name where they are set, of which those with a default are among `endpoints`."""
    typed: tuple[tuple[Endpoint, str, Mapping[str, str]], ...] = ()
    """Ends whose type a parameter decides, with what it is by the value in words."""
    remapped: tuple[tuple[Endpoint, str], ...] = ()
    """Ends whose names begin with what a remap makes of that name."""
    of_others: bool = False
    """ROS 2: whether there are parameters of further nodes, below the namespace of this one."""


def catalogue_asked(launch: Launch, known: Sequence[Interface]) -> Rows | None:
    """What decides which names and types the nodes have that the catalogue knows."""
    if not any(map(_lacks, known)):
        return None
    tree, environment = launch.tree, launch.environment
    columns = _own_params(tree, launch.kept), _asked(tree)
    return Rows(columns, (environment, distribution_of(tree.generation, environment.distro)))


def from_catalogue(
    node: LaunchNode,
    interface: Interface,
    given: Sequence[Param],
    asked: tuple[str, ...],
    environment: Environment,
    distro: str,
) -> Part | None:
    """What the catalogue says of a node of which a run did not tell all, as there was none or it ended early. A package
    of the workspace is what it is there, whatever others of its name do."""
    if not _lacks(interface) or not node.package:
        return None
    package, kind, name = place_of(node)
    here = environment.packages.get(package)
    if here is not None and here.is_within(environment.workspace):
        return None
    is_used = environment.distro == distro
    found = catalogued(package, kind, name, distro, is_used=is_used)
    if found is None:
        # What had another name then may have had other parameters, too.
        others = (catalogued(*known, distro, is_used=False) for known in _renamed(package, kind, name, distro))
        found = next(filter(None, others), None)
    if found is None:
        return None
    open_ = node.lacks_params or may_be_newer(environment.distro, distro)
    found = _as_remapped(node, _as_set(node, given, found, newer=open_))
    if found.of_others:
        params = (replace(use, name=names.join(node.namespace, use.name)) for use in found.params)
        found = replace(found, params=tuple(params))
    manages = bool(asked) or any(end.type == LOAD_CONTROLLER for end in found.endpoints)
    does = (found, *(_controllers(node, asked, distro, is_used=is_used) if manages else ()))
    not_here = "its package is not installed here" if here is None else None
    reason = "; ".join(filter(None, (not_here or interface.outcome.reason, f"known by {found.said_by}")))
    return Part(
        "catalogue",
        tuple(end for each in does for end in each.endpoints),
        tuple(use for each in does for use in each.params),
        tuple(made for each in does for made in each.nodes) if len(does) == 1 else _beside(node, does),
        # How its run ended is not changed by what is known beyond that.
        reason=None if interface.known else reason,
    )


def _lacks(interface: Interface) -> bool:
    """Whether nothing is known of a node but by a run that ended early."""
    seen = interface.known and not (interface.source == "trace" and interface.outcome.early)
    return not (seen or interface.pending)


def _renamed(package: str, kind: str, name: str, distro: str) -> Iterator[tuple[str, str, str]]:
    for other, named in other_names(package, kind, name, distro):
        yield other, kind, named


def _controllers(node: LaunchNode, asked: Sequence[str], distro: str, *, is_used: bool) -> Iterator[Catalogued]:
    """The nodes of the controllers that a controller manager has the types of (`NAME.type`), and of those that spawners
    ask it for. It has them once a spawner asks for them. Of a type that is not known it is not known what it does."""
    types = {
        param.name.removesuffix(_TYPE): param.value
        for param in node.params
        if param.name.endswith(_TYPE) and isinstance(param.value, str)
    }
    for name in dict.fromkeys((*types, *asked)):
        type_, full = types.get(name, ""), names.join(node.namespace, name)
        prefix = type_.partition("/")[0]
        found = catalogued(_PACKAGES.get(prefix, prefix), "controllers", type_, distro, is_used=is_used)
        if found is None:
            made = MadeNode(name, name, evidence=_SAID, full=full, unknown=True)
            yield Catalogued((), (), (made,), "")
        else:
            yield replace(
                found,
                endpoints=tuple(_on_condition(end, full) for end in found.endpoints),
                params=tuple(_on_condition(use, full) for use in (*found.params, *_OF_SPAWNERS)),
                nodes=(MadeNode(name, name, evidence=_SAID, full=full),),
            )


def _on_condition(what: _What, node: str) -> _What:
    """An end or a parameter of one of several nodes, which is there once somebody asks for it."""
    return replace(what, node=node, evidence=what.evidence.but("condition"))


def _asked(tree: LaunchTree) -> Sequence[tuple[str, ...]]:
    """The controllers that spawners ask each node for."""
    found: dict[str, list[str]] = {}
    for node in tree.nodes if tree.ros.ament else ():
        asked = asked_of(node) if is_spawner(node) and not node.unknowns else None
        if asked is not None:
            found.setdefault(asked.manager, []).extend(asked.controllers)
    return [tuple(found.get(node.name, ())) for node in tree.nodes_and_simulated]


def _own_params(tree: LaunchTree, kept: Kept) -> Sequence[Sequence[Param]]:
    """The parameters that each node is given, those of ROS 1 that stand right below its name."""
    if tree.ros.own_parameters:
        return [node.params for node in tree.nodes_and_simulated]
    below = params_by_namespace(tree, kept)
    return [below.get(node.name, ()) for node in tree.nodes]


def _as_set(node: LaunchNode, given: Sequence[Param], found: Catalogued, *, newer: bool) -> Catalogued:
    """With the names and types of ends that parameters of the node give: `odom0` stands for `odom1` and all others of a
    series, `topics.*.topic` for what is below each of `topics`. `newer`: as `typed_end`."""
    if not found.by_parameter and not found.typed:
        return found
    own = [(param.name.removeprefix(f"{node.name}/"), param) for param in given]
    by_name = dict(own)
    typed = {}
    for end, name, types in found.typed:
        param = by_name.get(name)
        value, place = (param.value, param.place) if param is not None else (None, None)
        typed[id(end)] = typed_end(end, TypedBy(name, place, tuple(types.items())), value, newer=newer)
    ends = [typed.get(id(end), end) for end in found.endpoints]
    for pattern, each in found.by_parameter:
        end = typed.get(id(each), each)
        series = not end.name
        values = [(p, value) for name, p in own for value in _of_pattern(name, p.value, pattern, series=series)]
        if values:
            ends = [each for each in ends if each is not end]
        for param, value in values:
            if isinstance(value, str) and value and names.is_legal(value):
                by = NamedBy(param.name, param.place)
                evidence = end.evidence if end.name else end.evidence.without("condition")
                ends.append(replace(end, name=value, evidence=evidence, named_by=by))
    return replace(found, endpoints=tuple(ends))


def typed_end(end: Endpoint, by: TypedBy, value: object, *, newer: bool) -> Endpoint:
    """With the type that a parameter gives, which has the value, None where it is not set. `newer`: the distribution
    may be newer than the one of the catalogue, and have another default, or a file that is not known sets it."""
    unset = None if newer else end.type
    type_ = unset if value is None else dict(by.types).get(str(value).lower(), end.type)
    return replace(end, type=type_, typed_by=by)


def may_be_newer(distro: str | None, known: str) -> bool:
    """Whether it is newer than the one that the catalogue knows, or is not known."""
    every = (*DISTRIBUTIONS[1], *DISTRIBUTIONS[2])
    return distro not in every or known not in every or every.index(distro) > every.index(known)


def _as_remapped(node: LaunchNode, found: Catalogued) -> Catalogued:
    """With the names of ends that begin with another one which the node is given a remap for."""
    targets = {names.resolve(each.source, node.name): names.resolve(each.target, node.name) for each in node.remaps}
    renamed = {
        id(end): replace(end, name=target + end.name[len(begin) :])
        for end, begin in (found.remapped if targets else ())
        if (target := targets.get(names.resolve(begin, node.name))) is not None
    }
    ends = tuple(renamed.get(id(end), end) for end in found.endpoints)
    return replace(found, endpoints=ends) if renamed else found


def _of_pattern(name: str, value: Any, pattern: str, *, series: bool) -> Iterator[Any]:
    """What a parameter has where the pattern says: the value, or what is within it. `*` is for any name, and for each
    item of a list."""
    numbered = _SERIES.fullmatch(pattern) if series else None
    if name == pattern or (numbered is not None and name.removeprefix(numbered[1]).isdecimal()):
        yield value
    elif "*" in pattern:
        words, wanted = _WORDS.split(name), _WORDS.split(pattern)
        if len(words) <= len(wanted) and all(want in ("*", word) for word, want in zip(words, wanted, strict=False)):
            yield from within(value, wanted[len(words) :])


def _beside(node: LaunchNode, does: Sequence[Catalogued]) -> tuple[MadeNode, ...]:
    """The nodes of a process, of which the first are those that the launch file knows."""
    own, *others = (each.nodes for each in does)
    name = node.name.rpartition("/")[2]
    first = own or (MadeNode(name, "", evidence=_SAID),)
    return (*(replace(made, full=node.name) for made in first), *(made for each in others for made in each))


@lru_cache(maxsize=_KEPT)
def catalogued(package: str, kind: str, name: str, distro: str, *, is_used: bool = True) -> Catalogued | None:
    """What is known of a node; None where nothing is, or the data is broken. `is_used`: whether that distribution is
    the one that is used."""
    try:
        return _catalogued(interfaces_of(package, distro), kind, name, distro, is_used=is_used)
    except (KeyError, TypeError, ValueError, AttributeError):
        return None


def _catalogued(
    of_package: Mapping[str, Any], kind: str, name: str, distro: str, *, is_used: bool
) -> Catalogued | None:
    found = of_package.get(kind, {}).get(name)
    if found is None:
        return None
    repository, commit, _ = of_package["source"]
    said_by = f"the catalogue of {distro} ({repository} at {commit[:7]})"

    def end(role: Role, each: Mapping[str, Any], name: str) -> Endpoint:
        return Endpoint(
            role,
            name,
            each.get("type"),
            None,
            each.get("qos", {}),
            evidence=_evidence(each, said_by, is_used=is_used),
        )

    rows = [(role, each) for role, group in GROUPS.items() for each in found.get(group, ())]
    ends = [(end(role, each, each.get("name", "") if _NAMED_BY in each else each["name"]), each) for role, each in rows]
    return Catalogued(
        tuple(made for made, _ in ends if made.name),
        tuple(_param(name, about, said_by, is_used=is_used) for name, about in found.get("parameters", {}).items()),
        tuple(MadeNode(made, made, space, renamed, _SAID) for made, space, renamed in found.get("nodes", ())),
        said_by,
        tuple((each[_NAMED_BY].removeprefix("~"), made) for made, each in ends if _NAMED_BY in each),
        tuple(
            (made, name.removeprefix("~"), types)
            for made, each in ends
            for name, types in each.get(_TYPED_BY, {}).items()
        ),
        tuple((made, each[_REMAPPED]) for made, each in ends if _REMAPPED in each),
        kind != "plugins" and distro in DISTRIBUTIONS[2] and any(map(_is_relative, found.get("parameters", ()))),
    )


def _evidence(about: Mapping[str, Any], said_by: str, *, is_used: bool) -> Evidence:
    known = Evidence("catalogue", said_by)
    known = known.but("condition") if "conditional" in about else known
    return known if is_used else known.but("other distribution")


def _is_relative(param: str) -> bool:
    return not param.startswith(("~", "/"))


def _param(name: str, about: Mapping[str, Any], said_by: str, *, is_used: bool) -> ParamUse:
    return ParamUse(
        name,
        about.get("access", "get"),
        about.get("default_value"),
        "default_value" in about or "has_default" in about,
        "mandatory" in about,
        evidence=_evidence(about, said_by, is_used=is_used),
        type=about.get("type"),
        dynamic="dynamic" in about,
        read_only="read_only" in about,
        range=Range(*about["range"]) if "range" in about else None,
    )
