"""What a run of the same executable elsewhere showed, or what the source of a node says: where its own run did not
tell it to the end."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import chain, compress
from operator import is_, is_not
from typing import Any, Literal

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.partial_text import is_whole
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.generation import Generation
from preflight_analysis.incremental.kept import Before
from preflight_analysis.interfaces.part import Launch, Part, Rows
from preflight_analysis.source.analyse import SourceInterface, source_key
from preflight_analysis.source.known_params import LaunchParams
from preflight_analysis.tracing.interface import CHANGE_STATE, KINDS, Endpoint, Interface, ParamUse
from preflight_analysis.tracing.similar import asked

_Gap = Literal["all", "places", "later", "places, later", "frames", "transitions"]
"""What is not known of a node."""
_TF = ("tf", "tf_static")


def similar_asked(launch: Launch, known: Sequence[Interface]) -> Rows | None:
    """For each node of which not all is known, what its executable did elsewhere."""
    if launch.similar is None:
        return None
    unknown = [at for at, (node, each) in enumerate(zip(launch.nodes, known, strict=True)) if _lacks(node, each)]
    if not unknown:
        return None
    as_asked = launch.kept.each(asked, launch.nodes, launch.tree.generation)
    found = launch.similar.each([as_asked[at] for at in unknown], _params(launch).values)
    return Rows((launch.shown(dict(zip(unknown, found, strict=True))),))


def similar(node: LaunchNode, known: Interface, found: Interface | None) -> Part | None:
    """What the executable did in a run under another configuration."""
    if found is None:
        return None
    return Part("similar", found.endpoints, found.params, frames=found.frames, elsewhere=found.elsewhere)


def source_asked(launch: Launch, known: Sequence[Interface]) -> Rows | None:
    """What the source of each node says of which something is not known, and what that is."""
    gaps = launch.kept.each_row(_gap, (launch.nodes, known), launch.tree.ros)
    if not any(gaps):
        return None
    keys = launch.kept.each(source_key, launch.nodes)
    lacking = [at for at, gap in enumerate(gaps) if gap]
    found = launch.sources.read_each([keys[at] for at in lacking], _params(launch))
    return Rows((gaps, launch.shown(dict(zip(lacking, found, strict=True)))))


def of_source(node: LaunchNode, known: Interface, gap: _Gap | None, found: SourceInterface | None) -> Part | None:
    """What the source says of what is not known."""
    if found is None or gap is None:
        return None
    if gap == "all":
        return _whole(node, known, found)
    if gap == "transitions":
        return Part("source", transitions=found.transitions, leads=False)
    has_frames = known.frames or known.frame_uses
    corrected, listed = _places(known, found) if "places" in gap else ((), ())
    return Part(
        "source",
        params=listed or (_later(node, known, found) if "later" in gap else ()),
        frames=() if has_frames else found.frames,
        frame_uses=() if has_frames else found.frame_uses,
        corrected=corrected,
        leads=False,
    )


def _gap(node: LaunchNode, interface: Interface, ros: Generation) -> _Gap | None:
    if _lacks(node, interface):
        return "all" if interface.source != "similar" else None
    placeless = _is_placeless(interface, ros)
    if _may_declare_later(node, interface, ros):
        return "places, later" if placeless else "later"
    if placeless:
        return "places"
    if _has_unknown_frames(interface):
        return "frames"
    return "transitions" if _may_activate_itself_later(interface) else None


def _params(launch: Launch) -> LaunchParams:
    """What the launch sets by full name, in ROS 2 for the nodes."""
    of_nodes = launch.kept.each(_values_of_node, launch.tree.nodes)
    return launch.kept.patched(_launch_params, "", launch.tree.all_params, of_nodes)


def _launch_params(
    before: Before[LaunchParams] | None, params: tuple[Param, ...], of_nodes: tuple[Mapping[str, Any], ...]
) -> LaunchParams:
    """What is set by full name, in ROS 2 for the nodes. Commands that were not run give nothing."""
    if before is not None:
        (old_params, old_of_nodes), known = before
        if all(map(is_, old_of_nodes, of_nodes)) and list(map(len, before[0])) == [len(params), len(of_nodes)]:
            changed = [*map(is_not, old_params, params)]
            gone = (param.name for param in compress(old_params, changed))
            return known.changed(gone, _plain(compress(params, changed)))
    return LaunchParams({**_plain(params), **dict(chain.from_iterable(each.items() for each in of_nodes))})


def _plain(params: Iterable[Param]) -> dict[str, Any]:
    return {param.name: param.value for param in params if is_whole(param.value)}


_NO_VALUES: Mapping[str, Any] = {}


def _values_of_node(node: LaunchNode) -> Mapping[str, Any]:
    return {f"{node.name}/{param.name}": param.value for param in node.params} if node.params else _NO_VALUES


def _lacks(node: LaunchNode, interface: Interface) -> bool:
    """Whether not all is known of it. Nobody reads a source for a simulated node."""
    outcome = interface.outcome
    ended_well = outcome.status == "exited" and outcome.exit_code == 0
    # Of what it makes under names of its own invention the source says no more.
    return node.kind != "simulated" and not (interface.complete or ended_well or interface.pending or interface.unnamed)


def _is_placeless(interface: Interface, ros: Generation) -> bool:
    """Whether all is known of what a node does, but nothing of where in its source: rcl is not told that."""
    seen = interface.endpoints + interface.params
    has_places = any(each.source_file is not None for each in seen)
    return not ros.traces_have_places and interface.source == "trace" and bool(seen) and not has_places


def _may_declare_later(node: LaunchNode, interface: Interface, ros: Generation) -> bool:
    """Whether a node of ROS 2 is given a parameter that its run did not declare: a callback may do so that the run did
    not wait for, of a timer for instance."""
    declared = {use.name.removeprefix("~") for use in interface.params}
    declares = ros.own_parameters and interface.source == "trace" and bool(declared)
    return declares and any(param.name not in declared for param in node.params)


def _has_unknown_frames(interface: Interface) -> bool:
    """Whether its run told that it broadcasts frames or listens to them, and not which."""
    if interface.source not in ("trace", "similar") or interface.frames or interface.frame_uses:
        return False
    return any(not end.evidence.inferred and names.leaf(end.name) in _TF for end in interface.endpoints)


def _may_activate_itself_later(interface: Interface) -> bool:
    """Whether a run showed a lifecycle node that did not activate itself: a callback may do so that the run did not
    wait for."""
    managed = any(end.type == CHANGE_STATE and end.role == "service" for end in interface.endpoints)
    return managed and interface.source == "trace" and "activate" not in interface.transitions


def _later(node: LaunchNode, interface: Interface, found: SourceInterface) -> tuple[ParamUse, ...]:
    """What the node is given and only its source declares."""
    seen = {use.name.removeprefix("~") for use in interface.params}
    given = {param.name for param in node.params} - seen
    return tuple(use for use in found.params if use.name.removeprefix("~") in given)


def _places(
    interface: Interface, found: SourceInterface
) -> tuple[tuple[tuple[Endpoint | ParamUse, Endpoint | ParamUse], ...], tuple[ParamUse, ...]]:
    """What was seen with the places in the source where it is made, and the parameters of a client library that does
    not tell them (its node "lists" them)."""
    places = {(e.role, e.name): (e.source_file, e.source_line) for e in found.endpoints}
    declared = {use.name: use for use in found.params}
    corrected: list[tuple[Endpoint | ParamUse, Endpoint | ParamUse]] = []
    for end in interface.endpoints:
        file, line = places.get((end.role, end.name), (None, None))
        corrected.append((end, replace(end, source_file=file, source_line=line)))
    corrected += [(use, _described(use, declared[use.name])) for use in interface.params if use.name in declared]
    lists = any(use.access == "list" for use in interface.params)
    return tuple(corrected), tuple(declared.values()) if lists else ()


def _described(use: ParamUse, said: ParamUse) -> ParamUse:
    """A parameter that was seen, with what the source says of it beyond that."""
    default = use if use.has_default else said
    return replace(
        said,
        default=default.default,
        has_default=default.has_default,
        type=said.type or use.type,
        builtin=use.builtin,
        evidence=use.evidence,
    )


def _whole(node: LaunchNode, interface: Interface, found: SourceInterface) -> Part:
    # There may be no executable, but what it is to be made of.
    is_built = node.resolved.path is not None or node.resolved.not_executable or node.unknowns
    return Part(
        "source",
        tuple(_beside(found, endpoint) for endpoint in found.endpoints),
        found.params,
        found.nodes,
        found.frames,
        found.frame_uses,
        found.transitions,
        tuple(type_ or "*" for role, type_ in found.unnamed if role == "client"),
        tuple((end, _beside(found, end)) for end in interface.endpoints) if found.unnamed else (),
        KINDS if found.whole else (),
        reason=None if is_built else "it is not built yet",
    )


def _beside(found: SourceInterface, end: Endpoint) -> Endpoint:
    """The end, with whether others of its role and type have names that are not known."""
    beside = not {(end.role, end.type), (end.role, None), (end.role, "*")}.isdisjoint(found.unnamed)
    return replace(end, evidence=end.evidence.but("computed names")) if beside else end
