"""What a rule is: its texts and its check, all in the one file that declares it as `RULE`."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import field, replace
from typing import TypeVar

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.span import Location
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.findings.claim import Effect, Kind, Subject, Text, as_text
from preflight_analysis.findings.clipping import SHORT, clipped
from preflight_analysis.findings.doubt import Doubt, Reason
from preflight_analysis.findings.finding import Alike, EndpointRef, Finding, Fix, Related
from preflight_analysis.findings.lack import Lack
from preflight_analysis.findings.policy import judge
from preflight_analysis.findings.rule_description import RuleDescription
from preflight_analysis.findings.suppression import Suppression
from preflight_analysis.launch.problems import ProblemKind
from preflight_analysis.model.context import Context

T = TypeVar("T")


Check = Callable[["Rule", Context], Iterable[Finding]]
OfPackage = Callable[["Rule", Disk, Environment, Package], Iterable[Finding]]
OfDescription = Callable[["Rule", Disk, Environment, str], Iterable[Finding]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Rule(RuleDescription):
    """A rule. What its check yields is made by `claim`: how severe that is says `findings/policy.py`.

    `problems` are the kinds of problems that the rule reports; each kind has one rule.
    `needs_graph`: it says nothing before the interfaces are there, so nothing follows from its silence then.
    `in_branches`: it speaks of what conditions leave out, too: of single tags and values, and never of what is there
    because something else is not. One that needs the graph gets that of nodes which were not run for it, and what it
    says counts where it is grave and of a parameter that only the branch sets.
    `generations`: those of ROS in whose launches it has something to say.
    `of_sources`: it reads the sources of programs, which takes seconds: it comes after what the texts of a launch say.
    `every_root`: in a file that others include, it holds only if it holds in every root that reaches the file.
    `of_package`: what it says of one package of the workspace, whatever launch starts its nodes.
    `of_description`: what it says of one file of robot descriptions or worlds, by its path, whatever launch reads it.
    `unused_suppression` is for the one rule that reports comments which silenced nothing: it comes after the others.
    `of_param`: it speaks of one parameter of a node, whatever else there is: also of a file that no launch is known to
    give to its nodes.
    `of_robot`: it speaks of what a robot description has and lacks as a whole: where that has parts from the catalogue
    it is not certain.
    `left_out` is for the one rule that counts the findings of a file which are too many to be shown.
    `references` are Markdown links (`further_reading.py`), `since` the first version that has the rule, `settings` keys
    of `.ros-preflight.yaml` that change what it finds, beside those of all rules.
    """

    check: Check = field(repr=False)
    of_package: OfPackage | None = field(default=None, repr=False)
    of_description: OfDescription | None = field(default=None, repr=False)
    problems: tuple[type[ProblemKind], ...] = ()
    needs_graph: bool = False
    of_sources: bool = False
    every_root: bool = False
    generations: tuple[int, ...] = (1, 2)
    in_branches: bool = False
    of_param: bool = False
    of_robot: bool = False
    references: tuple[str, ...] = ()
    since: str = "0.1.0"
    settings: tuple[str, ...] = ()
    unused_suppression: Callable[[Rule, Suppression], Finding] | None = field(default=None, repr=False)
    left_out: Callable[[Rule, str, Sequence[Finding]], Finding] | None = field(default=None, repr=False)

    def claim(
        self,
        said: str | Text,
        location: Location,
        *,
        subject: Subject,
        kind: Kind | None = None,
        effect: Effect | None = None,
        doubts: Iterable[Doubt] = (),
        candidates: Iterable[str | None] = (),
        related: Iterable[Related] = (),
        fixes: Iterable[Fix] = (),
        stops_launch: bool = False,
        endpoints: Iterable[EndpointRef] = (),
        lack: Lack | None = None,
        every_root: bool = False,
        alike: Alike | None = None,
    ) -> Finding:
        """A finding of this rule, as severe as the policy has it. `effect` and `kind` are the rule's where they are not
        given, and the doubts come to those that the rule always has; a `lack` of this machine is one. What the messages
        say is clipped: names may be as long as a file."""
        text = as_text(said)
        all_doubts = (*map(Doubt, self.always), *doubts)
        if lack is not None:
            all_doubts = (Doubt(Reason.NOT_HERE, lack.name), *all_doubts)
        severity, confidence = judge(effect or self.effect, all_doubts)
        return Finding(
            self.id,
            self.name,
            severity,
            confidence,
            clipped(str(text)),
            location,
            tuple(r if len(r.message) <= SHORT else replace(r, message=clipped(r.message)) for r in related),
            tuple(f if len(f.title) <= SHORT else replace(f, title=clipped(f.title)) for f in fixes),
            (),
            stops_launch,
            endpoints=tuple(endpoints),
            every_root=every_root,
            lack=lack,
            alike=alike,
            effect=effect or self.effect,
            kind=kind or self.kind,
            doubts=all_doubts,
            subject=subject,
            candidates=tuple(filter(None, candidates)),
            text=text,
        )


def in_root(finding: Finding, root: str) -> Finding:
    """The finding, marked as holding when `root` is launched."""
    return replace(finding, roots=(root,))
