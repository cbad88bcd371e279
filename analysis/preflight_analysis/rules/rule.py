"""What a rule is: its texts and its check, all in the one file that declares it as `RULE`."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import field, replace
from typing import Protocol, TypeVar

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.edits.writer import Writer, writer_of
from preflight_analysis.environment.build import Made
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation.files import Executables
from preflight_analysis.evaluation.meanings import KnownMeanings
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.findings.claim import Effect, Kind, Subject, Text, as_text
from preflight_analysis.findings.clipping import SHORT, clipped
from preflight_analysis.findings.doubt import Doubt, Reason
from preflight_analysis.findings.finding import Alike, EndpointRef, Finding, Fix, Related
from preflight_analysis.findings.lack import Lack
from preflight_analysis.findings.policy import judge
from preflight_analysis.findings.rule_description import RuleDescription
from preflight_analysis.findings.suppression import Suppression
from preflight_analysis.graph.model import Graph
from preflight_analysis.incremental.kept import Kept
from preflight_analysis.incremental.once import Once
from preflight_analysis.knowledge.model import Knowledge
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.problems import ProblemKind

T = TypeVar("T")


class ExecutableNames(Executables, Protocol):
    """What an `environment.executables.ExecutableIndex` offers to rules."""

    def names(self, package: str) -> tuple[str, ...]:
        """All that a node of this package could name as its type, sorted; empty for an unknown package."""

    def is_build_target(self, package: str, name: str) -> bool:
        """Whether building the package will make the executable."""

    def is_library_target(self, package: str, name: str) -> bool:
        """Whether building the package will make the library."""

    def names_are_all(self, package: str) -> bool:
        """Whether the package has no others than `names`, as far as its build files can be understood."""

    def components(self, package: str) -> tuple[str, ...]:
        """The classes that a container can load of the package, sorted; empty where nothing is known of them."""

    def made_of(self, package: str, name: str) -> Made | None:
        """The file in the source of the package that the executable is made of, once it is built or installed."""


@dataclass(frozen=True, slots=True)
class Plugin:
    """A plugin that nodes load by pluginlib. `params` has its parameters by their names below its own, with defaults:
    `{sources}.topic` stands for `front.topic` where the parameter `sources` has `front` among its items, `../speed` is
    one of what loads it. `elsewhere` are those of other versions, `evidence` says where that is from, `of_workspace`
    whether that is the source of the workspace."""

    name: str
    params: Mapping[str, object]
    elsewhere: frozenset[str]
    evidence: str
    of_workspace: bool = False


class Plugins(Protocol):
    """What a `nodl.plugins.PluginIndex` offers to rules."""

    def plugin(self, name: str) -> Plugin | None:
        """The plugin `package::Name`, also written `package/Name`; None where nothing is known of it."""

    def names(self, package: str) -> tuple[str, ...]:
        """The plugins of a package that is not in the workspace; none where nothing is known of it."""

    def exported(self, package: str) -> tuple[str, ...]:
        """The plugins that a package of the workspace has, by its own descriptions; none of any other package."""


@dataclass(frozen=True, slots=True)
class Context(Once):
    """What a rule may look at. `graph` is None while the interfaces are not there yet (static analysis only).

    `documents` and `launch_files` have every XML file of the tree by path; `why_not_run` says why nodes were not run,
    None when they were. `executables` lists those of a package, `plugins` has what is known of plugins, `disk` files
    that the tree does not know. `settings_problems` is what is wrong with the workspace's settings file, and where.
    """

    root: str
    tree: LaunchTree
    documents: Mapping[str, Document]
    launch_files: Mapping[str, LaunchFile]
    environment: Environment
    executables: ExecutableNames
    plugins: Plugins
    disk: Disk
    graph: Graph | None = None
    why_not_run: str | None = None
    settings_problems: tuple[tuple[str, Location], ...] = ()
    own_knowledge: tuple[Knowledge, ...] = ()
    """What the user's files say of parameters."""
    of_branches: tuple[Finding, ...] = ()
    """What was found in tags that the tree leaves out (`workspace/branches.py`)."""
    kept: Kept = field(default_factory=Kept, repr=False, compare=False)
    """For what rules say of single nodes and channels: most of it is as it was before the last edit."""

    @property
    def known(self) -> KnownMeanings:
        """What is known of the parameters of nodes and plugins."""
        return KnownMeanings(self.own_knowledge, self.environment.distro, self.tree.generation)

    def location(self, path: str, span: Span) -> Location:
        """The location of a span of a document."""
        document = self.document(path)
        return document.location(span) if document is not None else Location.of_file(path)

    def text(self, location: Location) -> str:
        """What stands at a place; nothing where its file is not known."""
        document = self.document(location.file)
        return document.text[location.span.start : location.span.end] if document is not None else ""

    def document(self, path: str) -> Document | None:
        """A text; None where it is not known."""
        document: Document | Unreadable | None = self.documents.get(path)
        if document is None:
            document = self.disk.text(path)
        return document if isinstance(document, Document) else None

    def writer(self, path: str) -> Writer | None:
        """The writer of a file; None where its text is not known."""
        document = self.document(path)
        return document.once(writer_of) if document is not None else None


Check = Callable[["Rule", Context], Iterable[Finding]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Rule(RuleDescription):
    """A rule. What its check yields is made by `claim`: how severe that is says `findings/policy.py`.

    `problems` are the kinds of problems that the rule reports; each kind has one rule.
    `needs_graph`: it says nothing before the interfaces are there, so nothing follows from its silence then.
    `in_branches`: it speaks of what conditions leave out, too: of single tags and values, and never of what is there
    because something else is not. One that needs the graph gets that of nodes which were not run for it, and what it
    says counts where it is grave and of a parameter that only the branch sets.
    `generations`: those of ROS in whose launches it has something to say.
    `every_root`: in a file that others include, it holds only if it holds in every root that reaches the file.
    `unused_suppression` is for the one rule that reports comments which silenced nothing: it comes after the others.
    `of_robot`: it speaks of what a robot description has and lacks as a whole: where that has parts from the catalogue
    it is not certain.
    `left_out` is for the one rule that counts the findings of a file which are too many to be shown.
    `references` are Markdown links (`further_reading.py`), `since` the first version that has the rule, `settings` keys
    of `.ros-preflight.yaml` that change what it finds, beside those of all rules.
    """

    check: Check = field(repr=False)
    problems: tuple[type[ProblemKind], ...] = ()
    needs_graph: bool = False
    every_root: bool = False
    generations: tuple[int, ...] = (1, 2)
    in_branches: bool = False
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
