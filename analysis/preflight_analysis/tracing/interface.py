"""What one node does, and how we know."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import field, replace
from typing import Any, Literal, NamedTuple, get_args

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.exact import exact
from preflight_analysis.documents.span import Location
from preflight_analysis.documents.typed_json import TRANSIENT
from preflight_analysis.evaluation import names

Role = Literal["publisher", "subscriber", "service", "client", "action_server", "action_client"]
DOES: Mapping[str, str] = {
    "publisher": "publishes",
    "subscriber": "subscribes to",
    "service": "offers the service",
    "client": "calls the service",
    "action_server": "offers the action",
    "action_client": "uses the action",
}
"""What a node does at an end of each role, in words for the user; the name follows."""
KindOfEnds = Literal["topics", "services", "actions"]
Kind = Literal["topics", "services", "actions", "parameters"]
"""What a node may do, as it may be known of one kind and not of another."""
CHANGE_STATE = "lifecycle_msgs/srv/ChangeState"
"""The type of the service `~/change_state` of a lifecycle node, by which others configure and activate it."""
ENDS: tuple[KindOfEnds, ...] = ("topics", "services", "actions")
KINDS: tuple[Kind, ...] = (*ENDS, "parameters")
KIND_OF: Mapping[Role, KindOfEnds] = {
    "publisher": "topics",
    "subscriber": "topics",
    "service": "services",
    "client": "services",
    "action_server": "actions",
    "action_client": "actions",
}
Status = Literal["spinning", "exited", "crashed", "timed-out", "not-run"]
PENDING = "its run has not ended yet"
REASON_COLUMNS = 200
"""How much of a line of a node's output stands in the reason of an outcome."""
_STAMP = re.compile(r"\A\[ *[A-Z]+\] \[[\d., ]+\]: ")
_OF_LOGGER = "log4cxx:"
"""How the library behind rosconsole begins what it says of itself, mostly when the node has ended."""
_EXCEPTION = re.compile(r"[A-Za-z_][\w.]*(Error|Exception|Interrupt|Exit|Warning|Fault|NotFound)\b(: .*)?\Z")
_THROWN = re.compile(r"terminate called after throwing an instance of '([\w:]*?)(\w+)'\Z")
_WHAT = re.compile(r"\s*what\(\):\s*(\S.*)")
Source = Literal["trace", "annotation", "settings", "nodl", "configuration", "source", "similar", "catalogue", "none"]
SOURCES: tuple[Source, ...] = get_args(Source)
"""From where something is known, what is surer first. `configuration`: arguments and files that name what the node
makes of them."""
DECLARED: tuple[Source, ...] = ("annotation", "settings", "nodl")
"""Where somebody has written down what a node does."""


Unsure = Literal["made-up answer", "on demand", "stand-in", "computed names", "condition", "other distribution"]
"""Why the real node may not do what is known of it.

`made-up answer`: it was seen after one. `on demand`: it was made once somebody was at the other end of another topic of
the node. `stand-in`: it was seen in a run without some of the modules that the node imports, which others stood in for.
`computed names`: the source of the node makes others of the role and type, of whose names is not known how they are
computed. `condition`: in the source, only a condition that is not known leads there, or a callback. `other
distribution`: the catalogue knows it of another one than is used."""
_ASSUMED: frozenset[Unsure] = frozenset({"condition", "other distribution"})
_UNCERTAIN: frozenset[Unsure] = _ASSUMED | {"made-up answer", "on demand"}


@dataclass(frozen=True, slots=True, order=True)
class Evidence:
    """How something is known of a node: from which source, which one of the catalogue or of what is known of packages
    that is (`said_by`, in words), and why the real node may not do it."""

    source: Source = "trace"
    said_by: str = ""
    doubts: tuple[Unsure, ...] = ()
    """Sorted."""

    def but(self, *doubts: Unsure) -> Evidence:
        """The same with more doubts."""
        return replace(self, doubts=tuple(sorted({*self.doubts, *doubts})))

    def without(self, *doubts: Unsure) -> Evidence:
        """The same without some doubts."""
        return replace(self, doubts=tuple(each for each in self.doubts if each not in doubts))

    @property
    def conditional(self) -> bool:
        """Whether only a condition that is not known leads there, in the source."""
        return "condition" in self.doubts

    @property
    def inferred(self) -> bool:
        """Whether a source says so, here or when the catalogue was made, and no run."""
        return self.source in ("source", "catalogue")

    @property
    def of_catalogue(self) -> bool:
        """Whether the catalogue says so, or what is known of a package."""
        return self.source == "catalogue"

    @property
    def assumed(self) -> bool:
        """Whether no run of this node, no word of the user and no plain line of its source says so."""
        return self.source == "similar" or not _ASSUMED.isdisjoint(self.doubts)

    @property
    def uncertain(self) -> bool:
        """Whether it is assumed, or the node was seen to do it where the real one may not come to it."""
        return self.source == "similar" or not _UNCERTAIN.isdisjoint(self.doubts)


SEEN = Evidence()
IN_SOURCE = Evidence("source")
"""A run of the node showed it."""


def together(some: Iterable[Evidence]) -> Evidence:
    """How a whole is known of which these are the parts: by the least sure source, with all doubts."""
    parts = tuple(some)
    least = max(parts, key=lambda each: SOURCES.index(each.source))
    return least.but(*(doubt for each in parts for doubt in each.doubts))


class NamedBy(NamedTuple):
    """The parameter whose value is the name of an endpoint, and where that value is written. `display` is the name of
    the display of RViz whose property it is, in the configuration that the launch starts RViz with."""

    parameter: str
    place: Location
    display: str = ""


class TypedBy(NamedTuple):
    """The parameter whose value decides the type of an endpoint, where that value is written, None where it is not
    set, and the types by the value in words."""

    parameter: str
    place: Location | None
    types: tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True)
class Endpoint:
    """One end of a topic, service or action. `name` is as the node gave it (`chatter`, `~state`, `/scan`): namespaces
    and remaps are applied by the graph, so that a changed remap needs no new run. `type` is `pkg/Name`, `*` for any
    type, None when not known."""

    role: Role
    name: str
    type: str | None
    md5: str | None = None
    qos: Mapping[str, Any] = field(default_factory=dict)
    """ROS 1: `latch`, `queue_size`."""
    source_file: str | None = None
    """Where in the node's source it was made, line counted from 1."""
    source_line: int | None = None
    builtin: bool = False
    """What every node of the client library has (`/rosout`, `~get_loggers`, ...)."""
    evidence: Evidence = SEEN
    node: str | None = None
    """ROS 2, of a process that makes several nodes: the full name that the one had which made it. None for the node of
    the launch file."""
    named_by: NamedBy | None = field(default=None, metadata={TRANSIENT: True})
    """The parameter of the launch that gives the name; no run tells it."""
    typed_by: TypedBy | None = field(default=None, metadata={TRANSIENT: True})
    """The parameter that decides the type; no run tells it."""

    @property
    def displayed(self) -> bool:
        """Whether a display of RViz makes it, which its user turns on and off."""
        return self.named_by is not None and self.named_by.display != ""

    @property
    def uncertain(self) -> bool:
        """Whether the real node may well not make it."""
        return self.evidence.uncertain or self.displayed


@dataclass(frozen=True, slots=True)
class Range:
    """The values that a parameter of ROS 2 may have, both ends among them; a `step` of 0 is none."""

    low: float
    high: float
    step: float = 0

    def __str__(self) -> str:
        """`0 to 10 in steps of 2`."""
        text = f"{self.low} to {self.high}"
        return f"{text} in steps of {self.step}" if self.step else text


@exact("default")
@dataclass(frozen=True, slots=True)
class ParamUse:
    """A parameter call of the node. `name` as the node gave it; `access` is `get`, `has`, `set`, `delete`, `search`
    or `list`. `mandatory`: read without default."""

    name: str
    access: str
    default: Any = None
    has_default: bool = False
    mandatory: bool = False
    source_file: str | None = None
    source_line: int | None = None
    builtin: bool = False
    evidence: Evidence = SEEN
    type: str | None = None
    """ROS 2: `bool`, `integer`, `double`, `string`, or one of these with ` array`; None where it is not known."""
    dynamic: bool = False
    """ROS 2: it may have any type."""
    read_only: bool = False
    """ROS 2: nobody changes it once it is declared; the launch may still set it."""
    range: Range | None = None
    node: str | None = None
    """As of an endpoint."""
    refused: str | None = None
    """ROS 2: what the node said of the value, or of there being none, when it ended for that."""


@dataclass(frozen=True, slots=True, order=True)
class Frame:
    """A transform that the node broadcasts (tf, tf2), from the frame `parent` to `child`. One that its source does not
    tell is empty."""

    parent: str
    child: str
    static: bool = False
    evidence: Evidence = SEEN
    source_file: str = ""
    """Where in the node's source it is broadcast, line counted from 1."""
    source_line: int = 0


BUFFER = "Buffer"
"""The class of tf2 that is asked for transforms, and stands before its methods (`Buffer::lookupTransform`)."""


@dataclass(frozen=True, slots=True, order=True)
class FrameUse:
    """A frame that the node's source names. `call` is the method that gets it (`lookupTransform`), or the type of the
    message whose header has it (`sensor_msgs/LaserScan`)."""

    frame: str
    call: str
    looked_up: bool = True
    """Whether the node asks for a transform; otherwise the frame stands in a message that it publishes."""
    evidence: Evidence = IN_SOURCE
    source_file: str = ""
    source_line: int = 0


@dataclass(frozen=True, slots=True)
class MadeNode:
    """A node of ROS 2 that the process made: `given` is the name that its code gave it, `space` the namespace, "" for
    none; `name` what it then had, and `renamed` whether that is the one that the launch gave to the process. `full` is
    the full name in the run, where the process has several nodes: otherwise it is that of the launch file's node, and
    changes with it."""

    name: str
    given: str
    space: str = ""
    renamed: bool = False
    evidence: Evidence = SEEN
    full: str = ""
    own_arguments_only: bool = False
    """Whether the arguments of the process are not for it, as for a component: no name, remap or parameter of them."""
    unknown: bool = False
    """Whether nothing is known of it beside that it is there."""

    @property
    def hidden(self) -> bool:
        """Whether a library made it for itself, as tf2's listener does: its ends are those of the node around it."""
        return self.given.startswith("_") or self.name.startswith("_")


@dataclass(frozen=True, slots=True)
class Outcome:
    """How the run ended. `reason` is one sentence for the user where the status is not `spinning`."""

    status: Status
    exit_code: int | None = None
    signal: str | None = None
    stderr_tail: tuple[str, ...] = ()
    reason: str | None = None
    seconds: float = 0.0
    """Wall time of the run, from exec to the end."""
    answers: tuple[str, ...] = ()
    """What was made up so that the node went on, a sentence each."""
    lacks: str | None = None
    """What it ended for that only the sandbox lacks: `the device /dev/ttyUSB0, ...`."""

    @property
    def early(self) -> bool:
        """Whether the run ended before the node came to its event loop, by whatever: what it does after that was not
        seen."""
        return self.status in ("crashed", "timed-out") or (self.status == "exited" and self.exit_code != 0)


def without_stamp(line: str) -> str:
    """A line of a node's output without what rosconsole writes before it, which is another time in each run."""
    return _STAMP.sub("", line.strip(), count=1)


def telling_line(lines: Sequence[str]) -> str:
    """What of a node's last lines tells why it ended: its last exception, of Python's or as C++ tells one that nobody
    catches (`what():`), else the last line. Empty where it said nothing."""
    for at in reversed(range(len(lines))):
        if _EXCEPTION.match(lines[at]):
            return lines[at]
        what = _WHAT.match(lines[at])
        if what is not None:
            thrown = _THROWN.match(lines[at - 1]) if at else None
            # rcl's complaints of names end by a colon, and the name stands on a line of its own.
            more = f" {lines[at + 1].strip()}" if what[1].endswith(":") and at + 1 < len(lines) else ""
            return (f"{thrown[2]}: " if thrown else "") + what[1] + more
    said = (line for text in reversed(lines) if not text.startswith(_OF_LOGGER) and (line := without_stamp(text)))
    return next(said, "")


@dataclass(frozen=True, slots=True)
class Elsewhere:
    """The run that a similar trace was made by: of the node of that name, in that launch file if it is known.
    `changed` tells that the executable is not the same as now."""

    node: str
    launch: str | None
    changed: bool


@dataclass(frozen=True, slots=True)
class Interface:
    """A node's endpoints and parameters. `cached` tells that no new run was needed."""

    source: Source
    outcome: Outcome
    endpoints: tuple[Endpoint, ...] = ()
    params: tuple[ParamUse, ...] = ()
    cached: bool = False
    notes: tuple[str, ...] = ()
    """What else the user should know of the run: blocked writes, ignored SIGTERM, dropped event lines."""

    frames: tuple[Frame, ...] = ()
    """What it was seen to broadcast, or what its source says that it does; other frames may follow."""
    frame_uses: tuple[FrameUse, ...] = ()
    """The frames that its source asks for or puts into messages."""
    nodes: tuple[MadeNode, ...] = ()
    """ROS 2: those that the process was seen to make, or that its source makes; what its libraries make in C++ alone is
    not among them. Empty where it is not known which."""
    transitions: tuple[str, ...] = ()
    """ROS 2, of a lifecycle node: those of `configure` and `activate` that its own code makes, or may make."""
    looks: bool = False
    """ROS 2: whether it asked which nodes, topics or services there are. There were none, and it may do more, or
    something else, where there are. Likewise where it made nothing, and a module was missing that may do all of it."""
    stand_ins: tuple[str, ...] = ()
    """Python modules that it imports and this machine does not have, sorted: others stood in for them."""
    elsewhere: Elsewhere | None = None
    """Where the run of a similar one was made."""
    unnamed: tuple[Endpoint, ...] = ()
    """What it was seen to make under names that it makes up in each run, at random: the name of each is that of one
    run, and none of the others. They are not among the endpoints."""
    unnamed_calls: tuple[str, ...] = ()
    """The types of the services that its source calls under names that are not known, `*` for one that is not known."""
    whole: tuple[Kind, ...] = ()
    """The kinds of which its source, which it is known from, told all: each name is computed, each branch gone through;
    or the files and arguments that name the ends of a bridge or a relay."""

    @property
    def known(self) -> bool:
        """Whether there is anything to build a graph from: a node that was not run says nothing, one that crashed
        says what it made until then."""
        return self.source != "none"

    @property
    def declared(self) -> bool:
        """Whether somebody has written down what the node does."""
        return self.source in DECLARED

    @property
    def complete(self) -> bool:
        """Whether it is all that the node does: it was seen to spin, and not only after a made-up answer, or the user
        or the package's author declares it, in an annotation, the settings or NoDL."""
        seen_whole = not self.outcome.answers and not self.looks and not self.unnamed
        spins = self.known and self.outcome.status == "spinning" and seen_whole
        return self.declared or spins

    def may_call(self, type_: str) -> bool:
        """Whether it makes a client of that type of service under a name that is not known."""
        at_random = (end.type or "*" for end in self.unnamed if end.role == "client")
        return not {type_, "*"}.isdisjoint((*self.unnamed_calls, *at_random))

    def tells_all(self, *kinds: Kind) -> bool:
        """Whether it was seen to do all that it does, or its source tells all of these kinds: what is not there is
        likely not there."""
        return self.complete or (self.source == "source" and all(kind in self.whole for kind in kinds))

    def speaks_of(self, kind: Kind) -> bool:
        """Whether anything is known of what it does of a kind. The catalogue does not speak of a kind of which it has
        nothing: a base class may do it, or a library."""
        if self.source != "catalogue":
            return self.known
        if kind == "parameters":
            return any(not use.builtin for use in self.params)
        return any(KIND_OF[end.role] == kind for end in self.endpoints if not end.builtin)

    @property
    def decided(self) -> bool:
        """Whether a condition that is not known, or a plugin, decides what it does."""
        known = (*(use.evidence for use in self.params), *(end.evidence for end in self.endpoints))
        lists = any(use.access == "list" for use in self.params)
        return lists or any("condition" in each.doubts for each in known)

    @property
    def likely_complete(self) -> bool:
        """Whether nothing speaks for more ends than are known: it is complete, came to its event loop with the help of
        made-up answers, or ended by itself without an error; and it neither asked who else is there nor made up names.
        """
        outcome = self.outcome
        if (self.looks or self.unnamed) and not self.declared:
            return False
        done = outcome.status == "spinning" or (outcome.status == "exited" and outcome.exit_code == 0)
        return self.tells_all(*ENDS) or (self.known and done)

    def own_name(self, namespace: str, node: str | None = None) -> str | None:
        """ROS 2: the full name of the node, where its own code gives it one, in a namespace of the launch file (`/` for
        none). None where it is not known, or where the process has several and none is that which the launch file
        calls `node`: which of them is meant nobody can tell."""
        made = {(each.name, each.space) for each in self.nodes if not each.hidden}
        if len(made) > 1 and node is not None:
            made = {(each.name, each.space) for each in self.nodes if each.full == node and each.given}
        if len(made) != 1:
            return None
        ((name, space),) = made
        return names.canonicalize(f"/{space if namespace == '/' else namespace}/{name}")

    @property
    def names(self) -> tuple[str, ...]:
        """ROS 2: the full names of the nodes of the process, in the order in which they were made; empty where they are
        not known to be several."""
        found = dict.fromkeys(each.full for each in self.nodes if each.full and not each.hidden)
        return tuple(found) if len(found) > 1 else ()

    def apart(self, node: str) -> dict[str, Interface]:
        """What each of several nodes of the process does, by its full name. First the one of the launch file, which has
        what no other made; it is the first that was made where none is called `node`."""
        if not self.names:
            return {}
        first = node if node in self.names else self.names[0]
        others = [name for name in self.names if name != first]

        unknown = {each.full for each in self.nodes if each.unknown}

        def of(name: str) -> Interface:
            return replace(
                self,
                source="none" if name in unknown else self.source,
                endpoints=tuple(e for e in self.endpoints if (e.node if e.node in others else first) == name),
                params=tuple(p for p in self.params if (p.node if p.node in others else first) == name),
                nodes=tuple(each for each in self.nodes if (each.full if each.full in others else first) == name),
                frames=self.frames if name == first else (),
                frame_uses=self.frame_uses if name == first else (),
            )

        return {name: of(name) for name in (first, *others)}

    @property
    def pending(self) -> bool:
        """Whether its run has yet to end."""
        return self.outcome.reason == PENDING


NOT_RUN = Interface("none", Outcome("not-run"))
