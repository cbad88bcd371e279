"""What is kept of a launch configuration, and compared. Nothing of it depends on the machine or on the moment."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from typing import Any

from preflight_analysis.dataclass import dataclass

SCHEMA = "ros-preflight/snapshot/1"

GROUPS = {
    "publishers": "publisher",
    "subscribers": "subscriber",
    "services": "service",
    "clients": "client",
    "action_servers": "action_server",
    "action_clients": "action_client",
}
"""How the ends of a role are called in files, as in `graph --format json`."""
SURE_OUTCOMES = ("spinning", "exited")


@dataclass(frozen=True, slots=True)
class EndpointSnapshot:
    """One end of a topic, service or action under its final name. `type` None: not known."""

    type: str | None
    qos: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class NodeSnapshot:
    """One node. `facts` are how it is started: `package`, `executable`, and what else is not as by default."""

    facts: Mapping[str, Any]
    origin: str | None = None
    """The launch file that it is written in. A node that moves to another file is the same node."""
    interface: str = "none"
    """What its ends are known by, as in `graph --format json`."""
    outcome: str = "not-run"
    """How its run ended; an exit code other than 0 follows."""
    endpoints: Mapping[str, Mapping[str, EndpointSnapshot]] = field(default_factory=dict)
    """By role, by final name; without those that every node has by its client library."""
    parameters: Mapping[str, Any] = field(default_factory=dict)
    """What the launch files set, without the node's name."""
    reads: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    """The parameters that it asks for, by full name: `default`, or `required` where it gives none."""
    remaps: Mapping[str, str] = field(default_factory=dict)
    env: Mapping[str, str] = field(default_factory=dict)

    @property
    def known(self) -> bool:
        """Whether anything is known of its ends."""
        return self.interface != "none"

    @property
    def sure(self) -> bool:
        """Whether an end that is not here is one that the node does not make."""
        return self.interface in ("annotation", "settings", "nodl") or (self.known and self.outcome in SURE_OUTCOMES)


@dataclass(frozen=True, slots=True)
class Snapshot:
    """A launch configuration. The keys of `nodes` are full names; of two nodes of one name the second has `#2` behind
    it."""

    launch: str
    generation: int
    args: Mapping[str, str]
    """Those that were given."""
    nodes: Mapping[str, NodeSnapshot]
    parameters: Mapping[str, Any] = field(default_factory=dict)
    """Those of no node, by full name (ROS 1)."""
    errors: tuple[str, ...] = ()
    """What would stop the launcher."""
    unknown: tuple[str, ...] = ()
    """What could not be known without running something, or at all."""
