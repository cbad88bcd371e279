"""Near misses in a graph that changes bit by bit are those of the same graph looked at for the first time."""

from __future__ import annotations

import random
from operator import itemgetter
from types import SimpleNamespace
from typing import Any, cast

import pytest
from preflight_analysis.graph.domains import Domains
from preflight_analysis.graph.model import Channel, Connection, Graph
from preflight_analysis.incremental.kept import Kept
from preflight_analysis.model.context import Context
from preflight_analysis.model.near_miss import EVIDENCE, NearMiss
from preflight_analysis.model.near_miss_evidence import best_rank, known_type
from preflight_analysis.model.near_miss_search import near_misses
from preflight_analysis.tracing.interface import Endpoint

WORDS = ("camera", "front", "image", "raw", "points", "cmd", "vel", "cmdvel", "odom", "c_am", "came", "scan", "scan1")
TYPES = ("sensor_msgs/Image", "sensor_msgs/Image", "geometry_msgs/Twist", "std_msgs/String", None, "*")

EndpointRef = tuple[bool, str, Any, Endpoint, bool]


def _name(made: random.Random) -> str:
    segments = ("_".join(made.choices(WORDS, k=made.randint(1, 2))) for _ in range(made.randint(1, 3)))
    return "/" + "/".join(segments)


def _end(made: random.Random, nodes: list[Any]) -> EndpointRef:
    node, name = made.choice(nodes), _name(made)
    given = made.choice((name, name[1:], name.rpartition("/")[2], "~" + name[1:]))
    if made.random() < 0.3:
        name = node.name.rpartition("/")[0] + name
    providers = made.random() < 0.5
    endpoint = Endpoint(
        "publisher" if providers else "subscriber", given, made.choice(TYPES), builtin=made.random() < 0.1
    )
    return providers, name, node, endpoint, made.random() < 0.2


def _channels(ends: list[EndpointRef]) -> dict[str, Channel]:
    sides: dict[str, tuple[list[Connection], list[Connection]]] = {}
    for providers, name, node, endpoint, remapped in ends:
        remap: Any = SimpleNamespace() if remapped else None
        sides.setdefault(name, ([], []))[not providers].append(Connection(name, node, endpoint, remap))
    return {name: Channel(name, tuple(o), tuple(w), name.startswith("/x")) for name, (o, w) in sorted(sides.items())}


def _context(topics: dict[str, Channel], nodes: list[Any], before: Kept | None = None) -> Any:
    """As much of a context as is looked at."""
    graph = SimpleNamespace(
        channels=lambda kind: topics if kind == "topics" else {},
        blind=0,
        tree=SimpleNamespace(nodes=nodes),
        unknown={"topics": frozenset(), "services": frozenset(), "actions": frozenset()},
        domains=Domains(),
    )
    none: Any = None
    return Context("", none, {}, {}, none, none, none, none, cast(Graph, graph), kept=Kept(before))


def _same(before: Channel | None, channel: Channel) -> Channel:
    """The one from before, if it has the same ends: as a graph that is patched has it."""
    return before if before == channel else channel


def _told(found: tuple[NearMiss, ...]) -> list[tuple[Any, ...]]:
    return [(id(n.consumer), id(n.provider), n.likeness, n.same_type, n.provider_dangles) for n in found]


@pytest.mark.parametrize("seed", range(8))
def test_edits_one_by_one(seed: int) -> None:
    made = random.Random(seed)
    nodes = [SimpleNamespace(name=_name(made)) for _ in range(made.randint(2, 25))]
    ends = [_end(made, nodes) for _ in range(made.choice((10, 60, 150)))]
    kept, known = Kept(), dict[str, Channel]()
    found = 0
    for _ in range(20):
        for _ in range(made.choice((0, 1, 1, 2, 8))):
            at = made.randrange(len(ends))
            ends[at : at + made.randint(0, 1)] = [_end(made, nodes)]
        for _ in range(made.choice((0, 0, 1, 3))):
            old = made.choice(nodes)
            other = made.choice(nodes)
            new = SimpleNamespace(name=made.choice((_name(made), old.name, other.name)))
            nodes[nodes.index(old)] = new
            ends = [(*end[:2], new if end[2] is old else end[2], *end[3:]) for end in ends]
        channels = known = {name: _same(known.get(name), channel) for name, channel in _channels(ends).items()}
        context = _context(channels, nodes, kept)
        again, kept = near_misses(context, "topics"), context.kept
        kept.end()
        assert _told(again) == _told(near_misses(_context(channels, nodes), "topics"))
        found += len(again)
    assert found


@pytest.mark.parametrize("seed", range(4))
def test_of_all_channels_none_fits_better(seed: int) -> None:
    """But for remaps at one side, of which several speak for nothing."""
    made = random.Random(seed)
    nodes = [SimpleNamespace(name=_name(made)) for _ in range(25)]
    channels = _channels([_end(made, nodes) for _ in range(300)])
    compared = 0
    for near in near_misses(_context(channels, nodes), "topics"):
        consumer, wanted = near.consumer, known_type(near.consumer)
        if wanted is None:
            continue
        among = [each for each in channels.values() if {wanted, None} & {known_type(end) for end in each.providers}]
        ranked = ((rank, each) for each in among if (rank := best_rank(consumer, each, consumer.node)) is not None)
        rank, channel = min(ranked, key=itemgetter(0))
        if EVIDENCE[rank[2]] != "remap":
            assert (near.provider, near.likeness) == (channel.providers[rank[-1]], EVIDENCE[rank[2]])
            compared += 1
    assert compared
