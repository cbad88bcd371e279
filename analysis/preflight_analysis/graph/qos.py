"""Whether the QoS of a publisher meets what a subscription requests (ROS 2).

Source: the compatibility tables of "About Quality of Service settings", ROS 2 documentation
(https://docs.ros.org/en/rolling/Concepts/Intermediate/About-Quality-of-Service-Settings.html).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal, NamedTuple

from preflight_analysis.tracing.interface import Endpoint

ORDERS = {
    "reliability": ("best_effort", "reliable"),
    "durability": ("volatile", "transient_local"),
    "liveliness": ("automatic", "manual_by_topic"),
}
"""Weaker first: what is offered has to be as strong as what is requested."""
PERIODS = ("deadline", "lease_duration")
"""In seconds: what is offered has to be as short as what is requested."""

_MAIN = {"reliability", "durability"}

Fit = Literal["compatible", "incompatible", "unknown"]


class Policy(NamedTuple):
    """One policy of a pair: what the publisher offers, what the subscription requests; None where it is not known, or
    where there is no period."""

    name: str
    offered: str | float | None
    requested: str | float | None
    fit: Fit


def policies(publisher: Endpoint, subscription: Endpoint) -> Iterator[Policy]:
    """Each policy that decides whether the two connect, as far as one of the two is known to set it."""
    # Of an endpoint whose settings are known, those that are not among them are the weakest.
    known = publisher.qos.keys() >= _MAIN
    requests_known = subscription.qos.keys() >= _MAIN
    for name, order in ORDERS.items():
        if name not in publisher.qos and name not in subscription.qos:
            continue
        offered = publisher.qos.get(name, order[0] if known else None)
        requested = subscription.qos.get(name, order[0] if requests_known else None)
        if offered in order and requested in order:
            weaker = order.index(offered) < order.index(requested)
            yield Policy(name, offered, requested, "incompatible" if weaker else "compatible")
        else:
            yield Policy(name, offered, requested, "unknown")
    for name in PERIODS:
        offered, requested = publisher.qos.get(name), subscription.qos.get(name)
        if not isinstance(requested, (int, float)):
            continue
        if isinstance(offered, (int, float)):
            yield Policy(name, offered, requested, "incompatible" if offered > requested else "compatible")
        else:
            yield Policy(name, None, requested, "incompatible" if offered is None and known else "unknown")


def incompatible(publisher: Endpoint, subscription: Endpoint) -> Policy | None:
    """The first policy that keeps the two from connecting, if any."""
    return next((each for each in policies(publisher, subscription) if each.fit == "incompatible"), None)
