"""Dataclasses from JSON that anybody may have written: what is not of a field's type is refused."""

from __future__ import annotations

import dataclasses
import functools
import math
import types
import typing
from collections.abc import Callable, Hashable, Mapping
from typing import Any, TypeVar

T = TypeVar("T")
_Reader = Callable[[Any], Any]
TRANSIENT = "transient"
"""In the metadata of a field that is None in what is written and read."""


def from_json(kind: type[T], data: object) -> T:
    """A dataclass from what `dataclasses.asdict` and JSON made of one; a field that is lacking has its default.

    Fields may be texts, bools, finite numbers, Literals, dataclasses, `X | None`, `tuple[X, ...]`, mappings and `Any`.

    Raises `TypeError` where a field is not of its type, lacks and has no default, or is none of the dataclass.
    """
    made: T = _reader(typing.cast(Hashable, kind))(data)
    return made


@functools.cache
def _reader(kind: Hashable) -> _Reader:
    """What makes a value of a type."""
    origin, inner = typing.get_origin(kind), typing.get_args(kind)
    if dataclasses.is_dataclass(kind):
        return _dataclass(typing.cast(type, kind))
    if origin is types.UnionType:
        (some,) = set(inner) - {types.NoneType}
        return functools.partial(_or_none, _reader(some))
    if origin is tuple:
        return functools.partial(_tuple, _reader(inner[0]))
    if origin is typing.Literal:
        return functools.partial(_of, lambda data: isinstance(data, str) and data in inner)
    return functools.partial(_of, _IS[origin or kind])


_IS: Mapping[Any, Callable[[Any], bool]] = {
    Any: lambda data: True,
    str: lambda data: isinstance(data, str),
    bool: lambda data: isinstance(data, bool),
    int: lambda data: isinstance(data, int) and not isinstance(data, bool),
    float: lambda data: math.isfinite(data) if isinstance(data, float) else _IS[int](data),
    Mapping: lambda data: isinstance(data, dict),
}


def _of(is_one: Callable[[Any], bool], data: Any) -> Any:
    if not is_one(data):
        raise TypeError(data)
    return data


_NONE: _Reader = functools.partial(_of, lambda data: data is None)


def _or_none(read: _Reader, data: Any) -> Any:
    return None if data is None else read(data)


def _tuple(read: _Reader, data: Any) -> tuple[Any, ...]:
    if not isinstance(data, list):
        raise TypeError(data)
    return tuple(map(read, data))


def _dataclass(kind: type) -> _Reader:
    hints = typing.get_type_hints(kind)
    fields = {
        field.name: _NONE if TRANSIENT in field.metadata else _reader(hints[field.name])
        for field in dataclasses.fields(kind)
    }

    def read(data: Any) -> Any:
        if not isinstance(data, dict) or not data.keys() <= fields.keys():
            raise TypeError(data)
        return kind(**{name: fields[name](value) for name, value in data.items()})

    return read
