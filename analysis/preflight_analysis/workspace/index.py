"""The workspace index: which launch files there are, who includes whom with what, and which roots reach a file.

A *root* is a file that nothing includes, or one that the settings name, with arguments. An index is
a snapshot: plain data that is never changed, only replaced.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import field
from functools import cached_property

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location
from preflight_analysis.model.entry import Kind, Mention
from preflight_analysis.workspace.facts import FileFacts
from preflight_analysis.workspace.observations import Observation


@dataclass(frozen=True, slots=True, order=True)
class Root:
    """A launch as somebody would start it: `roslaunch path name:=value ...`."""

    path: str
    args: tuple[tuple[str, str], ...] = ()

    @classmethod
    def of(cls, path: str, args: Mapping[str, str] | None = None) -> Root:
        """The root for arguments in any order."""
        return cls(path, tuple(sorted((args or {}).items())))

    @property
    def label(self) -> str:
        """As one would type it: path and arguments."""
        return " ".join((self.path, *(f"{name}:={value}" for name, value in self.args)))


@dataclass(frozen=True, slots=True)
class Inclusion:
    """An `<include>` of `target`, as evaluated in a root. `place` is the value of its `file`, `tag` its start tag.

    `args` are those it passes, None for a value that is not known. `root` is None for an include that no evaluation
    took: its condition is false wherever it was reached, or nothing reaches it; `args` are empty then.
    """

    target: str
    place: Location
    tag: Location
    args: Mapping[str, str | None]
    root: Root | None

    @property
    def includer(self) -> str:
        """The file that the tag stands in."""
        return self.place.file


@dataclass(frozen=True, slots=True)
class NodeEntry:
    """A node as some root starts it; `location` is its start tag."""

    name: str
    package: str
    executable: str
    location: Location


@dataclass(frozen=True, slots=True)
class RootEntry:
    """What is kept of the evaluation of a root. `inputs` as in `LaunchTree`; `files` are the launch files it reaches,
    itself first."""

    root: Root
    files: tuple[str, ...]
    inputs: Mapping[str, str]
    inclusions: tuple[Inclusion, ...]
    nodes: tuple[NodeEntry, ...]
    unknowns: int = 0
    """How much of it is not known: arguments without a value, names of nodes and files that depend on one, and Python
    launch files that have to be run."""
    observations: tuple[Observation, ...] = field(default=(), compare=False, repr=False)
    """What it was made from."""


@dataclass(frozen=True)
class WorkspaceIndex:
    """What is known of all launch files. `complete` is False while it is still being made."""

    files: Mapping[str, FileFacts] = field(default_factory=dict)
    entries: Mapping[Root, RootEntry] = field(default_factory=dict)
    written: tuple[Inclusion, ...] = ()
    """The includes whose `file` can be told from the text alone, whether some root takes them or not."""
    complete: bool = False

    def with_part(self, part: WorkspaceIndex) -> WorkspaceIndex:
        """What either knows; `part` is of other files."""
        files, entries = {**self.files, **part.files}, {**self.entries, **part.entries}
        return WorkspaceIndex(files, entries, self.written + part.written)

    def roots_of(self, path: str) -> tuple[Root, ...]:
        """The roots that reach a file, those of which most is known first, then those that name it or reach it most
        directly; itself where none does."""
        return self._reaching.get(path) or (Root(path),)

    def roots_reading(self, path: str) -> tuple[Root, ...]:
        """The roots that read a file which is none of their launch files, such as one of parameters; those of which
        most is known first, then the smallest."""
        return self._readers.get(path, ())

    def roots_touching(self, path: str) -> tuple[Root, ...]:
        """The roots that reach or read a file; none where it stands alone."""
        return (*self._reaching.get(path, ()), *self._readers.get(path, ()))

    def includers(self, path: str) -> tuple[Inclusion, ...]:
        """Who includes a file, each place with each set of arguments once."""
        return self._includers.get(path, ())

    def included_from(self, path: str) -> tuple[Inclusion, ...]:
        """What a file includes, in the order of its text."""
        return self._included.get(path, ())

    def mentions(self, kind: Kind, name: str, of: str = "") -> Iterator[tuple[str, Mention]]:
        """Each mention of a name in any launch file, with the file's path."""
        yield from self._mentions.get((kind, name, of), ())

    def nodes(self) -> Iterator[tuple[Root, NodeEntry]]:
        """The nodes of all roots."""
        for root, entry in self.entries.items():
            for node in entry.nodes:
                yield root, node

    @cached_property
    def _reaching(self) -> dict[str, tuple[Root, ...]]:
        found: dict[str, list[tuple[int, int, Root]]] = {}
        for root, entry in self.entries.items():
            for rank, path in enumerate(entry.files):
                found.setdefault(path, []).append((entry.unknowns, rank, root))
        return {path: tuple(root for *_, root in sorted(ranked)) for path, ranked in found.items()}

    @cached_property
    def _readers(self) -> dict[str, tuple[Root, ...]]:
        found: dict[str, list[tuple[int, int, Root]]] = {}
        for root, entry in self.entries.items():
            for path in entry.inputs.keys() - set(entry.files):
                found.setdefault(path, []).append((entry.unknowns, len(entry.files), root))
        return {path: tuple(root for *_, root in sorted(ranked)) for path, ranked in found.items()}

    @cached_property
    def _includers(self) -> dict[str, tuple[Inclusion, ...]]:
        found: dict[str, list[Inclusion]] = {}
        for inclusion in self._inclusions():
            found.setdefault(inclusion.target, []).append(inclusion)
        return {path: tuple(inclusions) for path, inclusions in found.items()}

    @cached_property
    def _included(self) -> dict[str, tuple[Inclusion, ...]]:
        found: dict[str, list[Inclusion]] = {}
        for inclusion in self._inclusions():
            found.setdefault(inclusion.includer, []).append(inclusion)
        return {path: tuple(sorted(i, key=lambda each: each.place.span)) for path, i in found.items()}

    def _inclusions(self) -> Iterator[Inclusion]:
        seen: set[object] = set()
        taken: set[tuple[Location, str]] = set()
        for entry in self.entries.values():
            for inclusion in entry.inclusions:
                key = (inclusion.place, inclusion.target, tuple(sorted(inclusion.args.items())))
                if key not in seen:
                    seen.add(key)
                    taken.add((inclusion.place, inclusion.target))
                    yield inclusion
        for inclusion in self.written:
            if (inclusion.place, inclusion.target) not in taken:
                yield inclusion

    @cached_property
    def _mentions(self) -> dict[tuple[Kind, str, str], list[tuple[str, Mention]]]:
        found: dict[tuple[Kind, str, str], list[tuple[str, Mention]]] = {}
        for path, facts in self.files.items():
            for mention in facts.mentions:
                kind, name, _, of, _ = mention.entry
                found.setdefault((kind, name, of), []).append((path, mention))
        return found
