"""`launch.utilities.type_utils`: values that are of a type, or become so when substitutions in them are performed."""

from __future__ import annotations

import collections.abc
import importlib
from typing import Any, List, Optional

from ..anything import Anything
from .base import (
    LaunchContext,
    Substitution,
    ensure_argument_type,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)

ScalarTypesTuple = (int, float, bool, str)
ListTypesTuple = (List[int], List[float], List[bool], List[str])
AllowedTypesTuple = ScalarTypesTuple + ListTypesTuple
_BOOLEANS = {"1": "true", "0": "false"}


def is_typing_list(data_type: Any) -> bool:
    if data_type is List:
        return True
    return hasattr(data_type, "__args__") and getattr(data_type, "__origin__", None) in (list, List)


def is_valid_scalar_type(data_type: Any) -> bool:
    return data_type in ScalarTypesTuple


def extract_type(data_type: Any) -> tuple[Any, bool]:
    items = getattr(data_type, "__args__", None) if is_typing_list(data_type) else None
    scalar = items[0] if items else data_type
    if not is_valid_scalar_type(scalar):
        raise ValueError(f"Unrecognized data type: {data_type}")
    return scalar, bool(items)


def is_instance_of_valid_type(value: Any, *, can_be_str: bool = False) -> bool:
    if not isinstance(value, list):
        return isinstance(value, ScalarTypesTuple)
    kind = next((type(each) for each in value if type(each) is not str), str)
    allowed = (kind, str) if can_be_str else (kind,)
    return not value or (kind in ScalarTypesTuple and all(isinstance(each, allowed) for each in value))


def is_instance_of(value: Any, data_type: Any = None, *, can_be_str: bool = False) -> bool:
    if data_type is None:
        return is_instance_of_valid_type(value, can_be_str=can_be_str)
    kind, is_list = extract_type(data_type)
    allowed = (str, kind) if can_be_str else (kind,)
    if is_list:
        return isinstance(value, list) and all(isinstance(each, allowed) for each in value)
    return isinstance(value, allowed)


def _from_yaml(text: str, said: str, can_be_str: bool) -> Any:
    if not text:
        return text
    yaml = importlib.import_module("yaml")  # only an interpreter with ROS must have it
    try:
        value = yaml.safe_load(text)
    except Exception as error:
        if can_be_str:
            return text
        raise ValueError(f"{said}: yaml.safe_load() failed\n{error}") from None
    if not is_instance_of_valid_type(value, can_be_str=can_be_str):
        raise ValueError(f"{said}: output type is not allowed, got {type(value)}")
    return value


def coerce_to_type(value: str, data_type: Any = None, *, can_be_str: bool = False) -> Any:
    ensure_argument_type(value, str, "value", "coerce_to_type")
    if data_type is None:
        return _from_yaml(value, f"Failed to convert '{value}' using yaml rules", can_be_str)
    kind, is_list = extract_type(data_type)
    if kind is str and not is_list:
        return value
    if kind in (int, float) and not is_list:
        try:
            return kind(value)
        except ValueError:
            if can_be_str:
                return value
            raise
    allowed = (str, kind) if can_be_str else (kind,)
    wanted = f"a list of '{kind}'" if is_list else f"'{kind}'"
    found = _from_yaml(value if is_list else _BOOLEANS.get(value, value), f"Failed to convert '{value}'", can_be_str)
    items = found if is_list else [found]
    if not isinstance(items, list) or not all(isinstance(each, allowed) for each in items):
        raise ValueError(f"Cannot convert value '{value}' to {wanted}")
    return found


def coerce_list(value: Any, data_type: Any = None, *, can_be_str: bool = False) -> Any:
    ensure_argument_type(value, list, "value", "coerce_list")
    found = [coerce_to_type(each, data_type, can_be_str=can_be_str) for each in value]
    if not is_instance_of_valid_type(found, can_be_str=can_be_str):
        raise ValueError(f"cannot convert value to {data_type}. Got value=`{value}`")
    return found


def get_typed_value(value: Any, data_type: Any, *, can_be_str: bool = False) -> Any:
    if not isinstance(value, list):
        return coerce_to_type(value, data_type, can_be_str=can_be_str)
    if data_type is not None:
        kind, is_list = extract_type(data_type)
        if not is_list:
            raise TypeError(f"Cannot convert input '{value}' of type '{type(value)}' to '{kind}'")
        data_type = kind
    return coerce_list(value, data_type, can_be_str=can_be_str)


def is_substitution(x: Any) -> bool:
    if isinstance(x, (Substitution, Anything)):
        return True
    if not isinstance(x, collections.abc.Iterable) or not len(x):  # type: ignore[arg-type]
        return False
    items = list(x)
    return all(isinstance(each, (str, Substitution)) for each in items) and any(
        isinstance(each, Substitution) for each in items
    )


def normalize_typed_substitution(value: Any, data_type: Any) -> Any:
    if isinstance(value, ScalarTypesTuple):
        if not is_instance_of(value, data_type):
            raise TypeError(f"value='{value}' is not an instance of {data_type}")
        return value
    if is_substitution(value):
        return normalize_to_list_of_substitutions(value)
    if not isinstance(value, collections.abc.Iterable):
        raise TypeError(
            "value should be either a scalar, a substitutions, or a mixed list of scalars and substitutions. "
            f"Got `value={value}` of type `{type(value)}`. "
        )
    items = list(value)
    if not all(isinstance(each, ScalarTypesTuple) or is_substitution(each) for each in items):
        raise TypeError(
            "value is a list, and one of the items is not a scalar, a Substitution or a list of substitutions. "
            f"Got value='{value}'"
        )
    wanted, is_list = (None, True) if data_type is None else extract_type(data_type)
    if not is_list:
        raise TypeError(
            "The provided value resolves to a list, though the required type is a scalar. "
            f"Got value='{value}', data_type='{wanted}'."
        )
    plain = {type(each) for each in items if isinstance(each, ScalarTypesTuple)}
    kind = next((each for each in (str, bool, int, float) if plain <= {each} or plain == {int, each}), None)
    if kind is None or (len(plain) == 2 and kind is not float):
        raise TypeError(f"Input value is not an acceptable 'SomeValueType'.Got value='{value}'")
    if (plain or not items) and wanted not in (None, kind):
        raise TypeError(f"Got a list of '{kind}', expected a list of '{wanted}'. value='{value}'")
    return [
        normalize_to_list_of_substitutions(each)
        if not isinstance(each, ScalarTypesTuple)
        else float(each)
        if kind is float
        else each
        for each in items
    ]


def is_normalized_substitution(x: Any) -> bool:
    return isinstance(x, list) and bool(x) and all(isinstance(each, Substitution) for each in x)


def perform_typed_substitution(context: LaunchContext, value: Any, data_type: Any) -> Any:
    if isinstance(value, ScalarTypesTuple):
        if not is_instance_of(value, data_type):
            raise TypeError(f"value=`{value}` is a scalar and not an instance of `{data_type}`")
        return value
    if is_normalized_substitution(value):
        return coerce_to_type(perform_substitutions(context, value), data_type)
    if not isinstance(value, list):
        raise TypeError(f"Input value is not an acceptable 'NormalizedValueType'.Got value='{value}'")
    kind: Optional[Any] = None
    if data_type is not None:
        kind, is_list = extract_type(data_type)
        if not is_list:
            raise ValueError(f"The input value is a list, cannot convert it to a scalar. Got value='{value}'")
    found = [
        coerce_to_type(perform_substitutions(context, each), kind) if is_normalized_substitution(each) else each
        for each in value
    ]
    if not is_instance_of(found, data_type):
        raise ValueError(f"The output list does not match the expected type Got value='{value}'")
    return found
