"""What rules say of single topics, services and actions, asked of all of them at once."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from itertools import chain, islice
from typing import Concatenate, Literal, ParamSpec, TypeVar

from preflight_analysis.findings.doubt import Doubt, Reason, doubts
from preflight_analysis.graph.model import Channel, ChannelKind, Connection, Graph
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import enumerated

P = ParamSpec("P")
T = TypeVar("T")
V = TypeVar("V")

_KINDS: tuple[ChannelKind, ...] = ("topics", "services", "actions")


OF_ENDS = (Reason.FROM_SOURCE, Reason.NOT_ANALYSED, Reason.DEPENDS, Reason.ASSUMED)
"""What `doubts_of_ends` may say."""
_SOME = 3


def doubts_of_ends(
    *ends: Connection, assumed: Literal["ASSUMED", "DEPENDS", ""] = "ASSUMED", lacks: str | bool = False
) -> tuple[Doubt, ...]:
    """Why nodes may not have these ends: each reason with the first of the nodes that it holds for. `assumed`: what is
    said of ends that no run and no plain line of a source shows. `lacks`: see `not_all_known`."""
    found: dict[str, str | bool] = {}
    for end in ends:
        known, node = end.endpoint.evidence, end.node.name
        reasons = {
            "FROM_SOURCE": known.inferred or end.endpoint.displayed or "stand-in" in known.doubts,
            "CATALOGUE": known.of_catalogue,
            "NOT_ANALYSED": "made-up answer" in known.doubts,
            "DEPENDS": "on demand" in known.doubts or (known.assumed and assumed == "DEPENDS"),
            "ASSUMED": known.assumed and assumed == "ASSUMED",
        }
        for reason, holds in reasons.items():
            if holds:
                found.setdefault(reason, node)
    return doubts(**{**found, **({"NOT_ANALYSED": lacks} if lacks else {})})


def not_all_known(graph: Graph) -> str | bool:
    """The first nodes that were not analysed as a whole, for a doubt; whether anything else is not known."""
    return enumerated(graph.incomplete[:_SOME]) or not graph.complete


def channels_of(context: Context) -> Mapping[ChannelKind, Collection[Channel]]:
    """Those of each kind."""
    graph = context.graph
    return {kind: graph.channels(kind).values() if graph is not None else () for kind in _KINDS}


def of_all_kinds(
    context: Context,
    function: Callable[Concatenate[T, P], V],
    items: Mapping[ChannelKind, Collection[T]],
    *shared: P.args,
    **none: P.kwargs,
) -> Mapping[ChannelKind, tuple[V, ...]]:
    """`Kept.each` for the items of all kinds, in their order."""
    found = iter(context.each(function, chain.from_iterable(items.values()), *shared, **none))
    return {kind: tuple(islice(found, len(some))) for kind, some in items.items()}
