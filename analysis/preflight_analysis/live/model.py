"""What a running system shows of itself, and what is expected of it. Plain data."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import field
from typing import Any, Literal

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Place
from preflight_analysis.tracing.interface import Role


class CannotObserveError(Exception):
    """The running system cannot be asked; says why in a sentence. `final`: asking again does not help."""

    def __init__(self, reason: str, *, final: bool = False) -> None:
        super().__init__(reason)
        self.final = final


@dataclass(frozen=True, slots=True)
class LiveNode:
    """A node that the running system has. `dead`: why it is believed to have ended although it is registered (ROS 1:
    a node that is killed stays registered). `count`: how many there are of the name (ROS 2)."""

    name: str
    dead: str | None = None
    count: int = 1
    lifecycle: str | None = None
    """The state of a lifecycle node, such as `unconfigured`, where it told it."""

    @property
    def inactive(self) -> str | None:
        """The state of a lifecycle node that is not active: it need not have made what it makes when it is."""
        return self.lifecycle if self.lifecycle != "active" else None


@dataclass(frozen=True, slots=True)
class LiveEndpoint:
    """An end of a topic, service or action under its final name. `type` None: not known, or, of a topic of ROS 1, not
    known to the master."""

    role: Role
    node: str
    name: str
    type: str | None
    qos: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Observation:
    """A running system at one moment."""

    generation: int
    nodes: Mapping[str, LiveNode]
    endpoints: tuple[LiveEndpoint, ...]
    run: str | None = None
    """What tells one run of the system from the next: the `run_id` of a master of ROS 1."""


@dataclass(frozen=True, slots=True)
class ExpectedEndpoint:
    """`certain`: whether the node makes it in any case; one that is found by reading the source, or after a made-up
    answer, may well be missing, and one that is made on demand is when nobody asks for it. `parts`: of an action of
    ROS 1, its topics by role."""

    role: Role
    name: str
    type: str | None
    qos: Mapping[str, Any] = field(default_factory=dict)
    certain: bool = True
    on_demand: bool = False
    parts: tuple[tuple[Role, str], ...] = ()
    place: Place | None = None
    """The remap that gave it its name, else the node's own line."""
    source: Place | None = None
    """Where the node's source makes it."""


@dataclass(frozen=True, slots=True)
class ExpectedNode:
    """A node that the launch starts. `complete`: all its ends are known, so that another one is extra. `exits`:
    it has done its work and ends, so that it need not be there. `reason`: why it ended in the sandbox. `by` of a
    nodelet: the node that makes its ends."""

    name: str
    endpoints: tuple[ExpectedEndpoint, ...]
    complete: bool
    place: Place | None
    certain: bool = True
    """Whether it is sure to be started under this name."""
    exits: bool = False
    reason: str | None = None
    by: str | None = None


@dataclass(frozen=True, slots=True)
class Expected:
    """What should be there after the launch. `complete`: whether all its nodes are known."""

    generation: int
    nodes: tuple[ExpectedNode, ...]
    complete: bool = True


State = Literal["present", "missing", "extra", "dead", "wrong-type", "differs", "inactive", "unsure"]
"""Of a node, topic, service or action. `unsure`: it is not there, and need not be. Of nodes alone: `differs` runs and
lacks something or has another QoS, `inactive` is a lifecycle node that nothing has activated yet."""
IssueKind = Literal["missing", "extra", "dead", "twice", "wrong-type", "wrong-qos"]


@dataclass(frozen=True, slots=True)
class Issue:
    """One thing that is not as expected. `what` is `node` or the role of an end.

    `counts`: whether the running system is not the expected one because of it; otherwise it is for information, as
    what may well not be there, or tools that people start beside the robot.
    """

    kind: IssueKind
    what: str
    node: str
    name: str | None = None
    expected: str | None = None
    actual: str | None = None
    similar: str | None = None
    """Of something missing: what is there instead, as it seems."""
    inactive: str | None = None
    """The state of the lifecycle node, where it is not active."""
    counts: bool = True
    place: Place | None = None
    source: Place | None = None


@dataclass(frozen=True, slots=True)
class Comparison:
    """The running system beside the expected one. States are by full name, as in the tree and the graph: of what has an
    anonymous name that is not the one it runs under, which the issues have."""

    issues: tuple[Issue, ...]
    nodes: Mapping[str, State]
    topics: Mapping[str, State]
    services: Mapping[str, State]
    actions: Mapping[str, State]

    @property
    def same(self) -> bool:
        """Whether nothing counts."""
        return not any(issue.counts for issue in self.issues)


_BUILTIN_SERVICES = {
    1: re.compile(r"/(?:get_loggers|set_logger_level)\Z"),
    2: re.compile(
        r"/(?:(?:describe|get|list|set)_parameters|get_parameter_types|set_parameters_atomically"
        r"|get_type_description|(?:get|set)_logger_levels"
        # of a lifecycle node
        r"|change_state|get_state|get_available_states|get_available_transitions|get_transition_graph)\Z"
    ),
}
_BUILTIN_TOPICS = {1: {"/rosout", "/clock"}, 2: {"/rosout", "/parameter_events", "/clock"}}
_OF_LIBRARIES = {1: "/bond", 2: "/transition_event"}
"""Topics of nodelets and their manager, and of lifecycle nodes."""


def is_builtin(generation: int, role: Role, name: str) -> bool:
    """Whether a node has such an end by its client library, whatever it does. While time is simulated each one
    subscribes to `/clock`."""
    if role in ("service", "client"):
        return _BUILTIN_SERVICES[generation].search(name) is not None
    return name in _BUILTIN_TOPICS[generation] or name.endswith(_OF_LIBRARIES[generation])
