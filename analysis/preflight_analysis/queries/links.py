"""The places of a file that name other files, to be followed with a click."""

from __future__ import annotations

import functools
import os
import re
from collections.abc import Callable, Iterator

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.python_text import is_python
from preflight_analysis.documents.span import Span
from preflight_analysis.launch.model import LaunchFile, Value
from preflight_analysis.queries.arguments import argument_values, resolved
from preflight_analysis.queries.cursor_python import written_paths
from preflight_analysis.queries.handed_over import is_handed_over, links_in
from preflight_analysis.workspace.workspace import Analysis

_NAMED_FILES = ("include", "file")
_WORD = re.compile(r"(?:\$\([^()]*\)|[^\s$=,;'\"]|\$(?!\())+")
_STARTS_PATH = re.compile(r"\$\((?:find|find-pkg-share|find-pkg-prefix|dirname|arg|var|env|optenv)\b|/")


@dataclass(frozen=True, slots=True)
class Link:
    """A part of a file and the path of the file that it names."""

    span: Span
    path: str


def links(analysis: Analysis, file: str, exists: Callable[[str], bool] = os.path.isfile) -> tuple[Link, ...]:
    """The files that the evaluation read by name, and what looks like a path in any other value and names a file. In
    Python, where a path is put together in many ways, it is the last piece of it that leads there."""
    exists = functools.cache(exists)
    if is_handed_over([analysis], file):
        return tuple(Link(span, path) for span, path in links_in([analysis], file) if exists(path))
    document = analysis.documents.get(file)
    if is_python(file, document.text if document is not None else ""):
        return tuple(_of_python(analysis, file, document.text, exists)) if document is not None else ()
    found: dict[Span, Link] = {}
    for use in analysis.tree.uses:
        if use.kind not in _NAMED_FILES or use.location.file != file or use.target is None:
            continue
        if use.location.span not in found and exists(use.target.file):
            found[use.location.span] = Link(use.location.span, use.target.file)
    launch_file = analysis.launch_files.get(file)
    args = argument_values(analysis, file)
    for value in _values(launch_file) if launch_file is not None else ():
        if value.span not in found:
            for word, span in _paths(value):
                path = resolved(analysis, file, word, args)
                if path is not None and os.path.isabs(path) and exists(path):
                    found[span] = Link(span, os.path.normpath(path))
    return tuple(sorted(found.values(), key=lambda link: link.span))


def _of_python(analysis: Analysis, file: str, text: str, exists: Callable[[str], bool]) -> Iterator[Link]:
    args = argument_values(analysis, file)
    for span, written in written_paths(text):
        path = resolved(analysis, file, written, args)
        if path is not None and os.path.isabs(path) and exists(path):
            yield Link(span, os.path.normpath(path))


def _values(launch_file: LaunchFile) -> Iterator[Value]:
    for action in launch_file.root.walk() if launch_file.root is not None else ():
        for attribute in action.attributes:
            if "/" in attribute.value.text:
                yield attribute.value


def _paths(value: Value) -> Iterator[tuple[str, Span]]:
    """The words of a value (an `args` may name several files) that look like paths."""
    if value.span.end - value.span.start != len(value.text):
        return  # with entities in it, places in the text are not those in the file
    for word in _WORD.finditer(value.text):
        if "/" in word[0] and _STARTS_PATH.match(word[0]):
            yield word[0], Span(value.span.start + word.start(), value.span.start + word.end())
