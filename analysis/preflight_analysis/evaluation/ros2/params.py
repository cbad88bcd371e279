"""Parameters of nodes: `<param>` tags and files, and which of them reach a node."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping
from dataclasses import field
from functools import lru_cache
from typing import Any, NamedTuple

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document, SpannedText
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import LineIndex, Location, Origin, Span
from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS
from preflight_analysis.evaluation.files import without_dots
from preflight_analysis.evaluation.partial_text import lacks_of, named
from preflight_analysis.evaluation.problems import BadYaml, ParameterFileNotFound, UnreadableParameterFile
from preflight_analysis.evaluation.resolved import Resolved
from preflight_analysis.evaluation.ros2.context import PushedParam
from preflight_analysis.evaluation.ros2.entity import PARAM_TYPES
from preflight_analysis.evaluation.ros2.param_files import (
    EVERY,
    FileParam,
    ParamFile,
    Section,
    read_made_param_file,
    read_param_file,
)
from preflight_analysis.evaluation.ros2.state import State
from preflight_analysis.evaluation.ros2.substitute import Performer, yaml_bool
from preflight_analysis.evaluation.ros2.types import ITEMS, NotOfTypeError, coerce, is_of_type, is_valid, loaded
from preflight_analysis.evaluation.ros2.unknown_text import is_unknown
from preflight_analysis.evaluation.ros2.written import is_from_yaml, read_param_value
from preflight_analysis.evaluation.tree import FileSection, LaunchNode, Param, ParamSource
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import Action, Value
from preflight_analysis.launch.problems import BadValue
from preflight_analysis.launch.substitutions_ros2 import parse_value_ros2


@dataclass(slots=True)
class Sources:
    """The sources of one node in the order in which launch passes them. `node` is its full name, with `?` for its own
    name where the launch file gives it none. `key` is that below which launch passes values of the launch file."""

    node: str
    key: str = EVERY
    composable: bool = False
    found: list[ParamSource] = field(default_factory=list)
    lacks: bool = False
    """Whether one of them is not known."""

    @property
    def owner(self) -> str:
        """The node's name, where it has one."""
        return "" if self.node.endswith("/?") else self.node

    def add(self, source: ParamSource | None) -> None:
        """One more source; None for one that is not known."""
        if source is None:
            self.lacks = True
        else:
            self.found.append(source if source.keys else source._replace(keys=(self.key,) * len(source.params)))

    def effective(self) -> tuple[Param, ...]:
        """Each parameter with the value that counts; the others stand in it, the one that would count next last.

        rcl gathers all sources by their keys as written: a later source replaces a value below the same key, but what
        stands below another key that fits the node counts by the order in which the *keys* first occur. So a value for
        `/**` that comes later loses to one for the node's own name, if `/**` occurred before that name did. For a
        composable node launch_ros gathers them itself, one after the other.
        """
        below: dict[str, dict[str, list[Param]]] = {}
        for source in self.found:
            for key, param in zip(source.keys, source.params, strict=True):
                values = below.setdefault("" if self.composable else key, {})
                values.setdefault(param.name, []).append(param)
        params: dict[str, list[Param]] = {}
        for values in below.values():
            for name, settings in values.items():
                params[name] = params.pop(name, []) + settings
        return tuple(settings[-1]._replace(overrides=tuple(settings[:-1])) for settings in params.values())


def tag_params(performer: Performer, action: Action, node: str, prefix: str = "") -> list[Param]:
    """The parameters of one `<param name=...>`; nested ones are joined by dots."""
    name_value = action.value("name")
    if name_value is None:
        return []
    name = performer.value(name_value)
    nested = [child for child in action.children if child.kind == "param"]
    if nested:
        return [p for child in nested for p in tag_params(performer, child, node, f"{prefix}{name.text}.")]
    value = action.value("value")
    if value is None:
        return []
    place = performer.place
    type_attribute = action.value("type")
    type_name = type_attribute.text if type_attribute is not None else None
    result = param_value(performer, action, value, type_name)
    if result is _UNKNOWN:
        return []
    name_location = place.location(name_value.span)
    note_lacks(performer.state, prefix + name.text, result, name_location)
    return [Param(prefix + name.text, result, place.origin(action.head_span), node, name_location)]


def note_lacks(state: State, name: str, value: object, location: Location) -> None:
    """A robot description that is known in part leaves the launch unknown in part."""
    if isinstance(value, str) and (lacks := lacks_of(value)):
        state.note_unknown(name, named(lacks), location)


_UNKNOWN = object()
"""Instead of a value that is not known, or is wrong, which is noted."""


def param_value(performer: Performer, action: Action, value: Value, type_name: str | None) -> Any:
    """What `launch_ros` makes of the value of a `<param>`: a text is read as YAML first, then its substitutions are
    made, and what they come to is read again. What it refuses at once was said when the file was read."""
    separator = action.value("value-sep")
    between = separator.text if separator is not None else None
    if type_name is not None and type_name not in PARAM_TYPES:
        return _UNKNOWN
    written = read_param_value(value, type_name, from_yaml=is_from_yaml(action), separator=between)
    if written.expected is not None:
        return _UNKNOWN
    item_type = type_name.removeprefix("list_of_") if written.is_list and type_name in ITEMS and type_name else None
    try:
        items = [_item(performer, each, item_type if written.is_list else type_name) for each in written.items]
        if any(each is _UNKNOWN for each in items):
            return _UNKNOWN
        if not written.is_list:
            return items[0]
        if not is_of_type(items, type_name):
            raise NotOfTypeError("a list of one type")
        return items
    except NotOfTypeError as problem:
        origin = performer.place.origin(value.span)
        text = performer.value(value).text
        performer.state.problem(BadValue("param", "value", text, str(problem)), origin)
        return _UNKNOWN


def _item(performer: Performer, item: Any, type_name: str | None) -> Any:
    if not isinstance(item, Value):
        return item
    result = performer.value(item)
    return coerce(result.text, type_name) if result.known else _UNKNOWN


def pushed_source(performer: Performer, param: PushedParam, to: Sources, *, as_text: bool) -> ParamSource | None:
    """What `<set_parameter>` or `<set_parameters_from_file>` give to a node. `as_text`: on its command line
    (`-p name:=value`), where rcl reads a text as YAML again; a component gets values."""
    if param.name is not None:
        given = _reread(param.value) if as_text and isinstance(param.value, str) else param.value
        value = Param(param.name, given, param.origin, to.owner)
        return ParamSource(None, (value,), param.origin, (EVERY,), pushed=True)
    path = os.path.join(performer.state.cwd, str(param.value))
    return file_source(performer, NamedFile(path, param.origin), to, must_exist=True)


def _reread(text: str) -> Any:
    try:
        found = loaded(text) if text else text
    except CONSTRUCTION_ERRORS:
        return text
    return found if is_valid(found) else text


class NamedFile(NamedTuple):
    """A parameter file as a launch file names it. `empty` is why the path is an empty text, which is the current
    folder."""

    path: str
    origin: Origin
    empty: str | None = None


def file_source(
    performer: Performer, file: NamedFile, to: Sources, *, substitute: bool = False, must_exist: bool
) -> ParamSource | None:
    """What a parameter file gives to a node; None if it cannot be read, which is noted.

    For `<node>` launch warns of a file that is not there and goes on, for a composable node it stops.
    """
    state, origin = performer.state, file.origin
    path = state.located(file.path)
    path = without_dots(state.files, path) or path
    found = state.read_text(path)
    if isinstance(found, Unreadable):
        fatal = must_exist or substitute
        if file.empty:
            state.problem(UnreadableParameterFile("", file.empty), origin, fatal=fatal)
        else:
            state.unreadable_file(path, found, ParameterFileNotFound, UnreadableParameterFile, origin, fatal=fatal)
        if found.kind == "withheld":
            state.note_unknown(path, found.reason, origin[-1])
        return None
    text = found.text
    if substitute:
        result = performer.value(parse_value_ros2(SpannedText(text, origin[-1].span, _flat(text, origin[-1].span))))
        if not result.known:
            state.note_unknown(path, "a substitution in it is not known", origin[-1])
            return ParamSource(path, (), origin, substituted=True)
        text = result.text
    if is_unknown(text):
        state.note_unknown(path, "values in it are not known", origin[-1])
    made = state.text_made(path) is not None
    said = read_made_param_file(text) if made or substitute else read_param_file(found)
    fatal = to.composable or substitute
    problem = said.problem_of_launch if fatal else said.problem
    if problem is not None:
        message, span = problem
        at = origin if made else (*origin, found.lines.location(path, span))
        state.problem(BadYaml(message), at, fatal=fatal)
    lines = None if substitute else found.lines
    if not (made or substitute):
        return of_file(said, path, lines, origin, to)
    before = _document_before(performer, text) if made else None
    places: _Places = _places(before) if before is not None else {}
    source = of_file(said, path, lines, origin, to, made_of=places if made else None)
    source = source._replace(made_from=before.path if before is not None else None)
    if to.composable:
        return source
    sections = _sections_made(text, path) if before is None else _sections_rewritten(before, text)
    return source._replace(sections=sections)


_Places = Mapping[str, tuple[tuple[FileParam, str, Location], ...]]
"""Parameters of a file by name, each with the key of its section and its place."""
_SOURCE = re.compile(r"# preflight: rewritten from (/.+)\n")
"""How `rewrites.py` of `tracing/agents/fake_launch` says what a file was made from."""


def _document_before(performer: Performer, text: str) -> Document | None:
    """The file that one was made from which a run of a launch file wrote."""
    source = _SOURCE.match(text)
    found = performer.state.read_text(source[1]) if source is not None else None
    is_own = source is None or performer.state.text_made(source[1]) is not None
    return found if isinstance(found, Document) and not is_own else None


@derived
def _places(document: Document) -> _Places:
    """Where its parameters stand."""
    places: dict[str, tuple[tuple[FileParam, str, Location], ...]] = {}
    for section in read_param_file(document).sections:
        for param in section.params:
            place = document.location(param.name_span)
            places[param.name] = (*places.get(param.name, ()), (param, section.key, place))
    return places


@derived
def _sections_rewritten(document: Document, text: str) -> tuple[FileSection, ...]:
    """Those of a text that was made from the document."""
    places = _places(document)
    return _sections(text, lambda param, key: _place_before(places, param, key))


@lru_cache(maxsize=64)
def _sections_made(text: str, path: str) -> tuple[FileSection, ...]:
    """Those of a text that no file has as it stands."""
    place = Location.of_file(path)
    return _sections(text, lambda param, key: place)


def _sections(text: str, place: Callable[[FileParam, str], Location | None]) -> tuple[FileSection, ...]:
    """A file may be shared by hundreds of nodes: who gets which of its parameters is left to those who ask."""
    return tuple(
        FileSection(
            each.pattern,
            each.key,
            tuple(
                Param(param.name, param.value, (), None, place(param, each.key), by_launch=_by_launch(param))
                for param in each.params
                if not is_unknown(param.name) and not any(map(is_unknown, _items(param.value)))
            ),
        )
        for each in read_made_param_file(text).sections
    )


def _place_before(places: _Places, param: FileParam, key: str) -> Location | None:
    """None for a value that was replaced, and where several sections have the name."""
    same = [each for each in places.get(param.name, ()) if repr(each[0].value) == repr(param.value)]
    of_section = [each for each in same if key.endswith(each[1].lstrip("/"))]
    found = of_section or same
    return found[0][2] if len(found) == 1 else None


def sections_for_any_name(node: LaunchNode, documents: Mapping[str, Document]) -> tuple[tuple[Section, ...], ...]:
    """What the sources of a node have for nodes of any name, source by source: of one that the launch file does not
    name, it is not known which of it is for the node."""
    return tuple(_for_any_name(source, documents) for source in node.param_sources)


def _for_any_name(source: ParamSource, documents: Mapping[str, Document]) -> tuple[Section, ...]:
    document = _as_it_stands(source, documents)
    if document is not None:
        return read_param_file(document).sections
    nowhere = Span(0, 0)
    return tuple(
        Section(EVERY, (), (FileParam(param.name, param.value, param.value, nowhere, nowhere),), key)
        for key, param in zip(source.keys, source.params, strict=True)
    )


def _as_it_stands(source: ParamSource, documents: Mapping[str, Document]) -> Document | None:
    """The file of a source; None for values of the launch file, and for one that was read after its substitutions were
    made."""
    document = documents.get(source.path) if source.path is not None else None
    return document if not source.substituted else None


def of_name(node: LaunchNode, name: str, documents: Mapping[str, Document], *, inferred: bool) -> LaunchNode:
    """A node that the launch file does not name, under the name that its own code gives it: parameter files may have
    something for that. Those of a composable node launch_ros has read without knowing it."""
    if node.kind == "composable":
        return node._replace(name=name, name_from_code=True, name_inferred=inferred)
    to = Sources(name)
    for source in node.param_sources:
        document = _as_it_stands(source, documents)
        if source.sections:
            to.add(_of_sections(source, name))
        elif source.path is None or document is None:
            to.add(source)
        else:
            file = read_param_file(document)
            to.add(of_file(file, source.path, document.lines, source.origin, to))
    return node._replace(
        name=name, name_from_code=True, name_inferred=inferred, params=to.effective(), param_sources=tuple(to.found)
    )


def of_file(
    file: ParamFile,
    path: str,
    lines: LineIndex | None,
    origin: Origin,
    to: Sources,
    *,
    made_of: _Places | None = None,
) -> ParamSource:
    """What of a file reaches a node. `lines` are those of the file, None where its substitutions were made. `made_of`:
    a run of a launch file wrote it, so there is no place in it to show, but in the one that it was made from."""
    reaching = file.reaching(to.node, composable=to.composable)
    if to.composable:
        reaching.sort(key=lambda section: section.exact)
        if not file.sections:
            reaching = [Section(EVERY, (), file.flat, EVERY)]
    params, keys = [], []
    for section in reaching:
        for param in section.params:
            if is_unknown(param.name) or any(map(is_unknown, _items(param.value))):
                continue
            place: Location | None = Location.of_file(path)
            if made_of is not None:
                place = _place_before(made_of, param, section.key)
            elif lines is not None:
                place = lines.location(path, param.name_span)
            value = param.by_launch if to.composable else param.value
            by_launch = None if to.composable else _by_launch(param)
            way = origin if place is None else (*origin, place)
            params.append(Param(param.name, value, way, to.owner, place, by_launch=by_launch))
            keys.append(section.key)
    return ParamSource(path, tuple(params), origin, tuple(keys), lines is None)


def _by_launch(param: FileParam) -> Any:
    """What launch reads, where that is something else than rcl does."""
    return None if repr(param.value) == repr(param.by_launch) else param.by_launch


def _of_sections(source: ParamSource, node: str) -> ParamSource:
    """What a file that cannot be read again has for the node of this full name."""
    own = [(each.key, param) for each in source.sections if _fits(each, node) for param in each.params]
    params = tuple(
        param._replace(owner=node, origin=(*source.origin, *filter(None, (param.name_location,)))) for _, param in own
    )
    return source._replace(params=params, keys=tuple(key for key, _ in own))


def _fits(section: FileSection, node: str) -> bool:
    return Section(section.pattern, (), ()).fits(node)


def given_within(node: LaunchNode, name: str, documents: Mapping[str, Document]) -> tuple[Param, ...]:
    """What the parameter files of a node have for the one of this full name that its process has, too; the one that
    counts comes last."""
    found: list[Param] = []
    for source in {each.path: each for each in node.param_sources if each.path is not None}.values():
        document = _as_it_stands(source, documents)
        if source.sections:
            found += _of_sections(source, name).params
        elif document is not None and source.path is not None:
            file = read_param_file(document)
            found += of_file(file, source.path, document.lines, source.origin, Sources(name)).params
    return tuple(found)


def _items(value: Any) -> list[Any]:
    """Those of a list, or the value alone."""
    return value if isinstance(value, list) else [value]


def _flat(text: str, span: Span) -> tuple[int, ...]:
    return (*(span.start,) * len(text), span.end)


def pushed_value(performer: Performer, value: Value) -> Any:
    """What `<set_parameter value=...>` sets: the text is read as YAML after its substitutions were made."""
    result = performer.value(value)
    if not result.known:
        return None
    try:
        found = loaded(result.text) if result.text else ""
    except CONSTRUCTION_ERRORS:
        found = None
    if not is_valid(found) or found == []:
        origin = performer.place.origin(value.span)
        expected = "a bool, a number, a text or a list of one of them"
        performer.state.problem(BadValue("set_parameter", "value", result.text, expected), origin)
        return None
    return found


def allows_substitutions(performer: Performer, action: Action) -> bool:
    """`allow_substs` of a `<param from=...>`."""
    value = action.value("allow_substs")
    if value is None:
        return False
    if value.typed is not None:
        return bool(value.typed.value)
    found: Resolved = performer.value(value)
    return found.known and bool(yaml_bool(found.text))
