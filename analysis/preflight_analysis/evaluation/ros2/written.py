"""The value of a `<param>` as launch reads it from a file: plain data, and texts whose substitutions come later.

`Node.parse_nested_parameters` in ros2/launch_ros: `Entity.get_attr`, `parse_if_substitutions` and
`normalize_typed_substitution` one after the other.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import SpannedText
from preflight_analysis.evaluation.ros2.types import ITEMS, NotOfTypeError, coerce, coerced_items, is_of_type
from preflight_analysis.launch.model import Action, Value
from preflight_analysis.launch.substitutions_ros2 import parse_value_ros2

_UNIFORM = "a list of one type"
_EXPECTED = {"bool": "true or false", "int": "an integer", "float": "a number with a decimal point", "str": "a text"}


@dataclass(frozen=True, slots=True)
class Written:
    """Scalars, and values that are to be performed; one of them unless `is_list`. `expected` is what the value has to
    be where it is refused."""

    items: tuple[Any, ...] = ()
    is_list: bool = False
    expected: str | None = None


def is_from_yaml(action: Action) -> bool:
    """Whether an action stands in a YAML file: an XML element has a head of more than its name."""
    return action.head_span == action.kind_span


def read_param_value(value: Value, type_name: str | None, *, from_yaml: bool, separator: str | None = None) -> Written:
    """What launch makes of the value before it executes anything. `separator` is the attribute `value-sep`."""
    try:
        written = _taken(value, type_name, from_yaml=from_yaml, separator=separator)
    except NotOfTypeError as error:
        return Written(expected=str(error))
    texts = written if isinstance(written, list) else [written]
    items = [_item(each, value) if isinstance(each, str) else each for each in texts]
    found = tuple(each.parts[0].text if _is_plain(each) else each for each in items)
    expected = _refused(found, type_name) if isinstance(written, list) else _refused_scalar(found[0], type_name)
    return Written(found, isinstance(written, list), expected)


def _taken(value: Value, type_name: str | None, *, from_yaml: bool, separator: str | None) -> Any:
    if separator is not None and not from_yaml:
        if type_name is not None and type_name not in ITEMS and type_name != "yaml":
            raise NotOfTypeError(f"one value: a `value-sep` is for lists, and the type is {type_name}")
        if not separator:
            raise NotOfTypeError("something that an empty `value-sep` can take apart: nothing is")
        return coerced_items(value.text.split(separator), type_name)
    if not from_yaml:
        return coerce(value.text, type_name, or_text=True)
    written = value.typed.value if value.typed is not None else value.text
    if not is_of_type(written, type_name, or_text=True):
        raise NotOfTypeError(_expected(type_name))
    return written


def _expected(type_name: str | None) -> str:
    if type_name is None or type_name == "yaml":
        return "a bool, a number, a text or a list of one of them"
    if type_name in ITEMS:
        return f"a list of {ITEMS[type_name].__name__}"
    return _EXPECTED[type_name]


def _item(text: str, value: Value) -> Value:
    """A text that stands inside of the value, or that YAML made of it: places in it are those of the whole."""
    if text == value.text and value.typed is None:
        return value
    return parse_value_ros2(SpannedText(text, value.span, (*(value.span.start,) * len(text), value.span.end)))


def _is_plain(item: Any) -> bool:
    return isinstance(item, Value) and item.problem is None and item.is_literal and len(item.parts) == 1


def _refused_scalar(item: Any, type_name: str | None) -> str | None:
    if isinstance(item, Value) or is_of_type(item, type_name):
        return None
    return _expected(type_name)


def _refused(items: Sequence[Any], type_name: str | None) -> str | None:
    kinds = {type(each) for each in items if not isinstance(each, Value)}
    if len(kinds) > 1:
        return _UNIFORM
    if type_name is None or type_name == "yaml":
        return None
    if type_name not in ITEMS:
        return _expected(type_name)
    if not kinds and items:
        return None  # only substitutions, which can become anything
    return None if (kinds <= {str} and ITEMS[type_name] is str) or kinds == {ITEMS[type_name]} else _expected(type_name)
