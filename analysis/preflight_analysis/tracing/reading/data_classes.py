"""`dataclasses`, for classes of a program that is read."""

from __future__ import annotations

import copy
from typing import Any

from preflight_analysis.tracing.reading.values import Function, NotRead, is_program_class

_MISSING = object()


class Field:
    """What `field()` gives."""

    def __init__(self, default: Any, factory: Any, *, init: bool) -> None:
        self.default, self.factory, self.init = default, factory, init


def FIELD(*, default: Any = _MISSING, default_factory: Any = None, init: bool = True, **_: Any) -> Any:
    """`dataclasses.field`."""
    return Field(default, default_factory, init=init)


def dataclass(interpreter: Any, kind: Any = None, **options: Any) -> Any:
    """`dataclasses.dataclass`."""
    if kind is None:
        return lambda given: dataclass(interpreter, given, **options)
    if not is_program_class(kind) or set(options) - {"frozen", "eq", "repr", "slots", "order", "kw_only", "init"}:
        raise NotRead("a dataclass")
    fields: dict[str, Any] = {}
    for each in reversed(kind.__mro__):
        fields.update(vars(each).get("preflight_fields", {}))
    for name, written in vars(kind).get("__annotations__", {}).items():
        if written.startswith(("ClassVar", "typing.ClassVar")):
            continue
        given = vars(kind).get(name, _MISSING)
        fields[name] = given if isinstance(given, Field) else Field(given, None, init=True)
    for name, each in fields.items():
        if each.default is not _MISSING:
            setattr(kind, name, each.default)
    kind.preflight_fields = fields
    kind.__init__ = Function(
        lambda args, kwargs: _init(interpreter, kind, fields, args, kwargs), "__init__", "__init__"
    )
    if "__eq__" not in vars(kind) and options.get("eq", True):
        kind.__eq__ = Function(lambda args, _: _equal(interpreter, *args), "__eq__", "__eq__")
        kind.__hash__ = Function(lambda args, _: 0, "__hash__", "__hash__")
    return kind


def _init(interpreter: Any, kind: Any, fields: dict[str, Any], args: Any, kwargs: Any) -> None:
    self, *values = args
    names = [name for name, each in fields.items() if each.init]
    if len(values) > len(names):
        raise TypeError(
            f"{kind.__name__}.__init__() takes {len(names) + 1} positional arguments but {len(args)} were given"
        )
    given = dict(zip(names, values, strict=False))
    for name, value in kwargs.items():
        if name not in names or name in given:
            raise TypeError(f"{kind.__name__}.__init__() got an unexpected keyword argument '{name}'")
        given[name] = value
    for name, each in fields.items():
        if name in given:
            vars(self)[name] = given[name]
        elif each.factory is not None:
            vars(self)[name] = interpreter.call(each.factory, (), {})
        elif each.default is not _MISSING:
            vars(self)[name] = each.default
        elif each.init:
            raise TypeError(f"{kind.__name__}.__init__() missing required argument: '{name}'")
    after = getattr(self, "__post_init__", None)
    if after is not None:
        interpreter.call(after, (), {})


def _values(thing: Any) -> Any:
    return type(thing), tuple(vars(thing).items()) if hasattr(thing, "__dict__") else thing


def _equal(interpreter: Any, one: Any, other: Any) -> Any:
    interpreter.step(2)
    return _values(one) == _values(other)


def members(thing: Any) -> Any:
    """`dataclasses.asdict`, of plain values."""
    fields = getattr(type(thing), "preflight_fields", None)
    if fields is None:
        raise NotRead("asdict()")
    return {name: _plain(getattr(thing, name)) for name in fields}


def _plain(value: Any) -> Any:
    if getattr(type(value), "preflight_fields", None) is not None:
        return members(value)
    if isinstance(value, (list, tuple)):
        return type(value)(map(_plain, value))
    if isinstance(value, dict):
        return {key: _plain(each) for key, each in value.items()}
    return value


def replaced(thing: Any, **changes: Any) -> Any:
    """`dataclasses.replace`."""
    if getattr(type(thing), "preflight_fields", None) is None:
        raise NotRead("replace()")
    made = copy.copy(thing)
    vars(made).update(changes)
    return made
