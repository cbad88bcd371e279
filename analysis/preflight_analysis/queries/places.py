"""What stands at an offset: the tag, the use of a name, the nodes and parameters that came of it."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from preflight_analysis.catalogue.launches import catalogued_file
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.evaluation.tree import Include, LaunchNode, LaunchTree, Param, Remap, Use
from preflight_analysis.findings.markdown import code, escaped
from preflight_analysis.launch.model import Action, LaunchFile
from preflight_analysis.launch.model import action_at as action_at  # noqa: PLC0414 - it belongs to what stands at an offset
from preflight_analysis.workspace.workspace import Analysis


class Passed(NamedTuple):
    """What an action of a program is given by an expression: where that is, and where the value is written."""

    span: Span
    written: int


def passed_at(launch_file: LaunchFile | None, offset: int) -> Passed | None:
    """What the expression at `offset` gives, if that is written elsewhere: it is a variable, or made of some."""
    found = _passed(launch_file, offset)
    return found if found is not None and _passed(launch_file, found.written) is None else None


def _passed(launch_file: LaunchFile | None, offset: int) -> Passed | None:
    if launch_file is None or launch_file.root is None or not launch_file.is_python:
        return None
    around = (
        attribute
        for action in launch_file.root.walk()
        for attribute in action.attributes
        if attribute.span.contains(offset)
        and (attribute.name_span == attribute.span or not attribute.name_span.contains(offset))
    )
    found = min(around, key=lambda each: each.span.end - each.span.start, default=None)
    if found is None:
        return None
    written = found.value.span.start
    is_here = found.span.start <= written <= found.span.end
    return None if is_here else Passed(Span(offset, found.span.end), written)


def use_at(tree: LaunchTree, file: str, offset: int) -> Use | None:
    """The innermost use of a name at `offset`, in the first context in which its value is known."""
    return next(iter(uses_at(tree, file, offset)), None)


def uses_at(tree: LaunchTree, file: str, offset: int) -> list[Use]:
    """The uses of a name at `offset`, the innermost first, those whose value is known before others."""
    found = [u for u in tree.uses if u.location.file == file and u.location.span.contains(offset)]
    return sorted(found, key=_innermost_known)


def _innermost_known(use: Use) -> tuple[int, bool, bool]:
    return use.location.span.end - use.location.span.start, use.kind == "value", use.value is None


def nodes_of(analysis: Analysis, file: str, action: Action) -> Iterator[tuple[int, LaunchNode]]:
    """The nodes that a tag makes, with their index in the tree: several where its file is included several times."""
    for index, node in enumerate(analysis.tree.nodes):
        if node.location.file == file and node.action.span == action.span:
            yield index, node


def nodes_around(tree: LaunchTree, file: str, offset: int) -> Iterator[LaunchNode]:
    """The nodes whose tags are around an offset: several where their file is included several times."""
    return (node for node in tree.nodes if node.location.file == file and node.action.span.contains(offset))


def include_of(tree: LaunchTree, file: str, action: Action) -> Include | None:
    """The include that was taken at a tag."""
    return next((i for i in tree.includes if _within(i.origin[-1], file, action.span)), None)


def params_of(tree: LaunchTree, file: str, action: Action) -> Iterator[Param]:
    """The parameters that a tag sets, overridden ones left out."""
    for param in (*tree.params.values(), *(param for node in tree.nodes for param in node.params)):
        if param.origin and any(_within(step, file, action.span) for step in param.origin):
            yield param


def remaps_of(tree: LaunchTree, file: str, action: Action) -> Iterator[tuple[LaunchNode, Remap]]:
    """The nodes that a `<remap>` tag reaches."""
    for node in tree.nodes:
        for remap in node.remaps:
            if remap.origin and _within(remap.origin[-1], file, action.span):
                yield node, remap


def _within(location: Location, file: str, span: Span) -> bool:
    return location.file == file and span.start <= location.span.start and location.span.end <= span.end


def line_of(analysis: Analysis, location: Location) -> int | None:
    """The line of a location, counted from 1; None in a file that is not an analysed document."""
    document = analysis.documents.get(location.file)
    return document.lines.position(location.span.start)[0] + 1 if document else None


def shown_path(path: str, folder: str | None) -> str:
    """A path as the user knows it: below the workspace's folder where it is in there."""
    if (catalogued := catalogued_file(path)) is not None:
        return catalogued.label
    return os.path.relpath(path, folder) if folder and path.startswith(folder.rstrip("/") + "/") else path


def link(file: str, line: int | None) -> str:
    """A place as a Markdown link that says file and line."""
    path = Path(file)
    if not path.is_absolute():
        return code(file if line is None else f"{file}:{line}")
    if line is None:
        return f"[{escaped(path.name)}]({path.as_uri()})"
    return f"[{escaped(path.name)}:{line}]({path.as_uri()}#L{line})"


def place(analysis: Analysis, location: Location) -> str:
    """A location as a Markdown link."""
    return link(location.file, line_of(analysis, location))
