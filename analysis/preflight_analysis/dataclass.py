"""`dataclasses.dataclass`, in a fraction of its time."""

from __future__ import annotations

import dataclasses
import operator
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

__all__ = ["dataclass"]


def _value_class(kind: type, *, frozen: bool, eq: bool, repr: bool, **options: bool) -> Any:
    defined = set(kind.__dict__) - ({"__hash__"} if kind.__dict__.get("__hash__") is None else set())
    made: Any = dataclasses.dataclass(eq=False, repr=False, **options)(kind)
    fields = dataclasses.fields(made)

    def add(name: str, method: Any) -> None:
        if name not in defined:
            setattr(made, name, method)

    if repr:
        add("__repr__", _written([field.name for field in fields if field.repr]))
    if eq:
        # With the class it is a tuple whatever the number of fields, and compares objects before values as tuples do.
        values = operator.attrgetter("__class__", *(field.name for field in fields if field.compare))
        add("__eq__", _equal(values))
        add("__hash__", (lambda self: hash(values(self))) if frozen else None)
    return made


def _written(names: list[str]) -> Callable[[Any], str]:
    values = operator.attrgetter("__class__.__qualname__", *names)
    form = f"%s({', '.join(f'{name}=%r' for name in names)})"
    return lambda self: form % values(self)


def _equal(values: operator.attrgetter[Any]) -> Callable[[Any, object], Any]:
    return lambda self, other: values(self) == values(other) if other.__class__ is self.__class__ else NotImplemented


if TYPE_CHECKING:
    from dataclasses import dataclass
else:

    def dataclass(
        *,
        frozen: bool = False,
        eq: bool = True,
        repr: bool = True,
        order: bool = False,
        **options: bool,
    ) -> Callable[[type], type]:
        """As that of the standard library, which has Python compile six functions for each class: with hundreds of
        classes that was a third of a warm check. Here methods are closures, and only `__init__` is compiled.

        `frozen` gives the hash, and is for mypy to hold: at run time nothing refuses an assignment, so that making an
        object is as fast as that of any other class.
        """
        if order:  # of a handful of classes
            return dataclasses.dataclass(frozen=frozen, eq=eq, repr=repr, order=True, **options)
        return lambda kind: _value_class(kind, frozen=frozen, eq=eq, repr=repr, **options)
