"""A fixture with `$0` in one of its files, analysed, for the queries of an editor: see `support.check` for the form.

Executables are those that `executables` gives; the interfaces come from `//- interfaces` or annotations.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Span
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.graph.annotations import read_annotation
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Analysis, Workspace

from support.check import environment_of, interfaces_of, read_fixture

CURSOR = "$0"


@dataclass(frozen=True)
class Executables:
    """Stands for an index of what is on the disk."""

    by_package: Mapping[str, Sequence[str]] = field(default_factory=dict)

    def names(self, package: str) -> tuple[str, ...]:
        return tuple(self.by_package.get(package, ()))

    def names_are_all(self, package: str) -> bool:
        return True

    def is_build_target(self, package: str, name: str) -> bool:
        return False

    def is_in_build_file(self, package: str, name: str) -> bool:
        return False

    def is_library_target(self, package: str, name: str) -> bool:
        return False

    def made_of(self, package: str, name: str) -> None:
        return None


@dataclass(frozen=True)
class AtCursor:
    """A cursor in an analysed file."""

    analysis: Analysis
    file: str
    offset: int
    sources: Sources
    ahead_of_runs: Callable[[Analysis], Analysis]
    evaluate: Callable[[Mapping[str, str]], LaunchTree]
    """The root with other arguments."""

    @property
    def document(self) -> Document:
        return self.analysis.documents[self.file]

    @property
    def launch_file(self) -> LaunchFile:
        return self.analysis.launch_files[self.file]

    def text(self, span: Span) -> str:
        return self.document.text[span.start : span.end]


def at_cursor(text: str, variables: Mapping[str, str] | None = None, sources: Sources | None = None) -> AtCursor:
    """The first file of the fixture is the root; without a `$0` the cursor is at its start. `sources` are those of
    fixtures before this one, whose files it replaces."""
    fixture = read_fixture(text)
    file = next((path for path, content in fixture.files.items() if CURSOR in content), fixture.root)
    offset = max(0, fixture.files[file].find(CURSOR))
    sources = sources or Sources()
    for path, content in fixture.files.items():
        sources.open(path, content.replace(CURSOR, ""))
    environment = replace(environment_of(fixture), variables=variables or {}, workspace="/")
    workspace = Workspace(environment, sources, "/")
    analysis = workspace.static(fixture.root)
    annotated = any(read_annotation(node.action)[0] for node in analysis.tree.nodes)
    if fixture.interfaces is not None or annotated:
        interfaces = interfaces_of(analysis.tree, fixture.interfaces or {})
        analysis = workspace.with_interfaces(analysis, interfaces, None)

    def evaluate(args: Mapping[str, str]) -> LaunchTree:
        return workspace.evaluated(fixture.root, args).tree

    return AtCursor(analysis, file, offset, sources, lambda each: each, evaluate)
