"""The computation graph as it would be after the launch."""

from __future__ import annotations

import fnmatch
from collections.abc import Collection, Mapping, Sequence
from functools import cached_property
from itertools import chain
from typing import NamedTuple

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree, Remap
from preflight_analysis.graph.domains import Domains
from preflight_analysis.tracing.interface import ENDS, Endpoint, Interface, KindOfEnds, ParamUse, Role

ChannelKind = KindOfEnds
PROVIDERS: tuple[Role, ...] = ("publisher", "service", "action_server")
"""The roles of those at the providing end of a channel."""


@dataclass(frozen=True, slots=True)
class Connection:
    """One end of a topic or service under its final name. `remap` is the one that applied, if any."""

    name: str
    node: LaunchNode
    endpoint: Endpoint
    remap: Remap | None
    action: str | None = None
    """Of a topic: the action that it is a part of, under its final name."""

    @property
    def is_placed(self) -> bool:
        """Whether the launch decides on its name: by a remap, or by a parameter."""
        return self.remap is not None or self.endpoint.named_by is not None


@dataclass(frozen=True, slots=True)
class Channel:
    """A topic, service or action: everything that meets under one name. Servers are among its providers."""

    name: str
    providers: tuple[Connection, ...]
    """Publishers of a topic, servers of a service or action."""
    consumers: tuple[Connection, ...]
    """Subscribers of a topic, clients of a service or action."""
    external: bool = False
    """The settings say that something outside of the launch offers or wants it."""
    domain: str = ""
    """What tells it from the channel of that name that the graph has under the name alone: `ROS_DOMAIN_ID 5`."""
    apart: tuple[Connection, ...] = ()
    """The ends of the same name that cannot reach it."""

    @property
    def key(self) -> str:
        """Under which the graph has it: the name, and the domain where several have that name."""
        return f"{self.name} ({self.domain})" if self.domain else self.name

    @property
    def provided_apart(self) -> bool:
        """Whether ends of the same name that cannot reach it provide it."""
        return any(each.endpoint.role in PROVIDERS for each in self.apart)

    @property
    def consumed_apart(self) -> bool:
        """Likewise whether they consume it."""
        return any(each.endpoint.role not in PROVIDERS for each in self.apart)

    @property
    def types(self) -> tuple[str, ...]:
        """The types in use, sorted, without repetition."""
        return tuple(
            sorted({c.endpoint.type for c in (*self.providers, *self.consumers) if c.endpoint.type is not None})
        )


@dataclass(frozen=True, slots=True)
class ParamRead:
    """A parameter that a node asks for, under its full name."""

    name: str
    node: LaunchNode
    use: ParamUse


class Standing(NamedTuple):
    """What is known of a node as a whole."""

    complete: bool
    """Its interface is known to its end."""
    likely_complete: bool
    blind: bool
    """It ended before it came to its event loop, with nothing known of it from elsewhere."""
    silent: tuple[ChannelKind, ...]
    """The kinds of which nothing is known."""

    @classmethod
    def of(cls, interface: Interface) -> Standing:
        """That of a node, by what it does."""
        blind = interface.source == "trace" and interface.outcome.status in ("crashed", "timed-out")
        silent = tuple(kind for kind in ENDS if not interface.speaks_of(kind))
        return cls(interface.complete, interface.likely_complete, blind, silent)


@dataclass(frozen=True)
class Graph:
    """`interfaces` has an entry for each node of the tree by its position in `tree.nodes` (names may clash). In ROS 2
    the tree has all nodes that a process was seen to make, each as if the launch file had it.
    """

    tree: LaunchTree
    interfaces: tuple[Interface, ...]
    processes: tuple[Interface, ...]
    """What the nodes of the launch file do with all that is in their processes, in the order of the launch's tree."""
    topics: Mapping[str, Channel]
    services: Mapping[str, Channel]
    actions: Mapping[str, Channel]
    reads_of_nodes: tuple[tuple[ParamRead, ...], ...]
    """The parameters that each node asks for, in the order of `interfaces`."""
    standings: tuple[Standing, ...]
    """Likewise."""
    external_topics: tuple[str, ...] = ()
    """Patterns of the topics that something outside of the launch offers or wants."""
    domains: Domains = Domains()
    """Which nodes cannot reach each other."""

    @cached_property
    def param_reads(self) -> tuple[ParamRead, ...]:
        """Those of all nodes, one node after another."""
        return tuple(chain.from_iterable(self.reads_of_nodes))

    @cached_property
    def read_names(self) -> frozenset[str]:
        """The full names of the parameters that nodes read."""
        return frozenset([read.name for read in self.param_reads])

    def channels(self, kind: ChannelKind) -> Mapping[str, Channel]:
        """All of a kind, by their keys: the name, and the domain where the ends of one name cannot reach each other."""
        return {"topics": self.topics, "services": self.services, "actions": self.actions}[kind]

    def named(self, kind: ChannelKind, name: str) -> Sequence[Channel]:
        """Those of a name, one for each domain that has it."""
        channels = self.channels(kind)
        if (first := channels.get(name)) is None:
            return ()
        if not first.apart:
            return (first,)
        return (first, *(each for each in channels.values() if each.name == name and each.domain))

    def providers_for(self, node: LaunchNode, kind: ChannelKind, name: str) -> Sequence[Connection]:
        """The providers of a channel that a node can reach."""
        found = tuple(chain.from_iterable(channel.providers for channel in self.named(kind, name)))
        if not self.domains.by_node:
            return found
        return tuple(each for each in found if self.domains.apart(node, each.node) is None)

    @cached_property
    def _ends(self) -> Mapping[tuple[int, ChannelKind], tuple[list[Connection], list[Connection]]]:
        found: dict[tuple[int, ChannelKind], tuple[list[Connection], list[Connection]]] = {}
        for kind in ENDS:
            for channel in self.channels(kind).values():
                for side, ends in enumerate((channel.providers, channel.consumers)):
                    for end in ends:
                        if not end.endpoint.builtin and end.action is None:
                            found.setdefault((id(end.node), kind), ([], []))[side].append(end)
        return found

    def ends_of(self, node: LaunchNode, kind: ChannelKind) -> tuple[Sequence[Connection], Sequence[Connection]]:
        """What a node of the tree provides and what it consumes of a kind, without what each node has by its client
        library, and without the parts of actions."""
        return self._ends.get((id(node), kind), ((), ()))

    def is_external(self, topic: str) -> bool:
        """Whether the settings say so of a topic."""
        return any(fnmatch.fnmatchcase(topic, pattern) for pattern in self.external_topics)

    @cached_property
    def incomplete(self) -> tuple[str, ...]:
        """The names of the nodes whose interfaces are not known to their end."""
        pairs = zip(self.tree.nodes, self.standings, strict=True)
        return tuple(node.name for node, each in pairs if not each.complete)

    @cached_property
    def blind(self) -> int:
        """How many nodes ended before they came to their event loop, with nothing known of them from elsewhere: what
        seems to be missing may be theirs."""
        return sum(each.blind for each in self.standings)

    @cached_property
    def unknown(self) -> Mapping[ChannelKind, frozenset[str]]:
        """The full names of the nodes of which nothing is known of a kind."""
        pairs = zip(self.tree.nodes, self.standings, strict=True)
        silent = [(node.name, each.silent) for node, each in pairs if each.silent and node.kind != "process"]
        return {kind: frozenset(name for name, kinds in silent if kind in kinds) for kind in ENDS}

    def is_of_unknown(self, kind: ChannelKind, name: str) -> bool:
        """Whether a full name is below that of a node of which nothing is known of the kind, and so most likely its."""
        return is_below_one(name, self.unknown[kind])

    @cached_property
    def complete(self) -> bool:
        """Whether every node's interface is known to its end: only then does absence mean absence."""
        return self.tree.complete and not self.incomplete

    @cached_property
    def likely_complete(self) -> bool:
        """Whether no node is likely to have ends that are not known: absence is not sure, but to be reckoned with."""
        return self.tree.complete and all(each.likely_complete for each in self.standings)

    def likely_complete_beside(self, node: LaunchNode) -> bool:
        """Likewise of all nodes but one, of which it is known what it does not do."""
        pairs = zip(self.tree.nodes, self.standings, strict=True)
        return self.tree.complete and all(each.likely_complete for other, each in pairs if other is not node)


def is_below_one(name: str, others: Collection[str]) -> bool:
    """Whether one of some full names is a namespace around a full name."""
    above = name.rpartition("/")[0] if others else ""
    while above:
        if above in others:
            return True
        above = above.rpartition("/")[0]
    return False
