"""Names of a running system. Whoever is in its network makes them up: neither a terminal, an editor nor our time may
be at their mercy.

rmw allows no name that is longer than 255 characters, nor others than letters, digits, `_` and `/`
(`rmw/validate_full_topic_name.h`), but DDS and the master of ROS 1 do.
"""

from __future__ import annotations

import re
from collections.abc import Sized
from functools import lru_cache

from preflight_analysis.live.model import CannotObserveError, LiveEndpoint, LiveNode, Observation

LONGEST = 300
"""Characters of a name."""
MOST_NODES = 10_000
MOST_ENDPOINTS = 50_000
"""Of a robot with 1,000 nodes of ROS 2 there are some 15,000."""
_NOT_SHOWN = re.compile("[\x00-\x1f\x7f-\x9f\u061c\u200b-\u200f\u2028-\u202e\u2060-\u2069\ud800-\udfff\ufeff]")
"""Control characters, of a terminal's too, those that change the direction of text or are nowhere to be seen, and
what UTF-8 cannot say."""


@lru_cache(maxsize=16384)
def shown(name: str) -> str:
    """A name as it can be shown: what cannot be seen as U+FFFD, and clipped."""
    name = _NOT_SHOWN.sub("\N{REPLACEMENT CHARACTER}", name)
    return name if len(name) <= LONGEST else name[: LONGEST - 1] + "…"


def check_number(place: str, nodes: Sized, endpoints: Sized) -> None:
    """Raises `CannotObserveError` where there are more than can be compared in a reasonable time."""
    if len(nodes) > MOST_NODES or len(endpoints) > MOST_ENDPOINTS:
        raise CannotObserveError(
            f"{place} has {len(nodes)} nodes with {len(endpoints)} endpoints; "
            f"up to {MOST_NODES} nodes and {MOST_ENDPOINTS} endpoints are compared"
        )


def with_shown_names(live: Observation) -> Observation:
    """The same system, its names as they can be shown. Nodes that then have the same name are one, several times."""
    nodes: dict[str, LiveNode] = {}
    for node in live.nodes.values():
        name = shown(node.name)
        before = nodes.get(name)
        count = node.count + (before.count if before is not None else 0)
        dead, lifecycle = (shown(each) if each is not None else None for each in (node.dead, node.lifecycle))
        nodes[name] = LiveNode(name, dead, count, lifecycle)
    endpoints = tuple(_endpoint(endpoint) for endpoint in live.endpoints)
    return Observation(live.generation, nodes, endpoints, shown(live.run) if live.run is not None else None)


def _endpoint(endpoint: LiveEndpoint) -> LiveEndpoint:
    kind = shown(endpoint.type) if endpoint.type is not None else None
    qos = {shown(policy): shown(value) if isinstance(value, str) else value for policy, value in endpoint.qos.items()}
    return LiveEndpoint(endpoint.role, shown(endpoint.node), shown(endpoint.name), kind, qos)
