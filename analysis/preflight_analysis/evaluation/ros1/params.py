"""`<param>` and `<rosparam>`: what the parameter server would be told (http://wiki.ros.org/roslaunch/XML/param)."""

from __future__ import annotations

import os
import shlex
from dataclasses import replace
from functools import lru_cache
from typing import Any, NamedTuple

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document, SpannedText
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import LineIndex, Location, Origin, Span
from preflight_analysis.evaluation import names, values
from preflight_analysis.evaluation.catalogued import with_described_shares
from preflight_analysis.evaluation.problems import (
    BadYaml,
    CommandFailed,
    CommandMissing,
    CommandNotRun,
    MalformedCommand,
    ParameterFileNotFound,
    UnreadableParameterFile,
    YamlKeyTwice,
)
from preflight_analysis.evaluation.resolved import Resolved
from preflight_analysis.evaluation.ros1.attributes import Attributes, applies
from preflight_analysis.evaluation.ros1.parts import remembered, within_parameters
from preflight_analysis.evaluation.ros1.scope import Scope
from preflight_analysis.evaluation.ros1.state import State
from preflight_analysis.evaluation.ros1.substitute import resolve
from preflight_analysis.evaluation.tree import Command, CommandValue, Param, Use
from preflight_analysis.evaluation.yaml_params import YamlError, YamlValue, load_yaml
from preflight_analysis.launch.model import Action
from preflight_analysis.launch.problems import ConflictingAttributes, MissingAttribute
from preflight_analysis.launch.substitutions import parse_value

SOURCES = ("value", "textfile", "binfile", "command")


def evaluate_param(state: State, scope: Scope, action: Action, *, node: str | None = None) -> None:
    """A `<param>`: a global one is set, a private one (or any in a node) kept in the scope for the nodes to come."""
    if not applies(state, scope, action):
        return
    attributes = Attributes(state, scope, action)
    given = [source for source in SOURCES if attributes.get(source) is not None]
    if len(given) != 1:
        kind = ConflictingAttributes("param", tuple(given)) if given else MissingAttribute("param", SOURCES)
        state.problem(kind, scope.origin(action.kind_span))
        return
    attributes.strip("name")
    found = attributes.require("name")
    if found is None:
        return
    name = names.canonicalize(found[0].text)
    name_attribute = action.attribute("name")
    location = scope.location(name_attribute.value.span) if name_attribute else None
    full = names.join(node, name.removeprefix("~")) if node is not None else name
    value = _value(state, scope, action, attributes, given[0], full)
    if isinstance(value, _NoValue):
        state.unknown(f"parameter {name}", value.reason, scope, action.kind_span, _full_name(scope, full))
        return
    origin = scope.origin(action.head_span)
    if node is not None or names.is_private(name):
        scope.add_private(Param(name, value, origin, node, location))
    else:
        state.set_param(Param(names.canonicalize(names.join(scope.ns, name)), value, origin, None, location))


@dataclass(frozen=True, slots=True)
class _NoValue:
    reason: str


def _value(state: State, scope: Scope, action: Action, attributes: Attributes, source: str, param: str) -> Any:
    given = attributes.get(source)
    if given is not None and not given.known and source == "command":
        line = with_described_shares(given.text, state.environment.generation, state.environment)
        given = Resolved(line) if line is not None else None
    if given is None or not given.known:
        return _NoValue("its value is not known")
    type_attribute = action.value("type")
    type_name = ((type_attribute.text if type_attribute else "") or "auto").lower().strip()
    text = given.text.strip()
    if source == "command":
        printed = _printed(state, scope, action, given.text, param)
        if not isinstance(printed, str):
            return printed
        text = printed
    if source in ("textfile", "binfile"):
        path = os.path.join(state.cwd, given.text)
        found: Document | bytes | Unreadable
        if not given.text:
            found = Unreadable("", "does not exist: the path is empty", "missing")
        else:
            found = state.read_text(path) if source == "textfile" else state.read_data(path)
        if isinstance(found, Unreadable):
            report_file(state, scope, action, source, found)
            return _NoValue(f"the file {path} {found.reason}")
        if isinstance(found, bytes):
            return found
        text = found.text.replace("\r\n", "\n").replace("\r", "\n")
        state.uses.append(_file_use(scope, action, source, found.path))
    try:
        return values.convert(text, type_name)
    except values.BadValueError as error:
        attribute = source if type_name in values.TYPES else "type"
        attributes.bad_value(attribute, text[:100] if attribute == source else type_name, str(error))
        return _NoValue(f"it is not {error}")


def _printed(state: State, scope: Scope, action: Action, line: str, param: str) -> str | CommandValue | _NoValue:
    """What a command printed, as far as that is known."""
    attribute = action.attribute("command")
    origin = scope.origin(attribute.value.span if attribute else action.kind_span)
    try:
        shlex.split(line)
    except ValueError as error:
        state.problem(MalformedCommand(str(error)), origin)
        return _NoValue(f"its command cannot be split into words: {error}")
    if (reason := state.withholds_files_of(line, origin)) is not None:
        return _NoValue(reason)
    result = state.results.result(line)
    state.commands.append(Command(line, _full_name(scope, param), origin, result))
    if result is None:
        return CommandValue(line)
    if result.status == "done":
        return result.output
    if result.status == "not-run":
        state.problem(CommandNotRun(result.reason), origin)
        return result.output or CommandValue(line, result.reason)
    missing = result.status == "missing"
    state.problem(CommandMissing(line) if missing else CommandFailed(result.reason, result.stderr_tail), origin)
    return _NoValue(f"its command failed: {result.reason}")


def _full_name(scope: Scope, param: str) -> str:
    """The full name of a parameter; of a private one that is not in a node's tag the name as written."""
    return param if names.is_private(param) else names.canonicalize(names.join(scope.ns, param))


def report_file(state: State, scope: Scope, action: Action, attribute: str, found: Unreadable) -> None:
    """Note that a file named in a parameter tag cannot be read."""
    written = action.attribute(attribute)
    origin = scope.origin(written.value.span if written else action.kind_span)
    state.unreadable_file(found.path, found, ParameterFileNotFound, UnreadableParameterFile, origin)


def _file_use(scope: Scope, action: Action, attribute: str, path: str) -> Use:
    written = action.attribute(attribute)
    span = written.value.span if written else action.kind_span
    return Use("file", scope.location(span), path, path, Location.of_file(path))


def evaluate_rosparam(state: State, scope: Scope, action: Action, *, node: str | None = None) -> None:
    """A `<rosparam>` (http://wiki.ros.org/roslaunch/XML/rosparam). `dump` and `delete` act at launch time only."""
    within = within_parameters(state, scope, node)
    remembered(state, scope, action, within, lambda state, scope: _evaluate_rosparam(state, scope, action, node))


def _evaluate_rosparam(state: State, scope: Scope, action: Action, node: str | None) -> None:
    if not applies(state, scope, action):
        return
    attributes = Attributes(state, scope, action)
    command, ns, file, param = (attributes.text(n) for n in ("command", "ns", "file", "param"))
    substitute = attributes.convert("subst_value", False, values.to_flag)
    if not attributes.all_known:
        state.unknown("<rosparam>", "an attribute is not known", scope, action.kind_span)
        return
    command = command or "load"
    if not attributes.chosen("command", command):
        return
    if command == "delete" and file is not None:
        state.problem(ConflictingAttributes("rosparam", ("command", "file")), scope.origin(action.kind_span))
        return
    if command != "load":
        return
    below = names.join(ns or "", param or "")
    full = names.join(scope.ns, below) if below else scope.ns
    text = _yaml_text(state, scope, action, file, full)
    if text is None:
        return
    if substitute:
        text = _substituted(state, scope, action, text, full)
        if text is None:
            return
    if not state.outline:
        _load(state, scope, action, text, _Target(full, bool(below), node))


class _Target(NamedTuple):
    """Where YAML is loaded: below the name `full`, which is that of a parameter if it is `named`; `node` has it in its
    tag."""

    full: str
    named: bool
    node: str | None


@dataclass(frozen=True, slots=True)
class _YamlText:
    """YAML and where its characters are: in a file of its own, in the launch file, or nowhere in particular."""

    text: str
    file: str
    lines: LineIndex
    start: int | None

    def location(self, span: Span) -> Location | None:
        if self.start is None:
            return None
        return self.lines.location(self.file, Span(self.start + span.start, self.start + span.end))


def _yaml_text(state: State, scope: Scope, action: Action, file: str | None, full: str) -> _YamlText | None:
    if not file:
        if file is not None:
            report_file(state, scope, action, "file", Unreadable(file, "is empty", "missing"))
            return None
        body = action.body
        plain = body.span.end - body.span.start == len(body.text)
        return _YamlText(body.text, scope.file, scope.lines, body.span.start if plain else None)
    path = os.path.join(state.cwd, file)
    found = state.read_text(path)
    if isinstance(found, Unreadable):
        report_file(state, scope, action, "file", found)
        state.unknown("<rosparam>", f"the file {path} {found.reason}", scope, action.kind_span, full)
        return None
    state.uses.append(_file_use(scope, action, "file", found.path))
    return _YamlText(found.text, found.path, found.lines, 0)


def _substituted(state: State, scope: Scope, action: Action, text: _YamlText, full: str) -> _YamlText | None:
    value = parse_value(SpannedText(text.text, Span(0, len(text.text))))
    result = resolve(state, scope, value, at=action.head_span)
    if not result.known:
        state.unknown("<rosparam>", "a substitution in its text is not known", scope, action.kind_span, full)
        return None
    return replace(text, text=result.text, start=text.start if result.text == text.text else None)


def _load(state: State, scope: Scope, action: Action, text: _YamlText, to: _Target) -> None:
    full = to.full

    def refuse(message: str, span: Span | None = None) -> None:
        place = text.location(span) if span else None
        origin = scope.origin(action.head_span)
        if place is not None:
            origin = (*origin, place) if place.file != scope.file else (*scope.chain, place)
        state.problem(BadYaml(message), origin)
        state.unknown("<rosparam>", "its YAML is malformed", scope, action.kind_span, full)

    try:
        loaded = load_yaml(text.text)
    except YamlError as error:
        refuse(error.message, Span(error.offset, error.offset) if error.offset is not None else None)
        return
    value = {} if loaded.value is None else loaded.value
    if not isinstance(value, dict) and not to.named:
        message = "only a dictionary can be loaded without the attribute 'param'"
        refuse(message)
        return
    origin = scope.origin(action.head_span)
    for key, first, second in loaded.twice:
        where, other = (text.location(span) or origin[-1] for span in (first, second))
        at = (*origin, where) if where.file != scope.file else (*scope.chain, where)
        state.problem(YamlKeyTwice(key, other), at)
    try:
        leaves, stopped = _leaves(loaded)
        outside = text.file != scope.file
        for span, below, leaf in leaves:
            name = full if below is None else names.join(full, below)
            if name == "/":
                raise _RootValueError
            place = text.location(span) if span else None
            found: Origin = (*origin, place) if place is not None and outside else origin
            state.set_param(Param(names.canonicalize(name), leaf, found, to.node, place))
        if stopped is not None:
            raise _BadKeyError(stopped.key)
    except _BadKeyError as error:
        refuse(f"the key {error.key!r} is not a string", None)
    except _RootValueError:
        refuse("only a dictionary can be loaded into the root namespace")
    except RecursionError:
        refuse("it is nested too deeply or contains itself")


class _BadKeyError(Exception):
    def __init__(self, key: object) -> None:
        super().__init__(key)
        self.key = key


class _RootValueError(Exception):
    """A value for the parameter `/`, which the key `""` at the top makes as well."""


@lru_cache(maxsize=1024)
def _leaves(loaded: YamlValue) -> tuple[tuple[tuple[Span | None, str | None, Any], ...], _BadKeyError | None]:
    """Dictionaries become one parameter a leaf; an empty one none.

    Where the last key is written, the keys joined (None for a value that is no dictionary) and the value of each; and
    the key that ends it, which is no string. Remembered, since the same text is loaded at each evaluation.
    """
    found: list[tuple[Span | None, str | None, Any]] = []

    def walk(name: str | None, value: Any, path: tuple[str, ...]) -> None:
        if not isinstance(value, dict):
            found.append((loaded.keys.get(path), name, value))
            return
        for key, below in value.items():
            if not isinstance(key, str):
                raise _BadKeyError(key)
            walk(key if name is None else names.join(name, key), below, (*path, key))

    try:
        walk(None, {} if loaded.value is None else loaded.value, ())
    except _BadKeyError as error:
        return tuple(found), error
    return tuple(found), None
