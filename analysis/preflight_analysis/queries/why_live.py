"""The chain of `why` beside the running system: what of it is there."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from preflight_analysis.graph.model import ChannelKind
from preflight_analysis.live.model import LiveEndpoint, Observation
from preflight_analysis.model.fit import in_short
from preflight_analysis.model.nearest import nearest
from preflight_analysis.queries.why import Chain, Link, listed, qos_links
from preflight_analysis.tracing.interface import DOES, Endpoint, Role

_ROLES: Mapping[ChannelKind, tuple[Role, Role]] = {
    "topics": ("publisher", "subscriber"),
    "services": ("service", "client"),
    "actions": ("action_server", "action_client"),
}
"""Who provides and who consumes."""
_UNSEEN: Mapping[int, frozenset[Role]] = {1: frozenset({"client", "action_server", "action_client"}), 2: frozenset()}
"""A master does not know who calls a service, and has the topics of actions alone."""


def live_links(chain: Chain, seen: Observation) -> tuple[Link, ...]:
    """What the running system has of each link, from the provider to the consumer."""
    return tuple(_links(chain, seen))


def _links(chain: Chain, seen: Observation) -> Iterator[Link]:
    ends: list[LiveEndpoint] = []
    provides, consumes = _ROLES[chain.kind]
    for node, channel, role in ((chain.provider, chain.provided, provides), (chain.consumer, chain.consumed, consumes)):
        running = _running(node, seen)
        yield running
        if running.state == "broken" or channel is None:
            continue
        if role in _UNSEEN[seen.generation]:
            yield Link("endpoint", "unknown", f"a ROS master does not know whether {node} {DOES[role]} '{channel}'")
            continue
        own = {end.name: end for end in seen.endpoints if end.node == node and end.role == role}
        if (end := own.get(channel)) is not None:
            yield Link("endpoint", "ok", f"{node} {DOES[role]} '{channel}'")
            ends.append(end)
        else:
            yield Link("endpoint", "broken", _missing(node, channel, role, sorted(own)))
    if len(ends) == len((provides, consumes)):
        yield from _compared(chain, *ends)


def _running(node: str, seen: Observation) -> Link:
    found = seen.nodes.get(node)
    if found is None:
        near = nearest(node, seen.nodes)
        return Link("started", "broken", f"{node} does not run" + (f"; did you mean {near}?" if near else ""))
    if found.dead is not None:
        return Link("started", "broken", f"{node} is registered and does not answer: {found.dead}")
    if found.inactive is not None:
        return Link("lifecycle", "broken", f"{node} runs and is {found.inactive}: activate it")
    return Link("started", "ok", f"{node} runs")


def _missing(node: str, channel: str, role: Role, own: list[str]) -> str:
    near = nearest(channel, own)
    text = f"{node} runs and has no {role.replace('_', ' ')} '{channel}'"
    if near is not None:
        return f"{text}; it {DOES[role]} '{near}'"
    return f"{text}; it {DOES[role]} {listed(own)}" if own else text


def _compared(chain: Chain, provider: LiveEndpoint, consumer: LiveEndpoint) -> Iterator[Link]:
    """Names, and types and QoS as far as the system shows them."""
    if provider.name != consumer.name:
        text = f"'{provider.name}' and '{consumer.name}' are different {chain.noun} names"
        yield Link("name", "broken", text)
        return
    yield Link("name", "ok", f"both use the {chain.noun} '{consumer.name}'")
    if provider.type is not None and consumer.type is not None:
        if "*" in (provider.type, consumer.type) or in_short(provider.type) == in_short(consumer.type):
            yield Link("type", "ok", f"both use the type {consumer.type}")
        else:
            text = f"types differ: {chain.provider} uses {provider.type}, {chain.consumer} uses {consumer.type}"
            yield Link("type", "broken", text)
    if provider.qos and consumer.qos:
        offered, requested = (Endpoint(end.role, end.name, end.type, qos=end.qos) for end in (provider, consumer))
        yield from qos_links(offered, requested, chain.provider, chain.consumer)
