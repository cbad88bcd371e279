"""What to take a node's interface from where its run did not tell it to the end."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import dataclass, replace

from preflight_analysis.evaluation.tree import CommandValue, LaunchNode, LaunchTree
from preflight_analysis.graph.annotations import read_annotation
from preflight_analysis.incremental.kept import Kept
from preflight_analysis.source.analyse import SourceAnalysis, SourceInterface
from preflight_analysis.source.known_params import LaunchParams
from preflight_analysis.tracing.interface import Interface, ParamUse
from preflight_analysis.tracing.similar import SimilarTraces

_MAX_REMEMBERED = 4096


@dataclass(frozen=True, slots=True)
class _Filled:
    """What was added to a node's interface, and what came of it."""

    interface: Interface
    found: Interface | SourceInterface
    whole: Interface


class Fallback:
    """Adds to interfaces what is known from elsewhere. Asked at each keystroke: what did not change is not made anew.
    Thread-safe."""

    def __init__(self, sources: SourceAnalysis, similar: SimilarTraces | None = None) -> None:
        self._sources = sources
        self._similar = similar
        self._lock = threading.Lock()
        self._filled: dict[tuple[str, str | None], _Filled] = {}

    def fill_in(self, tree: LaunchTree, interfaces: Sequence[Interface], kept: Kept) -> tuple[Interface, ...]:
        """The interfaces of the nodes of `tree`, in order; to what a run did not tell to its end is added what a run of
        the same executable elsewhere told, or else its source.

        A node with an annotation is left alone: that is added with the graph, and is the user's word for all of it.
        """
        annotated = kept.each(_is_annotated, tree.nodes)
        lacking = [not has and _lacks(each) for has, each in zip(annotated, interfaces, strict=True)]
        nodes = tuple(zip(lacking, tree.nodes, interfaces, strict=True))
        placeless = [not lacks and _placeless(tree, each) for lacks, _, each in nodes]
        later = [not lacks and _may_declare_later(tree, node, each) for lacks, node, each in nodes]
        if not any((*lacking, *placeless, *later)):
            return tuple(interfaces)
        values = {p.name: p.value for p in tree.params.values() if not isinstance(p.value, CommandValue)}
        values |= {f"{node.name}/{param.name}": param.value for node in tree.nodes for param in node.params}
        params = LaunchParams(values)
        similar = self._similar.looking(values, tree.generation) if self._similar is not None else None
        digests: dict[str, str] = {}
        whole = list(interfaces)
        for at, node in enumerate(tree.nodes):
            if lacking[at] or placeless[at] or later[at]:
                found: Interface | SourceInterface | None = (
                    similar(node) if similar is not None and lacking[at] else None
                )
                found = found or self._sources.read(node, params, digests)
                if found is not None:
                    key = node.name, node.resolved.path
                    known = self._filled.get(key)
                    if known is None or known.found is not found or known.interface != interfaces[at]:
                        if lacking[at]:
                            more = _with_more(node, interfaces[at], found)
                        else:
                            more = _with_places(interfaces[at], found) if placeless[at] else interfaces[at]
                            more = _with_later(node, more, found) if later[at] else more
                        known = _Filled(interfaces[at], found, more)
                        self._remember(key, known)
                    whole[at] = known.whole
        return tuple(whole)

    def _remember(self, key: tuple[str, str | None], filled: _Filled) -> None:
        with self._lock:
            self._filled.pop(key, None)
            self._filled[key] = filled
            if len(self._filled) > _MAX_REMEMBERED:
                del self._filled[next(iter(self._filled))]


def _is_annotated(node: LaunchNode) -> bool:
    return read_annotation(node.action)[0] is not None


def _lacks(interface: Interface) -> bool:
    outcome = interface.outcome
    ended_well = outcome.status == "exited" and outcome.exit_code == 0
    return not (interface.complete or ended_well or interface.pending)


def _placeless(tree: LaunchTree, interface: Interface) -> bool:
    """Whether all is known of what a node does, but nothing of where in its source: rcl is not told that."""
    seen = interface.endpoints + interface.params
    has_places = any(each.source_file is not None for each in seen)
    return not tree.ros.traces_have_places and interface.source == "trace" and bool(seen) and not has_places


def _may_declare_later(tree: LaunchTree, node: LaunchNode, interface: Interface) -> bool:
    """Whether a node of ROS 2 is given a parameter that its run did not declare: a callback may do so that the run did
    not wait for, of a timer for instance."""
    declared = {use.name.removeprefix("~") for use in interface.params}
    declares = tree.ros.own_parameters and interface.source == "trace" and bool(declared)
    return declares and any(param.name not in declared for param in node.params)


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
        more = interface.with_more("similar", found.endpoints, found.params)
        return replace(more, elsewhere=found.elsewhere) if _is_more(more, interface) else interface
    endpoints = tuple(replace(endpoint, inferred=True) for endpoint in found.endpoints)
    params = tuple(replace(use, inferred=True) for use in found.params)
    whole = interface.with_more("source", endpoints, params, found.nodes)
    if not _is_more(whole, interface):
        return interface
    if node.resolved.path is not None or node.resolved.not_executable or node.unknowns:
        return whole
    # There is no executable, but what it is to be made of.
    return replace(whole, outcome=replace(whole.outcome, reason="it is not built yet"))


def _is_more(whole: Interface, interface: Interface) -> bool:
    return not interface.likely_complete or (whole.endpoints, whole.params) != (interface.endpoints, interface.params)
