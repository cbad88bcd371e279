"""Hover, definition, references and links in the XML files that launch files hand over: robot descriptions and behavior
trees."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from preflight_analysis.documents.span import Location, Span
from preflight_analysis.queries.hover_text import Hover
from preflight_analysis.queries.robot_hover import robot_hover
from preflight_analysis.queries.robot_names import declared_at, files_named, macros_at, name_at, names_of
from preflight_analysis.queries.tree_nodes import tree_files, tree_hover, tree_source, tree_targets
from preflight_analysis.workspace.workspace import Analysis

_SUFFIXES = (".xacro", ".urdf", ".srdf", ".xml")


def is_handed_over(analyses: Sequence[Analysis], file: str) -> bool:
    """Whether it is no launch file of these, but may be XML that they hand over."""
    return file.endswith(_SUFFIXES) and all(file not in analysis.launch_files for analysis in analyses)


def hover_in(analyses: Sequence[Analysis], file: str, offset: int) -> Hover | None:
    """What is known of the name at `offset`."""
    return robot_hover(analyses, file, offset) or tree_hover(analyses, file, offset)


def targets_in(analyses: Sequence[Analysis], file: str, offset: int) -> tuple[Span, tuple[Location, ...]] | None:
    """What is at `offset`, and where it is defined."""
    for span, path in files_named(analyses, file):
        if span.contains(offset):
            return span, (Location.of_file(path),)
    if (macro := macros_at(analyses, file, offset)) is not None:
        return macro
    if (name := name_at(analyses, file, offset)) is not None:
        return name.span, declared_at(name)
    return tree_targets(analyses, file, offset)


def references_in(analyses: Sequence[Analysis], file: str, offset: int) -> dict[Location, bool]:
    """The places that name what is at `offset`, and whether it is declared there."""
    name = name_at(analyses, file, offset)
    found: dict[Location, bool] = {}
    for place, declares in names_of(name) if name is not None else ():
        found[place] = found.get(place, False) or declares
    return found


def links_in(analyses: Sequence[Analysis], file: str) -> Iterator[tuple[Span, str]]:
    """The parts of the file that name other files, each with the path."""
    yield from files_named(analyses, file)
    source = tree_source(analyses, file)
    if source is not None:
        yield from tree_files(source)
