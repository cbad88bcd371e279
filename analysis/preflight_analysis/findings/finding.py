"""A finding: plain data, no editor types."""

from __future__ import annotations

from dataclasses import field, replace
from typing import Literal, NamedTuple

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location
from preflight_analysis.edits.edit import Edit
from preflight_analysis.findings.claim import Effect, Kind, Subject, Text
from preflight_analysis.findings.doubt import Doubt
from preflight_analysis.findings.lack import Lack

Severity = Literal["error", "warning", "info", "hint"]
Confidence = Literal["certain", "likely", "possible"]

SEVERITIES: tuple[Severity, ...] = ("hint", "info", "warning", "error")
"""From the least to the most severe."""
CONFIDENCES: tuple[Confidence, ...] = ("possible", "likely", "certain")
"""From the least to the most sure."""


@dataclass(frozen=True, slots=True)
class Fix:
    """A quick fix. `preferred` ones are what an editor applies without asking which."""

    title: str
    edits: tuple[Edit, ...]
    preferred: bool = False


@dataclass(frozen=True, slots=True)
class Related:
    """Another place that belongs to the finding: the other end of a connection, a step of the include chain. `role`
    says which, where a program has to know: `included` is a step of that chain."""

    message: str
    location: Location
    role: Literal["", "included"] = ""


class EndpointRef(NamedTuple):
    """What a node has to do with a topic, service or action, all by their final names."""

    kind: Literal["topic", "service", "action"]
    channel: str
    node: str


@dataclass(frozen=True, slots=True)
class Alike:
    """What many findings of one cause have in common. `what` goes on from their number (`parameters are not declared by
    /n`), `name` is what this one is about. `mended_in` is the file that lacks all the names, where that is not the one
    that the finding is in: a few of them are of one cause already, and wherever they are."""

    what: Text
    name: str
    mended_in: str = ""


@dataclass(frozen=True, slots=True)
class Finding:
    """Something wrong, where it is, how sure we are and what mends it.

    `severity` is what it means for the robot, `confidence` how sure we are; both are of `policy.py`, by its `effect`
    and `doubts`. `message` is its `text`, which speaks of its `subject`; `candidates` are what was probably meant, the
    best first. `stops_launch` marks what would stop the
    launcher itself (the `errors` of `tree`). `roots` are the launch files in whose context it holds.
    """

    rule: str
    name: str
    severity: Severity
    confidence: Confidence
    message: str
    location: Location
    related: tuple[Related, ...] = ()
    fixes: tuple[Fix, ...] = ()
    roots: tuple[str, ...] = field(default=())
    stops_launch: bool = False
    launch_order: int = field(default=0, compare=False)
    """Of one that stops the launcher: its place in the order in which the launcher would meet them."""
    endpoints: tuple[EndpointRef, ...] = field(default=(), compare=False)
    """Of one about connections: the ends that it speaks of, for a picture of the graph."""
    every_root: bool = field(default=False, compare=False)
    """It holds only if it holds in each launch that reads the file, as one of a rule with `Rule.every_root`."""
    condition: str = ""
    """Where it holds only if the launch is given other arguments: which ones, or what of a condition; `sim:=true`."""
    crash_of: str = field(default="", compare=False)
    """The node that crashes for what the finding speaks of, where another finding speaks of that crash: its full name.
    The finding about the crash has it as well."""
    lack: Lack | None = None
    """What is missing on this machine, where the finding speaks of nothing else."""
    alike: Alike | None = field(default=None, compare=False)
    """Of one that says the same of its name as others of its file may of theirs: reports have one for many."""
    effect: Effect = "misbehaves"
    kind: Kind = "invalid"
    doubts: tuple[Doubt, ...] = ()
    subject: Subject = Subject("text")
    candidates: tuple[str, ...] = ()
    text: Text = field(default=Text(""), compare=False)

    @property
    def safe_fix(self) -> Fix | None:
        """The fix that may be made unasked: of a finding that is certain, whatever the launch is given, the only one,
        for the only thing that can be meant."""
        sure = self.confidence == "certain" and not self.condition and len(self.candidates) <= 1
        return self.fixes[0] if sure and len(self.fixes) == 1 and self.fixes[0].preferred else None


def under(finding: Finding, condition: str) -> Finding:
    """A finding that holds only where a condition does, which its message says."""
    text = finding.text.followed_by(" (if {condition})", condition=condition)
    message = f"{finding.message} (if {condition})"
    return replace(finding, text=text, message=message, condition=condition, stops_launch=False, launch_order=0)
