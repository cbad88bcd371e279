"""What follows from one immutable object alone is made once, and lives as long as the object."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from typing_extensions import Self

T = TypeVar("T")


class Once:
    """A base for immutable objects."""

    __slots__ = ("_made",)
    _made: dict[Callable[..., Any], Any]

    def once(self, make: Callable[[Self], T]) -> T:
        """`make(self)`, made for the first who asks and the same for those that come later. `make` is pure."""
        try:
            made = self._made
        except AttributeError:
            object.__setattr__(self, "_made", made := {})
        if make not in made:
            made[make] = make(self)
        result: T = made[make]
        return result
