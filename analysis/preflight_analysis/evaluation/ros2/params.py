"""Parameters of nodes: `<param>` tags and files, and which of them reach a node."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

import yaml

from preflight_analysis.documents.document import SpannedText
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import Location, Origin, Span
from preflight_analysis.environment.shares import located
from preflight_analysis.evaluation.resolved import Resolved
from preflight_analysis.evaluation.ros2.context import PushedParam
from preflight_analysis.evaluation.ros2.param_files import ParamFile, Section, read_param_file
from preflight_analysis.evaluation.ros2.substitute import Performer, yaml_bool
from preflight_analysis.evaluation.ros2.types import NotOfTypeError, coerce, is_valid
from preflight_analysis.evaluation.tree import Param, ParamSource
from preflight_analysis.launch.model import Action, Value
from preflight_analysis.launch.substitutions_ros2 import parse_value_ros2


@dataclass(slots=True)
class Sources:
    """The sources of one node in the order in which they apply, and what could not be known of them."""

    node: str
    found: list[ParamSource] = field(default_factory=list)
    missing: list[str] = field(default_factory=list)

    def effective(self) -> tuple[Param, ...]:
        """Each parameter from the source that counts; what that one overrides stands in it."""
        params: dict[str, Param] = {}
        for source in self.found:
            for param in source.params:
                old = params.pop(param.name, None)
                before = () if old is None else (*old.overrides, old._replace(overrides=()))
                params[param.name] = param._replace(overrides=before)
        return tuple(params.values())


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
    result = param_value(performer, value, type_name)
    if result is _UNKNOWN:
        return []
    name_location = Location(place.file, name_value.span)
    return [Param(prefix + name.text, result, place.origin(action.head_span), node, name_location)]


_UNKNOWN = object()
"""Instead of a value that is not known, or is wrong, which is noted."""


def param_value(performer: Performer, value: Value, type_name: str | None) -> Any:
    """What `launch_ros` makes of the value of a `<param>`: a text is read as YAML first, then its substitutions are
    made, and what they come to is read again."""
    try:
        if value.typed is not None:
            written = value.typed.value
            if not is_valid(written, or_text=True):
                raise NotOfTypeError("a bool, a number, a text or a list of one of them")
        else:
            written = coerce(value.text, type_name, or_text=True) if value.problem is None else value.text
        if isinstance(written, list):
            items = [_item(performer, each, value) for each in written]
            return _UNKNOWN if any(each is _UNKNOWN for each in items) else items
        if not isinstance(written, str):
            return written
        parts = value if value.typed is None and written == value.text else _again(written, value)
        result = performer.value(parts)
        if not result.known:
            return _UNKNOWN
        if parts.is_literal:
            return result.text
        return coerce(result.text, type_name)
    except NotOfTypeError as problem:
        origin = performer.place.origin(value.span)
        text = performer.value(value).text
        performer.state.problem(
            "bad-value", origin, tag="param", attribute="value", value=text, expected=str(problem), choices=()
        )
        return _UNKNOWN


def _item(performer: Performer, item: Any, value: Value) -> Any:
    if not isinstance(item, str):
        return item
    parts = _again(item, value)
    result = performer.value(parts)
    if not result.known:
        return _UNKNOWN
    return result.text if parts.is_literal else coerce(result.text, None)


def _again(text: str, value: Value) -> Value:
    """A text that stands inside of the value, or that YAML made of it: places in it are those of the whole."""
    return parse_value_ros2(SpannedText(text, value.span, (*(value.span.start,) * len(text), value.span.end)))


def pushed_source(performer: Performer, param: PushedParam, node: str, *, must_exist: bool) -> ParamSource | None:
    """What `<set_parameter>` or `<set_parameters_from_file>` give to a node."""
    if param.name is not None:
        return ParamSource(None, (Param(param.name, param.value, param.origin, node),), param.origin)
    path = os.path.join(performer.state.cwd, str(param.value))
    return file_source(performer, path, param.origin, node, must_exist=must_exist)


def file_source(
    performer: Performer, path: str, origin: Origin, node: str, *, substitute: bool = False, must_exist: bool
) -> ParamSource | None:
    """What a parameter file gives to a node; None if it cannot be read, which is noted.

    For `<node>` launch warns of a file that is not there and goes on, for a composable node it stops.
    """
    state = performer.state
    path = located(state.environment, path)
    found = state.read_text(path)
    if isinstance(found, Unreadable):
        kind = "param-file-not-found" if found.kind == "missing" else "param-file-unreadable"
        fatal = must_exist or substitute
        state.problem(kind, origin, fatal=fatal, path=path, tag="param", attribute="from", reason=found.reason)
        return None
    text = found.text
    if substitute:
        result = performer.value(parse_value_ros2(SpannedText(text, origin[-1].span, _flat(text, origin[-1].span))))
        if not result.known:
            state.note_unknown(path, "a substitution in it is not known", origin[-1])
            return ParamSource(path, (), origin)
        text = result.text
    file = read_param_file(text)
    if file.problem is not None:
        message, span = file.problem
        state.problem("bad-yaml", (*origin, Location(path, span)), fatal=must_exist, message=message, path=path)
    return ParamSource(path, tuple(_of_file(file, path, node, origin, exact=not substitute)), origin)


def _flat(text: str, span: Span) -> tuple[int, ...]:
    return (*(span.start,) * len(text), span.end)


def _of_file(file: ParamFile, path: str, node: str, origin: Origin, *, exact: bool) -> Iterable[Param]:
    for section in ordered(file.sections):
        if section.fits(node):
            for param in section.params:
                place = Location(path, param.name_span if exact else Span(0, 0))
                yield Param(param.name, param.value, (*origin, place), node, place)


def ordered(sections: Sequence[Section]) -> list[Section]:
    """Sections that name one node come after those with wildcards."""
    return sorted(sections, key=lambda section: section.exact)


def pushed_value(performer: Performer, value: Value) -> Any:
    """What `<set_parameter value=...>` sets: the text is read as YAML after its substitutions were made."""
    result = performer.value(value)
    if not result.known:
        return None
    try:
        found = yaml.safe_load(result.text or "''")
    except yaml.YAMLError:
        found = None
    if not is_valid(found) or found == []:
        origin = performer.place.origin(value.span)
        expected = "a bool, a number, a text or a list of one of them"
        performer.state.problem(
            "bad-value",
            origin,
            tag="set_parameter",
            attribute="value",
            value=result.text,
            expected=expected,
            choices=(),
        )
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
