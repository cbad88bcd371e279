"""`launch_ros.parameter_descriptions`, and the parameters and remaps of nodes as launch_ros takes them."""

from __future__ import annotations

import os
from collections.abc import Iterable as AnyIterable
from collections.abc import Mapping, Sequence
from typing import Any, Iterable, Optional

from ..anything import Anything
from .base import (
    LaunchContext,
    Made,
    Substitution,
    TextSubstitution,
    ensure_argument_type,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)
from .typed import extract_type, normalize_typed_substitution, perform_typed_substitution

_SCALARS = (int, float, bool, str)


class ParameterValue(Made):
    def preflight_take(self, given: Any, left: Any) -> None:
        self.__value_type = given.value_type
        self.__value = normalize_typed_substitution(given.value, self.__value_type)
        self.preflight_type: Optional[str] = None
        if self.__value_type is not None:
            kind, is_list = extract_type(self.__value_type)
            self.preflight_type = f"list_of_{kind.__name__}" if is_list else str(kind.__name__)

    @property
    def value(self) -> Any:
        return self.__value

    @property
    def value_type(self) -> Any:
        return self.__value_type

    def evaluate(self, context: LaunchContext) -> Any:
        return perform_typed_substitution(context, self.__value, self.__value_type)


class Parameter(Made):
    def preflight_take(self, given: Any, left: Any) -> None:
        self.__name = normalize_to_list_of_substitutions(given.name)
        self.preflight_value = ParameterValue(given.value, value_type=given.value_type)

    @property
    def name(self) -> Any:
        return self.__name

    @property
    def value(self) -> Any:
        return self.preflight_value.value

    @property
    def value_type(self) -> Any:
        return self.preflight_value.value_type

    def evaluate(self, context: LaunchContext) -> tuple[str, Any]:
        return perform_substitutions(context, self.__name), self.preflight_value.evaluate(context)


class ParameterFile(Made):
    def preflight_take(self, given: Any, left: Any) -> None:
        types = (str, Substitution, AnyIterable, os.PathLike, bytes)
        ensure_argument_type(given.param_file, types, "param_file", "ParameterFile()")
        path = os.fsdecode(given.param_file) if isinstance(given.param_file, bytes) else given.param_file
        self.__param_file = normalize_to_list_of_substitutions(path)
        self.__allow_substs = given.allow_substs

    @property
    def param_file(self) -> Any:
        return self.__param_file

    @property
    def allow_substs(self) -> Any:
        return self.__allow_substs


def normalize_parameter_dict(parameters: Any, *, _prefix: Any = None) -> Any:
    """Each name (as substitutions) with what the host is told of its value."""
    if not isinstance(parameters, Mapping):
        raise TypeError("expected dict")
    normalized = {}
    for key, value in parameters.items():
        name = normalize_to_list_of_substitutions(key)
        if _prefix:
            name = [*_prefix, TextSubstitution(text="."), *name]
        if isinstance(value, Mapping):
            normalized.update(normalize_parameter_dict(value, _prefix=name))
        else:
            normalized[tuple(name)] = _parameter_value(value)
    return normalized


def _parameter_value(value: Any) -> Any:
    if isinstance(value, (ParameterValue, str, float, bool, int, bytes)):
        return value
    if isinstance(value, (Substitution, Anything)):
        return ("yaml", normalize_to_list_of_substitutions(value))
    if isinstance(value, Sequence):
        return _parameter_array(value)
    raise TypeError(f"Unexpected type for parameter value {value!r}")


def _kind(item: Any) -> type:
    for kind in (Substitution, str, bool, int, float):
        if isinstance(item, kind):
            return kind
    if isinstance(item, Sequence):
        return tuple
    raise RuntimeError(f"Failed to handle type {item!r}")


def _parameter_array(value: Any) -> Any:
    for each in value:
        ensure_argument_type(each, (float, int, str, bool, Substitution, AnyIterable), "subvalue")
    value = [str(each) if isinstance(each, Anything) else each for each in value]
    kinds = {_kind(each) for each in value}
    if kinds in ({int}, {bool}):
        return ("list", list(value))
    if kinds and kinds <= {int, float}:
        return ("list", [float(each) for each in value])
    if Substitution in kinds and kinds <= {str, Substitution}:
        return ("yaml", normalize_to_list_of_substitutions(value))
    items = [each if isinstance(each, _SCALARS) else normalize_to_list_of_substitutions(each) for each in value]
    return ("items", items)


def normalize_parameters(parameters: Any) -> tuple[Any, ...]:
    if isinstance(parameters, Anything):
        parameters = [parameters]
    if isinstance(parameters, str) or not isinstance(parameters, Sequence):
        raise TypeError(f"Expecting list of parameters, got {parameters}")
    found: list[Any] = []
    for param in parameters:
        if isinstance(param, Mapping):
            found.append(normalize_parameter_dict(param))
        elif isinstance(param, (Parameter, ParameterFile)):
            found.append(param)
        else:
            found.append(ParameterFile(param))
    return tuple(found)


def normalize_remap_rule(remap_rule: Any) -> tuple[Any, Any]:
    ensure_argument_type(remap_rule, tuple, "remap_rule")
    if not isinstance(remap_rule, Anything) and len(remap_rule) != 2:
        raise TypeError(f"remap_rule must be a tuple of length 2, got length {len(remap_rule)}")
    return (
        tuple(normalize_to_list_of_substitutions(remap_rule[0])),
        tuple(normalize_to_list_of_substitutions(remap_rule[1])),
    )


def normalize_remap_rules(remap_rules: Any) -> Iterable[tuple[Any, Any]]:
    return map(normalize_remap_rule, remap_rules)


def serialize_parameters(t: Any, parameters: Any, kind: str = "param_dict") -> None:
    for param in parameters or ():
        if isinstance(param, ParameterFile):
            allow = param.allow_substs
            t.child("param", **{"from": param.param_file, "allow_substs": allow if allow else None})
        elif isinstance(param, Parameter):
            with t.inside(kind):
                t.parameter(param.name, param.preflight_value)
        else:
            with t.inside(kind):
                for name, value in param.items():
                    t.parameter(list(name), value)


def serialize_remappings(t: Any, remappings: Any) -> None:
    for source, target in remappings or ():
        t.child("remap", **{"from": list(source), "to": list(target)})
