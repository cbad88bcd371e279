"""What to take a node's interface from where its run did not tell it to the end."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from preflight_analysis.evaluation.tree import CommandValue, LaunchNode, LaunchTree
from preflight_analysis.graph.annotations import read_annotation
from preflight_analysis.source.analyse import SourceAnalysis
from preflight_analysis.source.known_params import LaunchParams
from preflight_analysis.tracing.interface import Interface
from preflight_analysis.tracing.similar import SimilarTraces


def fill_in(
    tree: LaunchTree,
    interfaces: Sequence[Interface],
    sources: SourceAnalysis,
    similar: SimilarTraces | None = None,
    most: int | None = None,
) -> tuple[Interface, ...]:
    """The interfaces of the nodes of `tree`, in order; to what a run did not tell to its end is added what a run of the
    same executable elsewhere told, or else its source.

    A node with an annotation is left alone: that is added with the graph, and is the user's word for all of it. Where
    more than `most` nodes lack something nothing is added.
    """
    lacking = sum(_lacks(node, interface) for node, interface in zip(tree.nodes, interfaces, strict=True))
    if not lacking or (most is not None and lacking > most):
        return tuple(interfaces)
    values = {p.name: p.value for p in tree.params.values() if not isinstance(p.value, CommandValue)}
    params = LaunchParams(values)
    return tuple(
        (
            (_from_similar(node, interface, values, similar) if similar is not None else None)
            or _from_source(node, interface, params, sources)
        )
        if _lacks(node, interface)
        else interface
        for node, interface in zip(tree.nodes, interfaces, strict=True)
    )


def _lacks(node: LaunchNode, interface: Interface) -> bool:
    outcome = interface.outcome
    ended_well = outcome.status == "exited" and outcome.exit_code == 0
    return not (interface.complete or ended_well or interface.pending) and read_annotation(node.action)[0] is None


def _from_similar(
    node: LaunchNode, interface: Interface, params: Mapping[str, Any], similar: SimilarTraces
) -> Interface | None:
    found = similar.of(node, params)
    if found is None:
        return None
    more = interface.with_more("similar", found.endpoints, found.params)
    return replace(more, elsewhere=found.elsewhere)


def _from_source(node: LaunchNode, interface: Interface, params: LaunchParams, sources: SourceAnalysis) -> Interface:
    found = sources.read(node, params)
    if found is None:
        return interface
    endpoints = tuple(replace(endpoint, inferred=True) for endpoint in found.endpoints)
    params_used = tuple(replace(use, inferred=True) for use in found.params)
    return interface.with_more("source", endpoints, params_used)
