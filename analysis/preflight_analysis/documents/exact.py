"""Equality of what holds values of several types: Python's `1 == 1.0 == True`, and to a node they are three."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

T = TypeVar("T")


def exact(*fields: str) -> Callable[[type[T]], type[T]]:
    """Objects of the decorated class are equal only if the values of these fields are of the same types, throughout, in
    dictionaries in the same order."""

    def decorate(cls: type[T]) -> type[T]:
        equal: Callable[[T, object], Any] = cls.__eq__

        def is_equal(self: T, other: object) -> Any:
            same = equal(self, other)
            if same is not True:
                return same
            return all(_is_same(getattr(self, field), getattr(other, field)) for field in fields)

        def is_unequal(self: T, other: object) -> Any:
            same = is_equal(self, other)
            return same if same is NotImplemented else not same

        cls.__eq__, cls.__ne__ = is_equal, is_unequal  # type: ignore[assignment, method-assign]
        return cls

    return decorate


def _is_same(one: object, other: object) -> bool:
    """Of two values that are equal: whether they are one and the same to those that ask for their types."""
    if one is other:
        return True
    if type(one) is not type(other):
        return False
    if isinstance(one, (str, bytes, int)):
        return True
    try:
        return repr(one) == repr(other)
    except RecursionError:
        return False
