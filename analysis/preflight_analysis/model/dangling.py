"""Ends of topics, services and actions that nobody is at the other end of."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from itertools import chain, islice

from preflight_analysis.graph.model import Channel, ChannelKind, Connection, is_below_one
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.channels import channels_of, of_all_kinds
from preflight_analysis.model.context import Context
from preflight_analysis.model.well_known import IMAGE_TRANSPORTS, may_dangle
from preflight_analysis.tracing.interface import KIND_OF

GENERIC_PACKAGES = ("std_msgs/", "std_srvs/")
"""Types that say nothing of what is carried: that two ends have the same one is no evidence."""


def dangling_consumers(context: Context, kind: ChannelKind) -> tuple[Connection, ...]:
    """Subscribers or clients without any other end, but for those that may well be served from outside."""
    return all_dangling_consumers(context)[kind]


@derived
def all_dangling_consumers(context: Context) -> Mapping[ChannelKind, tuple[Connection, ...]]:
    """Those of each kind."""
    lone = of_all_kinds(context, _lone_consumers, channels_of(context), _unknown(context))
    return {kind: tuple(chain.from_iterable(ends)) for kind, ends in lone.items()}


@derived
def dangling_providers(context: Context, kind: ChannelKind) -> tuple[Connection, ...]:
    """Publishers or servers without any other end, but for those that may well be used from outside."""
    lone = _all_lone_providers(context)[kind]
    others = read_otherwise(context) if kind == "topics" else frozenset[str]()
    if others and context.graph is not None:
        lone = tuple(() if name in others else each for name, each in zip(context.graph.topics, lone, strict=True))
    return tuple(chain.from_iterable(lone))


def _unknown(context: Context) -> Mapping[ChannelKind, Collection[str]]:
    """The nodes of which nothing is known of a kind: they are at the other end of what is below their names."""
    return context.graph.unknown if context.graph is not None else {}


@derived
def _all_lone_providers(context: Context) -> Mapping[ChannelKind, Sequence[tuple[Connection, ...]]]:
    """The ends of each channel of a kind, in the order of the graph."""
    return of_all_kinds(context, _lone_providers, channels_of(context), _unknown(context))


def _lone_consumers(channel: Channel, unknown: Mapping[ChannelKind, Collection[str]]) -> tuple[Connection, ...]:
    if channel.providers or channel.external or channel.provided_apart:
        return ()  # that its providers are in another domain is said by itself
    return _dangling(channel, channel.consumers, unknown)


def _lone_providers(channel: Channel, unknown: Mapping[ChannelKind, Collection[str]]) -> tuple[Connection, ...]:
    if channel.consumers or channel.external or channel.consumed_apart:
        return ()
    return _dangling(channel, channel.providers, unknown)


def _dangling(
    channel: Channel, ends: Sequence[Connection], unknown: Mapping[ChannelKind, Collection[str]]
) -> tuple[Connection, ...]:
    found = tuple(c for c in ends if c.action is None and not may_dangle(channel.name, c.endpoint))
    is_theirs = found and is_below_one(channel.name, unknown[KIND_OF[found[0].endpoint.role]])
    return () if is_theirs else found


@derived
def read_otherwise(context: Context) -> frozenset[str]:
    """The topics of images that are read in another transport of the same publisher."""
    topics = context.graph.topics.items() if context.graph is not None else ()
    return frozenset(
        name.rpartition("/")[0]
        for name, each in topics
        if name.endswith(IMAGE_TRANSPORTS) and each.consumers and each.providers
    )


def by_type(
    context: Context, kind: ChannelKind, connections: Iterable[Connection]
) -> Mapping[str | None, tuple[Connection, ...]]:
    """The ends, all of a kind that dangle, by their types."""
    return context.grouped(_type, kind, connections)


def _type(connection: Connection) -> str | None:
    return connection.endpoint.type


def lone_of_type(consumer: Connection, dangling: Iterable[Connection]) -> Connection | None:
    """The only one of the dangling providers of the consumer's type, if there is exactly one and that is specific."""
    type_ = consumer.endpoint.type
    if type_ is None or type_ == "*" or type_.startswith(GENERIC_PACKAGES):
        return None
    found = list(islice((c for c in dangling if c.node is not consumer.node), 2))
    return found[0] if len(found) == 1 else None
