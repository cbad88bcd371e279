"""`<include>`: `IncludeLaunchDescription`, of a file or of a launch description as it is."""

from __future__ import annotations

import os
import re
from functools import lru_cache

from preflight_analysis.documents.reading import Text, Unreadable
from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.files import Files, without_dots
from preflight_analysis.evaluation.problems import (
    IncludeCycle,
    UnknownIncludeArgument,
)
from preflight_analysis.evaluation.resolved import Resolved
from preflight_analysis.evaluation.ros2.declared import PASSED
from preflight_analysis.evaluation.ros2.entity import Part, action_tag
from preflight_analysis.evaluation.ros2.missing_packages import named_in_catalogue
from preflight_analysis.evaluation.ros2.place import Place
from preflight_analysis.evaluation.ros2.python_runs import calls_own_code
from preflight_analysis.evaluation.ros2.required import check_required
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.walk import LaunchAction, Walk
from preflight_analysis.evaluation.tree import Include, Use
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.launch.configurations import IMPLICIT, Names, configurations_of, names_in_code
from preflight_analysis.launch.model import Action, LaunchFile, Substitution, Value
from preflight_analysis.launch.read import read_launch
from preflight_analysis.launch.references import first_word
from preflight_analysis.launch.schema import Attribute
from preflight_analysis.launch.substitutions_ros2 import nested

_FILLED_IN = re.compile(r"@[A-Za-z_]\w*@")

_OF_ARGUMENTS = frozenset({"var", "dirname", "path-join"})
_OF_PACKAGE = "find-pkg-share"


def evaluate(walk: Walk, performer: Performer, action: Action) -> None:
    """What it passes, and what the file sets, stays set after it."""
    state, context, place = walk.state, walk.context, performer.place
    attribute = action.attribute("file")
    if attribute is None:
        return
    file = performer.value(attribute.value)
    origin = place.origin(action.head_span)
    at = place.location(attribute.value.span)
    passed = _passed(performer, action)
    path = _path(walk, performer, attribute.value, file)
    if path is None:
        walk.names[-1] = None
        context.cannot_follow(at)
        state.include(Include(None, origin, at, _not_read(performer, passed)))
        state.note_unknown("<include>", "its file is not known", at)
        return
    shown: dict[str, str | None] = {}
    state.include(Include(path, origin, at, shown))
    state.uses.append(Use("include", at, file.text, path, Location.of_file(path)))
    if walk.too_deep(place, action):
        return
    found = _read(walk, place, path, at)
    if found is None:
        shown.update(_not_read(performer, passed))
        walk.names[-1] = None
        context.cannot_follow(at)
        return
    context.launch_file = path
    found, run = walk.as_run(found, origin)
    check_required(walk, found, [name for name, _ in passed], (*place.chain, at))
    for name, child in passed:
        value = child.value("value")
        result = performer.value(value) if value is not None else Resolved("", False)
        shown[name] = result.text if result.known else None
        _note(performer, child, name, shown[name])
        context.set(name, result, place.origin(value.span if value is not None else child.kind_span))
    below = walk.file_below(Place(path, found.document.lines, origin, run, found.partial), found)
    if found.partial or found.document.problems:
        context.cannot_follow(at)
    if below is not None:
        _report_unused(walk, place, path, passed, below)


def _path(walk: Walk, performer: Performer, value: Value, file: Resolved) -> str | None:
    """The file that an include names; that of the catalogue where its package is not here."""
    state, place = walk.state, performer.place
    if not file.known:
        named = named_in_catalogue(state, walk.context, place, value)
        return state.of_catalogue(named, place.origin(value.span))
    path = os.path.normpath(os.path.join(state.cwd, file.text))
    return state.located(without_dots(state.files, path) or path)


def evaluate_inline(walk: Walk, performer: Performer, action: Action) -> None:
    """A launch description as an action, or included without a file."""
    for name, child in _passed(performer, action):
        value = child.value("value")
        result = performer.value(value) if value is not None else Resolved("", False)
        _note(performer, child, name, result.text if result.known else None)
        if value is not None:
            walk.context.set(name, result, performer.place.origin(value.span))
    if not walk.too_deep(performer.place, action):
        walk.inside(performer.place, action.children)


def _report_unused(walk: Walk, place: Place, path: str, passed: list[tuple[str, Action]], names: Names) -> None:
    """An argument that neither the file nor what it includes has to do with: launch accepts it without a word. The
    includer itself may use it later, as what an include sets stays set."""
    unused = [(name, child) for name, child in passed if not names.may_have(name) and name not in IMPLICIT]
    if not unused:
        return
    own = walk.recorded.get(place.file)
    used = _used(walk.state.files.db, walk.state.files, place.file) if own is None else _used_in(own)
    for name, child in unused:
        if used is not None and not used.may_have(name):
            value = child.value("name")
            span = value.span if value is not None else child.kind_span
            kind = UnknownIncludeArgument(name, tuple(sorted(names.known)), path)
            walk.state.problem(kind, place.origin(span), fatal=False)


@query
def _used(db: Database, files: Files, path: str) -> Names | None:
    """As `_used_in`: an edit of the file leaves it alone mostly."""
    found = files.launch_file(path, 2)
    return Names() if isinstance(found, Unreadable) else _used_in(found)


def _used_in(launch_file: LaunchFile) -> Names | None:
    """The configurations that a file uses, None where that cannot be told."""
    in_code = names_in_code(launch_file) if calls_own_code(launch_file) else frozenset()
    is_told = not (launch_file.partial or in_code is None)
    return Names(configurations_of(launch_file).used, in_code or frozenset()) if is_told else None


def _passed(performer: Performer, action: Action) -> list[tuple[str, Action]]:
    """The arguments of an include, by the names that they have."""
    given = (child for child in action.children if child.kind == PASSED[action.kind])
    return [(performer.value(name).text, child) for child in given if (name := child.value("name")) is not None]


def _not_read(performer: Performer, passed: list[tuple[str, Action]]) -> dict[str, str | None]:
    """Arguments of a file that is not read: of their values those are performed that need nothing but arguments and
    packages that are here."""
    given: dict[str, str | None] = {}
    for name, child in passed:
        value = child.value("value")
        plain = value is not None and all(_is_plain(performer, part) for part in nested(value.parts))
        result = performer.value(value) if value is not None and plain else None
        given[name] = result.text if result is not None and result.known else None
        _note(performer, child, name, given[name])
    return given


def _is_plain(performer: Performer, part: Substitution) -> bool:
    if part.command == _OF_PACKAGE:
        return first_word(part)[0] in performer.state.environment.packages
    return part.command in _OF_ARGUMENTS


def _note(performer: Performer, child: Action, name: str, value: str | None) -> None:
    """An argument that is passed, for hover."""
    written = child.value("name")
    if written is not None:
        performer.state.uses.append(Use("argument", performer.place.location(written.span), name, value))


def _read(walk: Walk, place: Place, path: str, at: Location) -> LaunchFile | None:
    """The included file; what is wrong with it is noted."""
    state, origin = walk.state, (*place.chain, at)
    chain = [location.file for location in place.chain]
    if path in (place.file, *chain):
        state.problem(IncludeCycle(path, (*chain, place.file)), origin)
        return None
    found = state.read_launch_file(path)
    if isinstance(found, Unreadable) and found.kind == "missing":
        found = _configured(walk, path) or found
    if not isinstance(found, Unreadable):
        return found
    state.unreadable_include(path, found, origin)
    return None


def _configured(walk: Walk, path: str) -> LaunchFile | None:
    """A file that CMake makes of one with `.in` behind its name: that, with 0 for what the build fills in."""
    template = walk.state.read_text(path + ".in")
    if isinstance(template, Unreadable):
        return None
    names = sorted(set(_FILLED_IN.findall(template.text)))
    if names:
        at = Location.of_file(path + ".in")
        walk.state.note_unknown(", ".join(names), "the build fills it in", at)
    return read_launch(_filled_in(path, template.text), 2)


@lru_cache(maxsize=64)
def _filled_in(path: str, template: str) -> Text:
    """What the build makes of a template; one text for one template, so that its places are the same each time."""
    return Text.of(path, _FILLED_IN.sub("0", template))


ENTITIES = (
    LaunchAction(
        kind="include",
        tag=action_tag(
            "Executes another launch file. What it sets stays set after it.",
            Attribute("file", "The launch file.", "launch-file", required=True),
            children=("arg",),
            named_by=("file",),
            starts=True,
        ),
        evaluate=evaluate,
        offered=20,
        configures=True,
        is_part=True,
    ),
    LaunchAction(
        kind="inline",
        tag=None,
        evaluate=evaluate_inline,
        holds_actions=True,
        configures=True,
    ),
    Part(kind="arg_passed", tag=None, of=("inline",)),
)
