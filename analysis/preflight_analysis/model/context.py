"""What may be looked at to answer a question about a launch."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping
from dataclasses import field
from typing import Any, Concatenate, ParamSpec, Protocol, TypeVar

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
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.model import Graph
from preflight_analysis.incremental.derived import Remembering
from preflight_analysis.incremental.kept import Before, Kept
from preflight_analysis.knowledge.model import Knowledge
from preflight_analysis.launch.model import LaunchFile

P = ParamSpec("P")
K = TypeVar("K", bound=Hashable)
T = TypeVar("T")
V = TypeVar("V")


class ExecutableNames(Executables, Protocol):
    """What an `environment.executables.ExecutableIndex` offers to rules."""

    def names(self, package: str) -> tuple[str, ...]:
        """All that a node of this package could name as its type, sorted; empty for an unknown package."""

    def is_build_target(self, package: str, name: str) -> bool:
        """Whether building the package will make the executable."""

    def is_in_build_file(self, package: str, name: str) -> bool:
        """Whether the build files of the package have the name of a file or class among their words."""

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
class Context(Remembering):
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

    def each(
        self, function: Callable[Concatenate[T, P], V], items: Iterable[T], /, *shared: P.args, **none: P.kwargs
    ) -> tuple[V, ...]:
        """`function(item, *shared)` for each of many items; of those that are as before an edit it is what it was. The
        function is pure: it looks at its arguments alone, and at no `span` in these."""
        return self.kept.each(function, items, *shared, **none)

    def each_row(
        self, function: Callable[..., V], columns: Iterable[Iterable[Any]], /, *shared: object
    ) -> tuple[V, ...]:
        """As `each`, for rows of items that are looked at together: `function(*row, *shared)`."""
        return self.kept.each_row(function, columns, *shared)

    def grouped(self, key: Callable[[T], K], tag: Hashable, items: Iterable[T], /) -> Mapping[K, tuple[T, ...]]:
        """The items by their `key`, in order. A group that is as before is the same object. Ask once for each key and
        `tag`."""
        return self.kept.grouped(key, tag, items)

    def indexed(
        self, keys: Callable[[T], tuple[K, ...]], tag: Hashable, items: Iterable[T], /
    ) -> Mapping[K, tuple[T, ...]]:
        """As `grouped`, where an item is in the group of each of its `keys`, which has none twice. Groups that begin
        with the same item are in any order."""
        return self.kept.indexed(keys, tag, items)

    def one(self, function: Callable[P, V], key: Hashable, /, *arguments: P.args, **none: P.kwargs) -> V:
        """As `each`, for the one item that `key` names."""
        return self.kept.get(function, key, *arguments, **none)

    def whole(
        self,
        function: Callable[Concatenate[Before[V] | None, P], V],
        key: Hashable,
        /,
        *arguments: P.args,
        **none: P.kwargs,
    ) -> V:
        """As `one`, for a whole of which a part can be made again: `function` is given what it gave before."""
        return self.kept.patched(function, key, *arguments, **none)

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
        return writer_of(document) if document is not None else None
