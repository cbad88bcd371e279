"""What accumulates while a launch file of either generation is evaluated, and what it is read from."""

from __future__ import annotations

import shlex
from collections.abc import Mapping
from collections.abc import Set as AbstractSet
from dataclasses import replace
from typing import TypeVar

from preflight_analysis.catalogue.launches import CataloguedFile, catalogued_file
from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import Location, Origin, Span
from preflight_analysis.environment.installed_paths import located
from preflight_analysis.evaluation.catalogued import data_of
from preflight_analysis.evaluation.commands import named_paths
from preflight_analysis.evaluation.files import without_dots
from preflight_analysis.evaluation.problems import (
    IncludeNotCatalogued,
    IncludeNotFound,
    NotTextFile,
    Problem,
    UnreadableFile,
    UnreadableInclude,
    UnreadablePath,
    ValueTooLong,
    WithheldFile,
    WithheldVariable,
)
from preflight_analysis.evaluation.surroundings import Surroundings
from preflight_analysis.evaluation.tree import (
    Arg,
    Command,
    Edited,
    Include,
    LaunchNode,
    NotTaken,
    StateChange,
    Unknown,
    Use,
)
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.problems import ProblemKind

T = TypeVar("T")
MAX_TEXT = 8_000_000
"""Characters of one value that substitutions make. A robot description has a hundredth; values that hold others twice,
and so on, have no end."""
MAX_TEXTS = 128_000_000
"""Of all such values together."""


@dataclass(frozen=True, slots=True, eq=False)
class Collected:
    """What a part of a launch adds to it: an include, say, or the tag of a node."""

    nodes: tuple[LaunchNode, ...]
    includes: tuple[Include, ...]
    commands: tuple[Command, ...]
    uses: tuple[Use, ...]
    problems: tuple[Problem[ProblemKind], ...]
    unknowns: tuple[Unknown, ...]
    not_taken: tuple[NotTaken, ...]
    state_changes: tuple[StateChange, ...]
    visited: tuple[str, ...]
    inputs: Mapping[str, str]
    """The files that were read, with their digests."""

    def taking_over(self, before: Collected) -> Collected:
        """The same with nodes and uses of what it was before, where they are equal."""
        nodes, uses = _taking_over(self.nodes, before.nodes), _taking_over(self.uses, before.uses)
        return replace(self, nodes=nodes, uses=uses)


def _taking_over(items: tuple[T, ...], before: tuple[T, ...]) -> tuple[T, ...]:
    if len(items) != len(before):
        return items
    return tuple([known if known == item else item for item, known in zip(items, before, strict=True)])


class Collector:
    """The growing result, and what everything is read from."""

    def __init__(
        self,
        generation: int,
        within: Surroundings,
        *,
        by_parts: bool = False,
        assumed: AbstractSet[Location] = frozenset(),
    ) -> None:
        self.generation = generation
        self._assumed = assumed
        self.within = within
        self.files, self.executables, self.results = within.files, within.executables, within.commands
        self.environment, self.cwd = within.environment, within.cwd
        self.by_parts = by_parts
        """Whether parts of the launch are remembered; else they are evaluated where they are."""
        self.nodes: list[LaunchNode] = []
        self.includes: list[Include] = []
        self.args: dict[str, Arg] = {}
        self.commands: list[Command] = []
        self.uses: list[Use] = []
        self.problems: list[Problem[ProblemKind]] = []
        self.unknowns: list[Unknown] = []
        self.not_taken: list[NotTaken] = []
        self.state_changes: list[StateChange] = []
        self.visited: dict[str, None] = {}
        """The launch files, in the order in which they were reached."""
        self.inputs: dict[str, str] = {}
        self.made: dict[str, Document] = {}
        """Texts that a run of a launch file wrote, by path: they are gone from the disk."""
        self.edited: dict[str, Edited] = {}
        self._room = [MAX_TEXTS]
        self._digests: dict[str, str] = {}
        self._anonymous: dict[str, int] = {}
        self._reported: set[tuple[type[ProblemKind], Origin, object]] = set()

    def collected(self) -> Collected:
        """All that was added."""
        return Collected(
            tuple(self.nodes),
            tuple(self.includes),
            tuple(self.commands),
            tuple(self.uses),
            tuple(self.problems),
            tuple(self.unknowns),
            tuple(self.not_taken),
            tuple(self.state_changes),
            tuple(self.visited),
            self.inputs,
        )

    def add(self, collected: Collected) -> None:
        """Add what a part has added for itself."""
        self.nodes += collected.nodes
        self.includes += collected.includes
        self.commands += collected.commands
        self.uses += collected.uses
        self.unknowns += collected.unknowns
        self.not_taken += collected.not_taken
        self.state_changes += collected.state_changes
        for problem in collected.problems:
            self._add(problem)
        for path in collected.visited:
            self.visited.setdefault(path)
        self.inputs.update(collected.inputs)

    def digest(self, path: str) -> str:
        """Names the content of a file, which is looked up once."""
        found = self._digests.get(path)
        if found is None:
            found = self._digests[path] = self.files.digest(path)
        return found

    def located(self, path: str) -> str:
        """The file that a path in the share folder of a package leads to, built or not."""
        return located(self.files, self.environment, path)

    def problem(self, kind: ProblemKind, origin: Origin, *, fatal: bool | None = None) -> None:
        """Note a problem; the same one at the same place once."""
        self._add(Problem(kind, origin, kind.usually_fatal if fatal is None else fatal))

    def _add(self, problem: Problem[ProblemKind]) -> None:
        if catalogued_file(problem.location.file) is not None:
            return  # nobody can mend it there
        key = (type(problem.kind), problem.origin, problem.kind.subject)
        if key not in self._reported:
            self._reported.add(key)
            self.problems.append(problem)

    def unreadable_root(self, path: str, found: Unreadable) -> None:
        """Note that there is nothing to evaluate."""
        kind = NotTextFile if found.kind == "not-text" else UnreadableFile
        self.problem(kind(path, found.reason), (Location.of_file(path),))

    def unreadable_include(self, path: str, found: Unreadable, origin: Origin) -> None:
        """Note that an included file cannot be read, and so that what it holds is not known."""
        self.unreadable_file(path, found, IncludeNotFound, UnreadableInclude, origin)
        self.note_unknown("<include>", f"{path} {found.reason}", origin[-1])

    def unreadable_file(
        self,
        path: str,
        found: Unreadable,
        missing: type[UnreadablePath],
        otherwise: type[UnreadablePath],
        origin: Origin,
        *,
        fatal: bool | None = None,
    ) -> None:
        """Note why a file has no text: it is `missing`, or not to be read."""
        kind = {"missing": missing, "withheld": WithheldFile}.get(found.kind, otherwise)
        self.problem(kind(path, found.reason), origin, fatal=None if kind is WithheldFile else fatal)

    def withholds_files_of(self, line: str, origin: Origin) -> str | None:
        """Why a command is not run that names a file which is not read, as is noted; None where it names none."""
        for path in named_paths(shlex.split(line)[1:], self.cwd):
            found = self.files.text(path) if self.files.is_file(path) else None
            if isinstance(found, Unreadable) and found.kind == "withheld":
                self.problem(WithheldFile(path, found.reason), origin)
                return f"its command names the file {path}, which {found.reason}"
        return None

    def withheld_variable(self, text: str, name: str, origin: Origin) -> None:
        """Note that the value of a variable is not read, and so that of `text` is not known."""
        self.problem(WithheldVariable(name), origin)
        self.note_unknown(text, f"environment variable '{name}' is a secret", origin[-1])

    def of_catalogue(self, file: CataloguedFile | None, origin: Origin) -> str | None:
        """The path of the data of a launch file of a package that is not here; None, with a note, where the catalogue
        has others of that package alone."""
        path = data_of(file) if file is not None else None
        if file is not None and path is None:
            self.problem(IncludeNotCatalogued(*file), origin)
        return path

    def has_room(self, length: int, origin: Origin) -> bool:
        """Whether a value may be put together that is so long; if not, that is noted."""
        if length <= MAX_TEXT and length <= self._room[0]:
            self._room[0] -= length
            return True
        self.problem(ValueTooLong(f"{MAX_TEXT} characters"), origin)
        return False

    def is_assumed(self, tag: Location) -> bool:
        """Whether a tag is taken, whatever its condition says."""
        return tag in self._assumed

    def note_unknown(
        self, what: str, reason: str, location: Location, param: str | None = None, *, decides: bool = False
    ) -> None:
        """Note a value that cannot be known, of the parameter `param` if it is one's; `decides`: of which a program
        makes depend what it does."""
        self.unknowns.append(Unknown(what, reason, location, param, decides))

    def note_branch(self, condition: str, location: Location, covers: tuple[Location, ...]) -> None:
        """Note the actions that a program makes only if `condition` is as it says, which is not known."""
        self.unknowns.append(Unknown(condition, "the actions here depend on it", location, covers=covers))

    def anonymous_name(self, identifier: str) -> str:
        """A fresh name for `$(anon identifier)`, numbered in the order of evaluation."""
        count = self._anonymous[identifier] = self._anonymous.get(identifier, 0) + 1
        return f"{identifier}_ANON{count}"

    def read_launch_file(self, path: str) -> LaunchFile | Unreadable:
        """A launch file, noted as an input."""
        self.inputs[path] = self.digest(path)
        return self.files.launch_file(path, self.generation)

    def location(self, path: str, span: Span) -> Location:
        """A place in a launch file that was read."""
        found = self.files.launch_file(path, self.generation)
        return Location.of_file(path) if isinstance(found, Unreadable) else found.document.location(span)

    def text_made(self, path: str) -> Document | None:
        """The text that a run of a launch file wrote there."""
        return self.made.get(path)

    def is_edited(self, path: str) -> bool:
        """Whether a Python launch file stands as its last good run told it."""
        return path in self.edited

    def read_text(self, path: str) -> Document | Unreadable:
        """A text file, noted as an input."""
        if (made := self.text_made(path)) is not None:
            return made
        real = without_dots(self.files, path)
        if real is None:
            return Unreadable(path, "does not exist", "missing")
        self.inputs[real] = self.digest(real)
        return self.files.text(real)

    def read_data(self, path: str) -> bytes | Unreadable:
        """The bytes of a file, noted as an input."""
        real = without_dots(self.files, path)
        if real is None:
            return Unreadable(path, "does not exist", "missing")
        self.inputs[real] = self.digest(real)
        return self.files.data(real)
