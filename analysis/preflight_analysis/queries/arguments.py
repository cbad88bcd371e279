"""The arguments that can be passed to an included file, and those that are known at a place of a file."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterable, Iterator, Mapping

from preflight_analysis.documents.document import Element, SpannedText
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import Span
from preflight_analysis.evaluation.files import Files
from preflight_analysis.evaluation.tags import scopes_of
from preflight_analysis.generation import ros
from preflight_analysis.launch.model import Action, LaunchFile, Literal, Substitution
from preflight_analysis.launch.substitutions import SubstitutionSyntaxError, find_substitutions
from preflight_analysis.launch.substitutions_ros2 import parse_value_ros2
from preflight_analysis.workspace.facts import ArgDeclaration, declaration
from preflight_analysis.workspace.workspace import Analysis


def accepted(launch_file: LaunchFile) -> tuple[ArgDeclaration, ...]:
    """The arguments that the file takes from outside, required ones first: those declared in a group stay in there
    in ROS 1, those with a `value` cannot be overridden. One that is declared several times (under conditions) counts
    once."""
    found: dict[str, ArgDeclaration] = {}
    number = launch_file.generation
    scopes = scopes_of(number) if ros(number).shared_configurations else frozenset[str]()
    for action in _below(launch_file.root, scopes) if launch_file.root is not None else ():
        if action.kind == "arg" and action.attribute("name") is not None:
            each = declaration(action)
            if each.value is None:
                found.setdefault(each.name, each)
    return tuple(sorted(found.values(), key=lambda each: not each.required))


def _below(scope: Action, scopes: Collection[str]) -> Iterator[Action]:
    for action in scope.children:
        yield action
        if action.kind in scopes:
            yield from _below(action, scopes)


def visible(launch_file: LaunchFile, offset: int) -> tuple[ArgDeclaration, ...]:
    """The arguments that this file declares for a place: first those before it, then those that come too late."""
    found: dict[str, ArgDeclaration] = {}
    scopes = scopes_of(launch_file.generation)
    for action in _visible(launch_file.root, offset, scopes) if launch_file.root is not None else ():
        each = declaration(action)
        found.setdefault(each.name, each)
    return tuple(sorted(found.values(), key=lambda each: each.span.start > offset))


def _visible(scope: Action, offset: int, scopes: frozenset[str]) -> Iterator[Action]:
    for action in scope.children:
        named = action.kind in ("arg", "let") and action.attribute("name") is not None
        if named and not action.span.contains(offset):
            yield action
        elif action.kind in scopes and action.span.contains(offset):
            yield from _visible(action, offset, scopes)


def included_file(analysis: Analysis, files: Files, file: str, include: Element) -> LaunchFile | None:
    """The launch file that an `<include>` names; also where it is not taken, as in a group whose `if` is false."""
    # First what is written: while somebody types, the analysis may be that of another path at the same place.
    written = include.get("file")
    path = resolved(analysis, file, written.value.text) if written is not None else None
    found = _readable(analysis, files, path) if path is not None and os.path.isabs(path) else None
    if found is not None:
        return found
    for taken in analysis.tree.includes:
        place = taken.origin[-1]
        if place.file == file and place.span.start == include.span.start and taken.path is not None:
            return _readable(analysis, files, taken.path)
    return None


def _readable(analysis: Analysis, files: Files, path: str) -> LaunchFile | None:
    path = os.path.normpath(path)
    found = analysis.launch_files.get(path)
    if found is not None:
        return found
    read = files.launch_file(path, analysis.tree.generation)
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
    if analysis.tree.ros.nested_substitutions:
        parsed = parse_value_ros2(SpannedText(text, Span(0, len(text))))
        return _put_together(analysis, file, parsed.parts, args) if parsed.problem is None else None
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


def _put_together(
    analysis: Analysis, file: str, parts: Iterable[Literal | Substitution], args: Mapping[str, str] | None
) -> str | None:
    """Pieces of a value of ROS 2, in which substitutions nest."""
    pieces: list[str | None] = []
    for part in parts:
        if isinstance(part, Literal):
            pieces.append(part.text)
            continue
        words = [_put_together(analysis, file, word, args) for word in part.words]
        known = [word for word in words if word is not None]
        pieces.append(_substituted(analysis, file, [part.command, *known], args) if known == words else None)
    known_pieces = [piece for piece in pieces if piece is not None]
    return "".join(known_pieces) if len(known_pieces) == len(pieces) else None


def _substituted(analysis: Analysis, file: str, words: list[str], args: Mapping[str, str] | None) -> str | None:
    variables = analysis.environment.variables
    match words:
        case ["env" | "optenv", name, *_] if name in analysis.environment.withheld:
            return None
        case ["find" | "find-pkg-share", name]:
            package = analysis.environment.packages.get(name)
            return package.share if package is not None else None
        case ["find-pkg-prefix", name]:
            package = analysis.environment.packages.get(name)
            return package.share.removesuffix(f"/share/{name}") if package is not None else None
        case ["arg", name]:
            return (argument_values(analysis, file) if args is None else args).get(name)
        case ["var", name, *default]:
            known = argument_values(analysis, file) if args is None else args
            return known.get(name, default[0] if default else None)
        case ["env", name, default]:
            return variables.get(name, default)
        case ["env", name]:
            return variables.get(name)
        case ["optenv", name, *default]:
            return variables.get(name, " ".join(default))
        case ["dirname"]:
            return os.path.dirname(file)
    return None
