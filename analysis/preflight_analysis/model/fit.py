"""What keeps ends of one name from exchanging messages: their types, their QoS, the domains of their nodes."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from preflight_analysis.graph.domains import Difference, differences
from preflight_analysis.graph.model import PROVIDERS, Channel, Connection, Graph
from preflight_analysis.graph.qos import Policy, incompatible

_NO_TYPE = "an unknown type"
_SAME = {"tf/tfMessage": "tf2_msgs/TFMessage"}
"""Types of two packages with one definition, and so with one sum."""


class TypeMisfit(NamedTuple):
    """Two ends whose types do not fit. `difference` is what there is to add to the names of the types; empty where
    these tell it all."""

    consumer: Connection
    provider: Connection
    difference: str

    @property
    def types(self) -> tuple[str, str]:
        """That of the provider, then that of the consumer, in words."""
        return self.provider.endpoint.type or _NO_TYPE, self.consumer.endpoint.type or _NO_TYPE

    @property
    def reason(self) -> str:
        """What is so, for a user."""
        provided, consumed = self.types
        nodes = self.provider.node.name, self.consumer.node.name
        return f"types differ: {nodes[0]} uses {provided}, {nodes[1]} uses {consumed}{self.difference}"


def type_misfit(consumer: Connection, provider: Connection) -> TypeMisfit | None:
    """That of two ends of one name; None where they fit, and where that is not known."""
    mine, theirs = consumer.endpoint, provider.endpoint
    if "*" in (mine.type, theirs.type, mine.md5, theirs.md5):
        return None
    sums_differ = bool(mine.md5 and theirs.md5) and mine.md5 != theirs.md5
    difference: str | None = None
    if mine.type is None or theirs.type is None:
        # A roscpp client of a service knows no type, but what it sends is known by the sum.
        difference = f" (MD5 sums {theirs.md5} and {mine.md5})" if sums_differ else None
    elif in_short(mine.type) != in_short(theirs.type):
        # Of a service only the sums are compared when it is called.
        difference = None if mine.role == "client" and mine.md5 and mine.md5 == theirs.md5 else ""
    elif sums_differ:
        difference = f" (different definitions, MD5 sums {theirs.md5} and {mine.md5})"
    return TypeMisfit(consumer, provider, difference) if difference is not None else None


def type_misfits(channel: Channel) -> tuple[TypeMisfit, ...]:
    """For each consumer of a channel the types that do not fit it, each with its first provider."""
    # Of those that are alike the first one is told; a topic that all nodes share has many.
    providers: dict[tuple[str | None, str | None, bool], Connection] = {}
    for connection in channel.providers:
        providers.setdefault((connection.endpoint.type, connection.endpoint.md5, connection.action is None), connection)
    found: list[TypeMisfit] = []
    for consumer in channel.consumers:
        reported: set[tuple[str | None, str]] = set()
        for provider in providers.values():
            if consumer.action is not None and provider.action is not None:
                continue  # said once of the action, not of each of its topics
            known = consumer.endpoint.evidence, provider.endpoint.evidence
            if consumer.node is provider.node and all(each.of_catalogue for each in known):
                continue  # within a node of others, as move_base's footprints
            misfit = type_misfit(consumer, provider)
            if misfit is not None and (provider.endpoint.type, misfit.difference) not in reported:
                reported.add((provider.endpoint.type, misfit.difference))
                found.append(misfit)
    return tuple(found)


class DoubleType(NamedTuple):
    """Ends of the same kind that one node has under one name with two types, which its client library refuses."""

    first: Connection
    second: Connection

    @property
    def does(self) -> str:
        """What the node does there, in words."""
        return "publishes" if self.first.endpoint.role == "publisher" else "subscribes to"

    @property
    def types(self) -> str:
        """Both of them, in words."""
        return f"both {self.first.endpoint.type} and {self.second.endpoint.type}"

    @property
    def reason(self) -> str:
        """What is so, for a user."""
        return f"{self.first.node.name} {self.does} {self.types}"


def double_types(channel: Channel) -> tuple[DoubleType, ...]:
    """Those of a topic."""
    found: list[DoubleType] = []
    for ends in (channel.providers, channel.consumers):
        first: dict[int, Connection] = {}
        for end in ends:
            if end.endpoint.type in (None, "*") or end.endpoint.evidence.of_catalogue or end.action is not None:
                continue
            other = first.setdefault(id(end.node), end)
            if in_short(other.endpoint.type or "") != in_short(end.endpoint.type or ""):
                found.append(DoubleType(other, end))
    return tuple(found)


def in_short(name: str) -> str:
    """A type's name without the folder that ROS 2 has in it: a launch file of a package for both generations may be
    answered by nodes of either."""
    package, _, rest = name.partition("/")
    short = f"{package}/{rest.rpartition('/')[2]}"
    return _SAME.get(short, short)


class QosMisfit(NamedTuple):
    """A publisher and a subscription that a policy keeps from connecting (ROS 2)."""

    provider: Connection
    consumer: Connection
    policy: Policy

    @property
    def sides(self) -> tuple[str, str]:
        """What the publisher offers, and what the subscription requests, in words."""
        policy, name = self.policy, self.policy.name.replace("_", " ")
        if isinstance(policy.requested, str):
            kind = "" if policy.name == "reliability" else f" {name}"
            offered, requested = (str(each).replace("_", " ") for each in (policy.offered, policy.requested))
            return f"{offered}{kind}", f"{requested}{kind}"
        return f"no {name}" if policy.offered is None else f"{name} {policy.offered} s", f"{name} {policy.requested} s"

    @property
    def reason(self) -> str:
        """What is so, for a user."""
        offered, requested = self.sides
        return (
            f"incompatible QoS: {self.provider.node.name} publishes {offered}, "
            f"{self.consumer.node.name} requests {requested}"
        )


def qos_misfits(channel: Channel) -> tuple[QosMisfit, ...]:
    """Those of a topic."""
    # A topic that all nodes share has as many pairs as nodes squared, and few settings.
    alike: dict[str, list[Connection]] = {}
    for provider in channel.providers if channel.consumers else ():
        alike.setdefault(_settings(provider), []).append(provider)
    problems: dict[tuple[str, str], Policy | None] = {}
    found: list[QosMisfit] = []
    for consumer in channel.consumers if channel.providers else ():
        asked = _settings(consumer)
        for offered, providers in alike.items():
            pair = offered, asked
            if pair not in problems:
                problems[pair] = incompatible(providers[0].endpoint, consumer.endpoint)
            policy = problems[pair]
            if policy is not None:
                found += (QosMisfit(provider, consumer, policy) for provider in providers)
    return tuple(found)


def _settings(connection: Connection) -> str:
    return repr(sorted(connection.endpoint.qos.items()))


class Separation(NamedTuple):
    """A consumer that can reach no provider of its name, or none by what anybody promises: the first of them, and what
    keeps the two apart."""

    consumer: Connection
    provider: Connection
    difference: Difference

    @property
    def reason(self) -> str:
        """What is so, for a user."""
        variable, one, other = self.difference[:3]
        return f"{variable} differs: {self.provider.node.name} has {one}, {self.consumer.node.name} has {other}"


def separations(graph: Graph, channel: Channel) -> Iterator[Separation]:
    """Those of a channel; none where a bridge of domains may carry its name."""
    domains = graph.domains
    if not domains.by_node or domains.bridged is None or channel.name in domains.bridged:
        return
    providers = [*channel.providers, *(each for each in channel.apart if each.endpoint.role in PROVIDERS)]
    if channel.external or not providers or not graph.tree.complete:
        return
    for consumer in channel.consumers:
        mine = domains.by_node[id(consumer.node)]
        if mine is None or consumer.action is not None or consumer.endpoint.builtin:
            continue
        kept_apart = []
        for provider in providers:
            theirs = domains.by_node[id(provider.node)]
            between = [*differences(theirs, mine)] if theirs is not None else []
            sure = [each for each in between if each.separates]
            kept_apart.append(next(iter(sure or [each for each in between if each.unsupported]), None))
        first = kept_apart[0]
        if first is not None and None not in kept_apart:
            yield Separation(consumer, providers[0], first)
