"""Values that launch refuses while it reads a file, before any of it is executed: also where a condition is false.

The frontends take most attributes as text (`launch.frontend.Entity.get_attr`). `launch_xml` makes of the text what an
attribute has to be, `launch_yaml` makes nothing of anything: `default: 1` is an error there.
"""

from __future__ import annotations

import shlex
from collections.abc import Iterator
from typing import Any

from preflight_analysis.evaluation.ros2.actions.registry import tags
from preflight_analysis.evaluation.ros2.entity import PARAM_TYPES
from preflight_analysis.evaluation.ros2.types import NotOfTypeError, coerce, is_of_type
from preflight_analysis.evaluation.ros2.written import is_from_yaml, read_param_value
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import Action, LaunchFile, Literal, Substitution, Value
from preflight_analysis.launch.problems import BadSubstitution, BadValue, LanguageProblem
from preflight_analysis.launch.schema import Attribute
from preflight_analysis.launch.substitutions_ros2 import SUBSTITUTIONS_ROS2

_TYPES = {"flag": "bool", "integer": "int", "number": "float"}
_UNREADABLE = {"any": "or", "all": "and"}
"""`AnySubstitution.parse` and `AllSubstitution.parse` name an argument that their classes do not have."""
_EXPECTED = {
    "str": "a text: in YAML it needs quotes",
    "bool": "true or false",
    "int": "an integer",
    "float": "a number",
}
_EXPECTED_IN_YAML = {**_EXPECTED, "float": "a number with a decimal point"}


@derived
def check_values_ros2(launch_file: LaunchFile) -> tuple[LanguageProblem, ...]:
    """Everything in the file at which launch would stop while it reads the values, in document order."""
    if launch_file.root is None:
        return ()
    return tuple(_check(launch_file.root, None))


def _check(action: Action, parent: str | None) -> Iterator[LanguageProblem]:
    tag = tags().get(action.kind)
    if tag is None:
        return  # an unknown tag, which is reported as one
    given = {attribute.name for attribute in action.attributes}
    for attribute in action.attributes:
        name, value = attribute.name, attribute.value
        known = tag.attributes.get(name)
        if known is None or (name + "-sep" in given and (action.kind, name) != ("param", "value")):
            continue
        if (action.kind, name) == ("param", "value"):
            if "name" in given:
                yield from _param(action, value)
        else:
            yield from _attribute(action, parent, known, value)
    for child in action.children:
        if child.kind in tag.children:
            yield from _check(child, action.kind)


def _attribute(action: Action, parent: str | None, known: Attribute, value: Value) -> Iterator[LanguageProblem]:
    name, performed = known.name, known.taken == "performed"
    type_name = "str" if known.taken == "text" else _TYPES.get(known.kind, "str")
    taken, in_yaml = value.text, value.typed is not None
    try:
        if value.typed is not None:
            written: Any = value.typed.value
            if not is_of_type(written, type_name, or_text=True):
                raise NotOfTypeError(_EXPECTED_IN_YAML[type_name])
        else:
            # In YAML a text in quotes stays one.
            written = taken if is_from_yaml(action) else coerce(taken, type_name, or_text=True)
        if known.taken == "seconds" and (isinstance(written, str) or written < 0):
            raise NotOfTypeError("a number that is not negative")
        if name == "allow_substs" and isinstance(written, str):
            raise NotOfTypeError("true or false")
        if (action.kind, name) == ("param", "type") and written not in PARAM_TYPES:
            raise NotOfTypeError("a type of parameters")
        if name == "on_exit" and written != "shutdown":
            raise NotOfTypeError("shutdown")
        if performed and isinstance(written, str) and value.is_literal and value.problem is None:
            if known.kind == "flag":
                raise NotOfTypeError("true or false")
            if action.kind == "ros_timer":
                raise NotOfTypeError("a number")
            coerce(written, "float")
    except NotOfTypeError as problem:
        yield _bad_value(action, name, value, _EXPECTED_IN_YAML[type_name] if in_yaml else str(problem))
        return
    verbatim = known.taken == "verbatim" and not (action.kind == "arg" and parent == "include")
    if not isinstance(written, str) or verbatim or (type_name != "str" and not performed):
        return
    yield from substitution_problems(value)
    if known.taken == "command-line" and value.problem is None:
        for part in value.parts:
            if isinstance(part, Literal):
                try:
                    shlex.split(part.text)
                except ValueError:
                    yield _bad_value(action, name, value, "a command line: a quote in it is never closed")


def _param(action: Action, value: Value) -> Iterator[LanguageProblem]:
    type_value, separator = action.value("type"), action.value("value-sep")
    type_name = type_value.text if type_value is not None else None
    if type_name is not None and type_name not in PARAM_TYPES:
        return
    between = separator.text if separator is not None else None
    found = read_param_value(value, type_name, from_yaml=is_from_yaml(action), separator=between)
    for each in found.items:
        if isinstance(each, Value):
            yield from substitution_problems(each)
    if found.expected is not None:
        yield _bad_value(action, "value", value, found.expected)


def _bad_value(action: Action, name: str, value: Value, expected: str) -> LanguageProblem:
    choices = ("true", "false") if expected == _EXPECTED["bool"] else ()
    return LanguageProblem(BadValue(action.kind, name, value.text, expected, choices), value.span)


def substitution_problems(value: Value) -> Iterator[LanguageProblem]:
    """What is wrong with the form of the substitutions of a value."""
    if value.problem is not None:
        span = value.problem_span or value.span
        yield LanguageProblem(BadSubstitution(value.text, value.problem), span)
        return
    for part in value.parts:
        if isinstance(part, Substitution):
            yield from _substitution(part)


def _substitution(part: Substitution) -> Iterator[LanguageProblem]:
    for word in part.words:
        for inner in word:
            if isinstance(inner, Substitution):
                yield from _substitution(inner)
    known = SUBSTITUTIONS_ROS2.get(part.command)
    if known is None:
        message = f"'{part.command}' is not a substitution"
        yield LanguageProblem(BadSubstitution(part.text, message, part.command, tuple(SUBSTITUTIONS_ROS2)), part.span)
        return
    if part.command in _UNREADABLE:
        message = (
            f"launch cannot read $({part.command} ...) in XML and YAML files: write $({_UNREADABLE[part.command]} ...)"
        )
        yield LanguageProblem(BadSubstitution(part.text, message), part.span)
        return
    arity, count = known[2], len(part.words)
    if count < arity.least or (arity.most is not None and count > arity.most):
        message = f"$({part.command}) takes {arity}"
        yield LanguageProblem(BadSubstitution(part.text, message), part.span)
