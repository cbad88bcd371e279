"""Which nodes of a launch can reach each other at all: those of one ROS domain, middleware, discovery and master."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import chain
from typing import NamedTuple
from urllib.parse import urlsplit

from preflight_analysis.documents.document import Document
from preflight_analysis.evaluation.ros2.containers import container_of, containers_of
from preflight_analysis.evaluation.ros2.domain_bridges import bridged_topics, is_domain_bridge
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree
from preflight_analysis.incremental.kept import Kept
from preflight_analysis.tracing.nodelets import manager_of

Domain = tuple[tuple[str, str], ...]
"""The variables that keep nodes apart where they differ, each with its value or its default."""

MIDDLEWARE = "RMW_IMPLEMENTATION"
_RANGE = "ROS_AUTOMATIC_DISCOVERY_RANGE"
_OFF = "OFF"
_ZENOH = "rmw_zenoh"
_DEFAULT = "the default"
_PEERS = "ROS_STATIC_PEERS"
_LOCAL = ("localhost", "127.0.0.1", "::1")
_VARIABLES: Mapping[int, Mapping[str, str]] = {
    1: {"ROS_MASTER_URI": "http://localhost:11311"},
    2: {
        "ROS_DOMAIN_ID": "0",
        MIDDLEWARE: _DEFAULT,
        _RANGE: _DEFAULT,
        "ROS_LOCALHOST_ONLY": _DEFAULT,
        _PEERS: _DEFAULT,
    },
}
"""By generation, with defaults: the master of ROS 1; domain, middleware and discovery of ROS 2
(https://docs.ros.org/en/rolling/Tutorials/Advanced/Improved-Dynamic-Discovery.html)."""


_BRIDGES = ("zenoh", "multimaster", "master_sync", "foreign_relay")
"""In the package, executable or arguments of what carries messages from one domain or master to another."""


class Difference(NamedTuple):
    """A variable that two nodes have different values of. `separates`: they cannot talk, for sure. `unsupported`: they
    may, and nobody promises it."""

    variable: str
    one: str
    other: str
    separates: bool
    unsupported: bool


class Domains(NamedTuple):
    """The domains of a launch whose nodes have different ones, else no node is in `by_node`."""

    by_node: Mapping[int, Domain | None] = {}
    """By the id of each node; None where it is not known."""
    bridged: frozenset[str] | None = frozenset()
    """The topics that bridges carry; None where any may be."""

    def apart(self, one: LaunchNode, other: LaunchNode) -> Difference | None:
        """What keeps two nodes apart, for sure."""
        mine, theirs = self.by_node.get(id(one)), self.by_node.get(id(other))
        return separation(mine, theirs) if mine is not None and theirs is not None else None


def domains_of(
    tree: LaunchTree, variables: Mapping[str, str], documents: Mapping[str, Document], kept: Kept
) -> Domains:
    """The domains of the nodes of a launch, given the variables that it is started with. `documents` has the
    configuration files of bridges."""
    nodes = tree.nodes
    if not any(kept.each(_sets_domain, nodes, tree.generation)) or not tree.complete:
        return Domains()
    found = [domain_of(process, variables, tree.generation) for process in processes_of(tree)]
    if len({*found} - {None}) < 2:
        return Domains()
    bridged: set[str] = set()
    whole = True
    for node in nodes:
        if is_domain_bridge(node):
            topics = bridged_topics(node, documents)
            whole = whole and topics is not None
            bridged.update(topics or ())
        elif any(word in text for word in _BRIDGES for text in (node.package, node.executable, node.args)):
            whole = False
    by_node = {id(node): domain for node, domain in zip(nodes, found, strict=True)}
    return Domains(by_node, frozenset(bridged) if whole else None)


def _sets_domain(node: LaunchNode, generation: int) -> bool:
    return any(name in _VARIABLES[generation] for name, _ in node.env)


def processes_of(tree: LaunchTree) -> list[LaunchNode | None]:
    """Of each node the one whose process it is in: a container, a nodelet manager, else itself. None where the launch
    does not start that, and on another machine, whose environment is not known."""
    containers = containers_of(tree.nodes)

    def process(node: LaunchNode) -> LaunchNode | None:
        if node.kind == "composable":
            return container_of(node, containers)
        if tree.ros.has_nodelets and (manager := manager_of(node)) is not None:
            return containers.get(manager)
        return node

    return [found if found is not None and found.machine is None else None for found in map(process, tree.nodes)]


def domain_of(process: LaunchNode | None, variables: Mapping[str, str], generation: int) -> Domain | None:
    """Where a process talks, given the variables that the launch is started with; None where that is not known."""
    if process is None:
        return None
    env = dict(process.env)
    found = {name: env.get(name, variables.get(name)) or default for name, default in _VARIABLES[generation].items()}
    return None if any("$(" in value for value in found.values()) else tuple(found.items())


def differences(one: Domain, other: Domain) -> Iterator[Difference]:
    """What keeps, or may keep, the nodes of two domains apart."""
    reached = all(value == _DEFAULT for name, value in (*one, *other) if name in ("ROS_LOCALHOST_ONLY", _PEERS))
    for (variable, mine), (_, theirs) in zip(one, other, strict=True):
        if mine != theirs:
            separates = _separates(variable, mine, theirs) or (
                variable == _RANGE and _OFF in (mine, theirs) and reached
            )
            # Vendors of DDS talk in part, which the documentation of ROS does not promise; a vendor's variants talk.
            known = variable == MIDDLEWARE and _DEFAULT not in (mine, theirs)
            unsupported = known and not separates and _vendor(mine) != _vendor(theirs)
            yield Difference(variable, mine, theirs, separates, unsupported)


def separation(one: Domain, other: Domain) -> Difference | None:
    """What keeps the nodes of two domains apart, for sure."""
    return next((each for each in differences(one, other) if each.separates), None) if one != other else None


def groups_apart(domains: Iterable[Domain | None]) -> Sequence[Sequence[Domain]]:
    """Domains in groups of which none reaches another, in their order; none where one of them is not known."""
    groups: list[list[Domain]] = []
    for domain in dict.fromkeys(domains):
        if domain is None:
            return ()
        near = [group for group in groups if any(separation(each, domain) is None for each in group)]
        joined = [*chain.from_iterable(near), domain]
        groups = [joined if near and group is near[0] else group for group in groups if group not in near[1:]]
        if not near:
            groups.append(joined)
    return groups


def _separates(variable: str, one: str, other: str) -> bool:
    if variable == "ROS_DOMAIN_ID":
        return one.isdecimal() and other.isdecimal() and int(one) != int(other)
    if variable == MIDDLEWARE:
        # Zenoh has another protocol than DDS (https://docs.ros.org/en/kilted/Installation/RMW-Implementations.html).
        return _DEFAULT not in (one, other) and one.startswith(_ZENOH) != other.startswith(_ZENOH)
    if variable == "ROS_MASTER_URI":
        return _are_two_masters(one, other)
    # On one host nodes of different ranges of discovery find each other, but for `OFF` and what peers make of it.
    return False


def _vendor(middleware: str) -> str:
    return middleware.removesuffix("_cpp").removesuffix("_dynamic")


def _are_two_masters(one: str, other: str) -> bool:
    """`localhost` may be the host that the other one names."""
    try:
        mine, theirs = urlsplit(one), urlsplit(other)
        if mine.port != theirs.port:
            return True
    except ValueError:
        return False
    hosts = mine.hostname, theirs.hostname
    return hosts[0] != hosts[1] and not any(host in _LOCAL for host in hosts)
