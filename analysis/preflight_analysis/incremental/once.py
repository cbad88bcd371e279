"""What follows from one immutable object alone is made once, and lives as long as the object."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable
from typing import TYPE_CHECKING, Any, Concatenate, ParamSpec, TypeVar

if TYPE_CHECKING:
    from typing_extensions import Self

P = ParamSpec("P")
T = TypeVar("T")
Item = TypeVar("Item", bound="Once")


class Once:
    """A base for immutable objects."""

    __slots__ = ("_made",)
    _made: dict[Hashable, Any]

    def once(self, make: Callable[Concatenate[Self, P], T], *arguments: P.args, **none: P.kwargs) -> T:
        """`make(self, *arguments)`, made for the first who asks and the same for those that come later. `make` is pure,
        the arguments are hashable and given by their places."""
        try:
            made = self._made
        except AttributeError:
            object.__setattr__(self, "_made", made := {})
        key = (make, *arguments)
        if key not in made:
            made[key] = make(self, *arguments, **none)
        result: T = made[key]
        return result


def each_once(
    items: Iterable[Item], make: Callable[Concatenate[Item, P], T], /, *arguments: P.args, **none: P.kwargs
) -> list[T]:
    """`item.once(make, *arguments)` for each item, for many of them."""
    key = (make, *arguments)
    found: list[T] = []
    for item in items:
        try:
            found.append(item._made[key])
        except (AttributeError, KeyError):
            found.append(item.once(make, *arguments, **none))
    return found
