"""The arguments that can be passed to an included file, and those that are known at a place of a file."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping

from preflight_analysis.documents.document import Element
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.evaluation.files import Files
from preflight_analysis.launch.model import Action, LaunchFile
from preflight_analysis.launch.substitutions import SubstitutionSyntaxError, find_substitutions
from preflight_analysis.workspace.facts import ArgDeclaration, declaration
from preflight_analysis.workspace.workspace import Analysis


def accepted(launch_file: LaunchFile) -> tuple[ArgDeclaration, ...]:
    """The arguments that the file takes from outside, required ones first: those declared in a group stay in there,
    those with a `value` cannot be overridden. One that is declared several times (under conditions) counts once."""
    found: dict[str, ArgDeclaration] = {}
    for action in launch_file.root.children if launch_file.root is not None else ():
        if action.kind == "arg" and action.attribute("name") is not None:
            each = declaration(action)
            if each.value is None:
                found.setdefault(each.name, each)
    return tuple(sorted(found.values(), key=lambda each: not each.required))


def visible(launch_file: LaunchFile, offset: int) -> tuple[ArgDeclaration, ...]:
    """The arguments that this file declares for a place: first those before it, then those that come too late."""
    found: dict[str, ArgDeclaration] = {}
    for action in _visible(launch_file.root, offset) if launch_file.root is not None else ():
        each = declaration(action)
        found.setdefault(each.name, each)
    return tuple(sorted(found.values(), key=lambda each: each.span.start > offset))


def _visible(scope: Action, offset: int) -> Iterator[Action]:
    for action in scope.children:
        if action.kind == "arg" and action.attribute("name") is not None and not action.span.contains(offset):
            yield action
        elif action.kind == "group" and action.span.contains(offset):
            yield from _visible(action, offset)


def included_file(analysis: Analysis, files: Files, file: str, include: Element) -> LaunchFile | None:
    """The launch file that an `<include>` names; also where it is not taken, as in a group whose `if` is false."""
    for taken in analysis.tree.includes:
        place = taken.origin[-1]
        if place.file == file and place.span.start == include.span.start and taken.path is not None:
            return _readable(analysis, files, taken.path)
    written = include.get("file")
    path = resolved(analysis, file, written.value.text) if written is not None else None
    return _readable(analysis, files, path) if path is not None and os.path.isabs(path) else None


def _readable(analysis: Analysis, files: Files, path: str) -> LaunchFile | None:
    path = os.path.normpath(path)
    found = analysis.launch_files.get(path)
    if found is not None:
        return found
    read = files.launch_file(path)
    return None if isinstance(read, Unreadable) else read


def argument_values(analysis: Analysis, file: str) -> Mapping[str, str]:
    """The values of the file's arguments in the first context in which they are known."""
    found: dict[str, str] = {}
    for use in analysis.tree.uses:
        if use.kind == "declaration" and use.location.file == file and use.value is not None:
            found.setdefault(use.name, use.value)
    return found


def resolved(analysis: Analysis, file: str, text: str, args: Mapping[str, str] | None = None) -> str | None:
    """What a text of the file comes to, by its syntax alone: also where it is not, or not yet, evaluated.

    None where something in it is not known; expressions are not looked at. `args` are the file's `argument_values`,
    for who has them at hand.
    """
    if "$" not in text:
        return text
    pieces: list[str] = []
    at = 0
    try:
        for start, end in find_substitutions(text):
            value = _substituted(analysis, file, text[start + 2 : end - 1].split(), args)
            if value is None:
                return None
            pieces += (text[at:start], value)
            at = end
    except SubstitutionSyntaxError:
        return None
    return "".join((*pieces, text[at:]))


def _substituted(analysis: Analysis, file: str, words: list[str], args: Mapping[str, str] | None) -> str | None:
    variables = analysis.environment.variables
    match words:
        case ["find", name]:
            package = analysis.environment.packages.get(name)
            return package.share if package is not None else None
        case ["arg", name]:
            return (argument_values(analysis, file) if args is None else args).get(name)
        case ["env", name]:
            return variables.get(name)
        case ["optenv", name, *default]:
            return variables.get(name, " ".join(default))
        case ["dirname"]:
            return os.path.dirname(file)
    return None
