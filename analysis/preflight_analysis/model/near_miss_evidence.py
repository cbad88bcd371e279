"""How well a consumer fits a channel: what speaks for one of its providers being meant."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.graph.model import Channel, Connection
from preflight_analysis.model.dangling import GENERIC_PACKAGES
from preflight_analysis.model.near_miss import EVIDENCE, Evidence, NearMiss, extra_level, given_name
from preflight_analysis.model.nearest import likeness

Rank = tuple[bool, bool, int, int, str, int]
"""Of a provider that fits, the lowest is the best: whether it takes more than a typo, whether somebody listens, the
place in `EVIDENCE`, the distance of the names, the channel, and which of its providers."""


def best_rank(consumer: Connection, channel: Channel, own: LaunchNode | None) -> Rank | None:
    """How well the channel fits the consumer, None if not at all.

    But for `own`, whose ends are not looked at, it depends on no node, only on the namespaces of nodes.
    """
    ranks = []
    for number, kind, distance in _fitting(consumer, channel, own):
        how = EVIDENCE.index(kind)
        ranks.append((how > 0, not dangles(channel), how, distance, channel.name, number))
    return min(ranks, default=None)


def near_miss(consumer: Connection, channel: Channel, rank: Rank) -> NearMiss:
    """What a rank in that channel says."""
    provider = channel.providers[rank[-1]]
    known = known_type(consumer) is not None and known_type(provider) is not None
    return NearMiss(consumer, provider, EVIDENCE[rank[2]], known, dangles(channel))


def dangles(channel: Channel) -> bool:
    """Whether nobody listens to what is offered."""
    return not channel.consumers and not channel.external


def known_type(connection: Connection) -> str | None:
    """The type, if one is known."""
    return None if connection.endpoint.type == "*" else connection.endpoint.type


def _fitting(consumer: Connection, channel: Channel, own: LaunchNode | None) -> Iterator[tuple[int, Evidence, int]]:
    """Which of the providers of the channel the consumer may have been meant for, how they are alike and how far they
    are apart."""
    # Most pairs have names that are not alike, and channels may have hundreds of ends: names are compared first.
    lone, mine = dangles(channel), known_type(consumer)
    below = mine is not None and lone and consumer.name.endswith(names.leaf(channel.name))
    alike = likeness(consumer.name, channel.name)
    one_sided = mine is not None and lone and _is_one_sided(consumer, channel)
    if alike is None and not below and not one_sided:
        return
    for connection in channel.consumers:
        if connection.node is own:
            return  # it knows that name
    is_enough = alike is not None and (alike[0] == "typo" or _says_enough(consumer.name, channel.name, mine or ""))
    short_name, long_name = sorted((consumer.name, channel.name), key=len)
    how_far = len(long_name) - len(short_name)
    may_be_slash = below and long_name.endswith(short_name)
    has_level = below and extra_level(short_name, long_name) is not None
    if not (may_be_slash or has_level or is_enough or one_sided):
        return
    for number, provider in enumerate(channel.providers):
        if provider.endpoint.builtin or provider.node is own:
            # What a node takes in and what it gives out have like names on purpose (`points`, `points_filtered`).
            continue
        theirs = known_type(provider)
        known = mine is not None and theirs is not None
        if (known and mine != theirs) or not (known or lone):
            continue
        if known and one_sided and not (alike is not None and alike[0] == "typo"):
            yield number, "remap", 0
            continue
        if known and may_be_slash:
            short, long = (consumer, provider) if len(consumer.name) <= len(provider.name) else (provider, consumer)
            if _is_slash(short, long):
                yield number, "slash", how_far
                continue
        if known and has_level:
            yield number, "level", how_far
            continue
        if alike is not None and is_enough and (alike[0] == "typo" or (known and lone)):
            yield number, *alike


def _is_one_sided(consumer: Connection, channel: Channel) -> bool:
    """Whether a remap at one side alone moved its end, from the name that the other side has."""
    if consumer.remap is not None:
        wanted = given_name(consumer)
        return wanted == channel.name and all(each.remap is None for each in channel.providers)
    return all(each.remap is not None and given_name(each) == consumer.name for each in channel.providers)


def _is_slash(short: Connection, long: Connection) -> bool:
    """Whether the shorter name is the longer one's but for a leading slash where the launch file or the node gave it
    and a namespace in which the node with the longer name lives."""
    home = names.parent(short.node.name)
    given = short.endpoint.name
    absolute = given.startswith("/") if short.remap is None else home != "/" and not short.name.startswith(home)
    relative = long.remap is None and not long.endpoint.name.startswith(("/", "~"))
    namespace = names.parent(long.node.name)
    return absolute and relative and namespace != "/" and long.name == namespace.rstrip("/") + short.name


def _says_enough(name: str, other: str, type_: str) -> bool:
    """Whether like words suffice: for a generic type only if the whole shorter name ends the longer one."""
    return not type_.startswith(GENERIC_PACKAGES) or is_end_of(name, other)


def is_end_of(name: str, other: str) -> bool:
    """Whether one of two names, of several parts, ends the other one."""
    short, long = sorted((name, other), key=len)
    return short.count("/") >= 2 and long.endswith(short)
