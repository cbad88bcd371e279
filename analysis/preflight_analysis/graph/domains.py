"""Which nodes of a launch can reach each other at all: those of one ROS domain, middleware, discovery and master."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple
from urllib.parse import urlsplit

from preflight_analysis.evaluation.ros2.containers import container_of, containers_of
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree
from preflight_analysis.tracing.nodelets import manager_of

Domain = tuple[tuple[str, str], ...]
"""The variables that keep nodes apart where they differ, each with its value or its default."""

MIDDLEWARE = "RMW_IMPLEMENTATION"
_DEFAULT = "the default"
_LOCAL = ("localhost", "127.0.0.1", "::1")
_VARIABLES: Mapping[int, Mapping[str, str]] = {
    1: {"ROS_MASTER_URI": "http://localhost:11311"},
    2: {
        "ROS_DOMAIN_ID": "0",
        MIDDLEWARE: _DEFAULT,
        "ROS_AUTOMATIC_DISCOVERY_RANGE": _DEFAULT,
        "ROS_LOCALHOST_ONLY": _DEFAULT,
        "ROS_STATIC_PEERS": _DEFAULT,
    },
}
"""By generation, with defaults: the master of ROS 1; domain, middleware and discovery of ROS 2
(https://docs.ros.org/en/rolling/Tutorials/Advanced/Improved-Dynamic-Discovery.html)."""


class Difference(NamedTuple):
    """A variable that two nodes have different values of. `separates`: they cannot talk, for sure."""

    variable: str
    one: str
    other: str
    separates: bool


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
    for (variable, mine), (_, theirs) in zip(one, other, strict=True):
        if mine != theirs:
            yield Difference(variable, mine, theirs, _separates(variable, mine, theirs))


def _separates(variable: str, one: str, other: str) -> bool:
    if variable == "ROS_DOMAIN_ID":
        return one.isdecimal() and other.isdecimal() and int(one) != int(other)
    if variable == MIDDLEWARE:
        # One vendor's variants talk; those of DDS do so in part, which the ROS documentation does not promise.
        return _DEFAULT not in (one, other) and _vendor(one) != _vendor(other)
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
