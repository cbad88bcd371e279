"""What rules say of single topics, services and actions, asked of all of them at once."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from itertools import chain, islice
from typing import Concatenate, ParamSpec, TypeVar

from preflight_analysis.graph.model import Channel, ChannelKind
from preflight_analysis.rules.rule import Context

P = ParamSpec("P")
T = TypeVar("T")
V = TypeVar("V")

_KINDS: tuple[ChannelKind, ...] = ("topics", "services", "actions")


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
    found = iter(context.kept.each(function, chain.from_iterable(items.values()), *shared, **none))
    return {kind: tuple(islice(found, len(some))) for kind, some in items.items()}
