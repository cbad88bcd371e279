"""What to take a node's interface from where its run did not tell it to the end."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import chain, compress
from operator import is_, is_not
from typing import Any, Literal

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.partial_text import is_whole
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree, Param
from preflight_analysis.generation import Generation
from preflight_analysis.graph.annotations import read_annotation
from preflight_analysis.incremental.kept import Before, Kept
from preflight_analysis.source.analyse import SourceAnalysis, SourceInterface, source_key
from preflight_analysis.source.known_params import LaunchParams
from preflight_analysis.tracing.interface import CHANGE_STATE, KINDS, Endpoint, Interface, ParamUse
from preflight_analysis.tracing.similar import SimilarTraces, asked


class Fallback:
    """Adds to interfaces what is known from elsewhere."""

    def __init__(self, sources: SourceAnalysis, similar: SimilarTraces | None = None) -> None:
        self._sources = sources
        self._similar = similar

    def fill_in(self, tree: LaunchTree, interfaces: Sequence[Interface], kept: Kept) -> tuple[Interface, ...]:
        """The interfaces of the nodes of `tree`, in order; to what a run did not tell to its end is added what a run of
        the same executable elsewhere told, or else its source.

        A node with an annotation is left alone: that is added with the graph, and is the user's word for all of it.
        """
        gaps = kept.each_row(_gap, (tree.nodes, interfaces), tree.ros)
        if not any(gaps):
            return tuple(interfaces)
        of_nodes = kept.each(_values_of_node, tree.nodes)
        params = kept.patched(_launch_params, "", tree.all_params, of_nodes)
        as_asked, keys = kept.each(asked, tree.nodes, tree.generation), kept.each(source_key, tree.nodes)
        found: dict[int, Interface | SourceInterface | None] = {at: None for at, gap in enumerate(gaps) if gap}
        if self._similar is not None:
            unknown = [at for at in found if gaps[at] == "all"]
            found.update(zip(unknown, self._similar.each([as_asked[at] for at in unknown], params.values), strict=True))
        of_source = [at for at, each in found.items() if each is None]
        found.update(zip(of_source, self._sources.read_each([keys[at] for at in of_source], params), strict=True))
        columns = (tree.nodes, interfaces, map(found.get, range(len(gaps))), gaps)
        return kept.each_row(_whole, columns)


_Gap = Literal["all", "places", "later", "places, later", "frames", "transitions"]
"""What is not known of a node."""
_TF = ("tf", "tf_static")


def _whole(
    node: LaunchNode, interface: Interface, found: Interface | SourceInterface | None, gap: _Gap | None
) -> Interface:
    if found is None or gap is None:
        return interface
    if gap == "all":
        return _with_more(node, interface, found)
    if gap == "transitions":
        made = found.transitions
        return replace(interface, transitions=made) if made else interface
    if isinstance(found, SourceInterface) and not interface.frames and not interface.frame_uses:
        interface = replace(interface, frames=found.frames, frame_uses=found.frame_uses)
    more = _with_places(interface, found) if "places" in gap else interface
    return _with_later(node, more, found) if "later" in gap else more


def _gap(node: LaunchNode, interface: Interface, ros: Generation) -> _Gap | None:
    if _lacks(interface) and read_annotation(node.action)[0] is None:
        return "all"
    placeless = _is_placeless(interface, ros)
    if _may_declare_later(node, interface, ros):
        return "places, later" if placeless else "later"
    if placeless:
        return "places"
    if _has_unknown_frames(interface):
        return "frames"
    return "transitions" if _may_activate_itself_later(interface) else None


def _launch_params(
    before: Before[LaunchParams] | None, params: tuple[Param, ...], of_nodes: tuple[Mapping[str, Any], ...]
) -> LaunchParams:
    """What is set by full name, in ROS 2 for the nodes. Commands that were not run give nothing."""
    if before is not None:
        (old_params, old_of_nodes), known = before
        if all(map(is_, old_of_nodes, of_nodes)) and list(map(len, before[0])) == [len(params), len(of_nodes)]:
            changed = [*compress(zip(old_params, params, strict=True), map(is_not, old_params, params))]
            return known.changed((old.name for old, _ in changed), _plain(new for _, new in changed))
    return LaunchParams({**_plain(params), **dict(chain.from_iterable(each.items() for each in of_nodes))})


def _plain(params: Iterable[Param]) -> dict[str, Any]:
    return {param.name: param.value for param in params if is_whole(param.value)}


_NO_VALUES: Mapping[str, Any] = {}


def _values_of_node(node: LaunchNode) -> Mapping[str, Any]:
    return {f"{node.name}/{param.name}": param.value for param in node.params} if node.params else _NO_VALUES


def _lacks(interface: Interface) -> bool:
    outcome = interface.outcome
    ended_well = outcome.status == "exited" and outcome.exit_code == 0
    # Of what it makes under names of its own invention the source says no more.
    return not (interface.complete or ended_well or interface.pending or interface.unnamed)


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
    return any(not end.inferred and names.leaf(end.name) in _TF for end in interface.endpoints)


def _may_activate_itself_later(interface: Interface) -> bool:
    """Whether a run showed a lifecycle node that did not activate itself: a callback may do so that the run did not
    wait for."""
    managed = any(end.type == CHANGE_STATE and end.role == "service" for end in interface.endpoints)
    return managed and interface.source == "trace" and "activate" not in interface.transitions


def _with_later(node: LaunchNode, interface: Interface, found: Interface | SourceInterface) -> Interface:
    """With what the node is given and only its source declares."""
    seen = {use.name.removeprefix("~") for use in interface.params}
    given = {param.name for param in node.params} - seen
    uses = (replace(use, inferred=True) for use in found.params if use.name.removeprefix("~") in given)
    return replace(interface, params=(*interface.params, *uses))


def _with_places(interface: Interface, found: Interface | SourceInterface) -> Interface:
    """With the places in the source where what was seen is made. Parameters of a client library that does not tell them
    (its node "lists" them) are those of the source."""
    places = {(e.role, e.name): (e.source_file, e.source_line) for e in found.endpoints}
    declared = {use.name: use for use in found.params}
    endpoints = []
    for end in interface.endpoints:
        file, line = places.get((end.role, end.name), (None, None))
        endpoints.append(replace(end, source_file=file, source_line=line))
    params = []
    for use in interface.params:
        said = declared.get(use.name)
        params.append(use if said is None else _described(use, said))
    if any(use.access == "list" for use in interface.params):
        seen = {use.name for use in interface.params}
        params += [replace(use, inferred=True) for use in declared.values() if use.name not in seen]
    return replace(interface, endpoints=tuple(endpoints), params=tuple(params))


def _described(use: ParamUse, said: ParamUse) -> ParamUse:
    """A parameter that was seen, with what the source says of it beyond that."""
    default = use if use.has_default else said
    return replace(
        said,
        default=default.default,
        has_default=default.has_default,
        type=said.type or use.type,
        builtin=use.builtin,
        inferred=False,
    )


def _with_more(node: LaunchNode, interface: Interface, found: Interface | SourceInterface) -> Interface:
    """The interface itself where it came to its event loop and the rest adds nothing, as a kept trace of the same."""
    if isinstance(found, Interface):
        more = interface.with_more(node.name, "similar", found.endpoints, found.params, frames=found.frames)
        return replace(more, elsewhere=found.elsewhere) if _is_more(more, interface) else interface
    endpoints = tuple(replace(endpoint, inferred=True) for endpoint in found.endpoints)
    interface, endpoints = replace(interface, endpoints=_beside(found, interface.endpoints)), _beside(found, endpoints)
    params = tuple(replace(use, inferred=True) for use in found.params)
    whole = interface.with_more(node.name, "source", endpoints, params, found.nodes, found.frames, found.frame_uses)
    if not _is_more(whole, interface):
        return interface
    whole = replace(
        whole,
        whole=KINDS if found.whole else (),
        unnamed_calls=tuple(type_ or "*" for role, type_ in found.unnamed if role == "client"),
        transitions=whole.transitions or found.transitions,
    )
    if node.resolved.path is not None or node.resolved.not_executable or node.unknowns:
        return whole
    # There is no executable, but what it is to be made of.
    return replace(whole, outcome=replace(whole.outcome, reason="it is not built yet"))


def _beside(found: SourceInterface, endpoints: tuple[Endpoint, ...]) -> tuple[Endpoint, ...]:
    """The ends, each with whether others of its role and type have names that are not known."""
    unnamed = {*found.unnamed}
    return tuple(
        replace(each, beside_unnamed=True)
        if not unnamed.isdisjoint(((each.role, each.type), (each.role, None), (each.role, "*")))
        else each
        for each in endpoints
    )


def _is_more(whole: Interface, interface: Interface) -> bool:
    return not interface.likely_complete or _content(whole) != _content(interface)


def _content(interface: Interface) -> tuple[object, ...]:
    return interface.endpoints, interface.params, interface.frames, interface.frame_uses
